#include "generate/expression.hpp"

#include <gtest/gtest.h>

namespace courant {
namespace {

const Variables variables = {{"dx", 0.5}, {"n", 4}};

Real value(const std::string& text) {
  const Evaluation result = evaluate(text, variables);
  EXPECT_TRUE(result.ok()) << text << ": " << result.error;
  return result.value;
}

TEST(Expression, FollowsArithmeticPrecedence) {
  EXPECT_DOUBLE_EQ(value("1 + 2 * 3"), 7);
  EXPECT_DOUBLE_EQ(value("(1 + 2) * 3"), 9);
  EXPECT_DOUBLE_EQ(value("8 / 4 / 2"), 1);
  EXPECT_DOUBLE_EQ(value("5 - 3 - 1"), 1);
  EXPECT_DOUBLE_EQ(value("-2^2"), -4);
  EXPECT_DOUBLE_EQ(value("2^3^2"), 512);
  EXPECT_DOUBLE_EQ(value("2^-1"), 0.5);
  EXPECT_DOUBLE_EQ(value("-1.5e-3 * -2"), 3e-3);
}

TEST(Expression, KnowsParametersAndFunctions) {
  EXPECT_DOUBLE_EQ(value("dx / n"), 0.125);
  EXPECT_DOUBLE_EQ(value("${dx} * ${n + 1}"), 2.5);
  EXPECT_DOUBLE_EQ(value("ceil(2.1) + floor(2.9) + round(2.6) + abs(-1) + sqrt(16)"), 3 + 2 + 3 + 1 + 4);
  EXPECT_DOUBLE_EQ(value("min(dx, n) + max(dx, n)"), 4.5);
}

TEST(Expression, NamesWhatIsWrong) {
  EXPECT_EQ(evaluate("2 * spacing", variables).error, "unknown parameter 'spacing'");
  EXPECT_EQ(evaluate("2 * dy", variables).error, "unknown parameter 'dy', did you mean dx?");
  EXPECT_EQ(evaluate("1 / (n - 4)", variables).error, "division by zero");
  EXPECT_EQ(evaluate("(1 + 2", variables).error, "')' is missing");
  EXPECT_EQ(evaluate("1 +", variables).error, "a value is missing");
  EXPECT_EQ(evaluate("", variables).error, "a value is missing");
  EXPECT_EQ(evaluate("2o.0", variables).error, "'o.0' is not understood");
  EXPECT_EQ(evaluate("sine(1)", variables).error, "unknown function 'sine', did you mean sin?");
  EXPECT_EQ(evaluate("2 * ${dx + 1", variables).error, "'}' is missing");
  EXPECT_EQ(evaluate("2 * (dx}", variables).error, "')' is missing");
  EXPECT_EQ(evaluate("sqrt(-1)", variables).error, "the result is not a finite number");
  EXPECT_EQ(evaluate(std::string(5000, '('), variables).error, "too deeply nested");
}

TEST(NumberText, KeepsDigitsAndFitsItsColumns) {
  EXPECT_EQ(number_text(1000, 10), "1000");
  EXPECT_EQ(number_text(0.1 + 0.2, 10), "0.3");
  EXPECT_EQ(number_text(-0.0, 10), "0");
  EXPECT_EQ(number_text(2.202256e9, 10), "2202256000");
  EXPECT_EQ(number_text(2.202256e12, 11), "2.202256e12");
  EXPECT_EQ(number_text(2.202256e12, 10), "2.2023e12");
  EXPECT_EQ(number_text(1e-20, 10), "1e-20");
  EXPECT_EQ(number_text(-1e20, 10), "-1e20");
  EXPECT_EQ(number_text(1.0 / 3, 10), "0.3333333");
  EXPECT_EQ(number_text(-1.23456789e-100, 6), "");
  for (const Real x : {1.0 / 3, -2.0 / 3e7, 1234567.891234, -9.87654321e-12})
    EXPECT_NEAR(std::stod(number_text(x, 16)), x, 1e-8 * std::abs(x));
}

TEST(Substitute, FillsPlaceholdersAndKeepsColumns) {
  EXPECT_EQ(substitute("d1/${n}", variables).text, "d1/4");
  EXPECT_EQ(substitute("         1${dx:10}${2 * n:10}\n", variables).text,
            "         1       0.5         8\n");
  EXPECT_EQ(substitute("no placeholder", variables).text, "no placeholder");
}

TEST(Substitute, TellsTheLineOfAFault) {
  const Substitution result = substitute("a\nb ${dx}\nc ${dy}\n", variables);
  EXPECT_EQ(result.error, "in '${dy}': unknown parameter 'dy', did you mean dx?");
  EXPECT_EQ(result.line, 2);
  EXPECT_FALSE(substitute("${dx", variables).ok());
  EXPECT_FALSE(substitute("${dx\n}", variables).ok());
  EXPECT_FALSE(substitute("${dx:0}", variables).ok());
  EXPECT_FALSE(substitute("${dx:1x}", variables).ok());
  EXPECT_FALSE(substitute("${dx/3:4}", variables).ok());
}

}  // namespace
}  // namespace courant
