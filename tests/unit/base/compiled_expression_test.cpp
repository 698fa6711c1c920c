#include "base/compiled_expression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "base/expression.hpp"

namespace courant {
namespace {

const std::vector<std::string> variables = {"x", "y", "zero"};
const Real values[] = {1.75, -2.5, 0};

ExpressionResult evaluated(const std::string& text) {
  ExpressionNames known;
  known.find = [](std::string_view name, std::string&) -> std::optional<Number> {
    for (std::size_t k = 0; k < variables.size(); ++k)
      if (variables[k] == name) return Number::of(values[k]);
    return std::nullopt;
  };
  known.all = [] { return variables; };
  return evaluate_expression(text, known, Arithmetic::real);
}

// Both meanings of the grammar must agree bit for bit, faults included.
TEST(CompiledExpression, AgreesWithTheEvaluator) {
  for (const char* text : {"1",
                           "x",
                           "x+y",
                           "x-y-1",
                           "x*y/3",
                           "2**3**0.5",
                           "-x**2",
                           "x**-2",
                           "-(x-y)",
                           "+x",
                           "5/2",
                           "sin(x)+cos(y)*tan(0.3)",
                           "csc(x)+sec(x)+ctn(x)",
                           "asin(0.3)+acos(0.3)+atan(7)",
                           "atan2(y, x)",
                           "sinh(x)+cosh(x)+tanh(y)+asinh(y)+acosh(x)+atanh(0.5)",
                           "exp(y)+log(x)+log10(x)+sqrt(x)",
                           "min(x, y)",
                           "max(x, y, 3, 1)",
                           "min(1,2,-8)",
                           "abs(y)",
                           "sign(x, y)",
                           "mod(7, 3)",
                           "mod(x*4, 3)",
                           "int(y)",
                           "nint(y)",
                           "aint(y)",
                           "anint(x)",
                           "float(x)",
                           "floor(y)+ceil(x)+round(y)",
                           "SIN(x)",
                           "1e-3*x",
                           "1.5d2 + .5",
                           "((((x))))",
                           "x - -y",
                           "zero**0",
                           "(x+(y+(x+(y+(x+(y+1))))))"}) {
    const CompiledExpression compiled(text, variables);
    ASSERT_TRUE(compiled.ok()) << text << ": " << compiled.error();
    const ExpressionResult expected = evaluated(text);
    ASSERT_TRUE(expected.ok()) << text << ": " << expected.error;
    EXPECT_EQ(compiled(values), expected.value.value()) << text;
  }
}

TEST(CompiledExpression, WhatTheEvaluatorRefusesIsNaN) {
  for (const char* text : {"1/zero", "1/(1/zero)", "zero**-1", "sqrt(y)", "log(zero)", "exp(1e9)",
                           "mod(1, zero)", "min(1, sqrt(y))", "max(sqrt(y), 1)", "(1/zero)**0", "1**sqrt(y)",
                           "sign(1, sqrt(y))", "floor(1e300)", "atan2(1/zero, 1)"}) {
    const CompiledExpression compiled(text, variables);
    ASSERT_TRUE(compiled.ok()) << text;
    EXPECT_FALSE(evaluated(text).ok()) << text;
    EXPECT_TRUE(std::isnan(compiled(values))) << text << " = " << compiled(values);
  }
}

TEST(CompiledExpression, FaultsHaveTheWordsOfTheEvaluator) {
  for (const char* text : {"", "x+", "(x", "x)", "sine(x)", "atan2(x)", "3 x", "&", "1e999"}) {
    const CompiledExpression compiled(text, variables);
    EXPECT_FALSE(compiled.ok()) << text;
    EXPECT_EQ(compiled.error(), evaluated(text).error) << text;
    EXPECT_EQ(compiled.hint(), evaluated(text).hint) << text;
  }
  const CompiledExpression unknown("x + zerro", variables);
  EXPECT_EQ(unknown.error(), "unknown name 'zerro'");
  EXPECT_EQ(unknown.hint(), "did you mean zero?");
  EXPECT_FALSE(CompiledExpression().ok());
}

TEST(CompiledExpression, TellsWhatItUses) {
  const CompiledExpression compiled("2 * y", variables);
  EXPECT_FALSE(compiled.uses(0));
  EXPECT_TRUE(compiled.uses(1));
  EXPECT_FALSE(compiled.uses(7));
}

TEST(CompiledExpression, ManyWaitingValues) {
  std::string text = "0";
  for (int k = 0; k < 90; ++k) text = "1+(" + text + ")";
  EXPECT_EQ(CompiledExpression(text, {})(nullptr), 90);
  std::string list = "max(1";
  for (int k = 0; k < 90; ++k) list += ", " + std::to_string(k);
  EXPECT_EQ(CompiledExpression(list + ")", {})(nullptr), 89);
}

}  // namespace
}  // namespace courant
