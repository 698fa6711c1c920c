#include "base/expression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "base/expression_functions.hpp"

namespace courant {

namespace {

const std::map<std::string, Number> known = {
    {"dx", Number::of(0.5)}, {"n", Number::of(Id(4))}, {"NX2", Number::of(Id(-7))}};

ExpressionNames names() {
  ExpressionNames out;
  out.find = [](std::string_view name, std::string& reason) -> std::optional<Number> {
    if (name == "label") reason = "'label' is a text";
    const auto it = known.find(std::string(name));
    return it == known.end() ? std::nullopt : std::optional<Number>(it->second);
  };
  out.all = [] { return std::vector<std::string>{"dx", "n", "NX2"}; };
  return out;
}

ExpressionResult result_of(const std::string& text) {
  return evaluate_expression(text, names());
}

/// "I 2" or "R 2.5", or the error with its position and hint.
std::string typed(const std::string& text) {
  const ExpressionResult out = result_of(text);
  if (!out.ok()) return std::to_string(out.at) + ": " + out.error + (out.hint.empty() ? "" : "; " + out.hint);
  return (out.value.is_integer ? "I " : "R ") + out.value.text();
}

Real real(const std::string& text) {
  const ExpressionResult out = result_of(text);
  EXPECT_TRUE(out.ok()) << text << ": " << out.error;
  EXPECT_FALSE(out.value.is_integer) << text;
  return out.value.real;
}

TEST(TypedExpression, KeepsIntegersAndReals) {
  EXPECT_EQ(typed("5/2"), "I 2");
  EXPECT_EQ(typed("-5/2"), "I -2");
  EXPECT_EQ(typed("5/2.0"), "R 2.5");
  EXPECT_EQ(typed("5/2."), "R 2.5");
  EXPECT_EQ(typed("2/5"), "I 0");
  EXPECT_EQ(typed("5/2*2.0"), "R 4");
  EXPECT_EQ(typed("2**3"), "I 8");
  EXPECT_EQ(typed("2^3"), "I 8");
  EXPECT_EQ(typed("2**3**2"), "I 512");
  EXPECT_EQ(typed("-2**2"), "I -4");
  EXPECT_EQ(typed("2**-1"), "I 0");
  EXPECT_EQ(typed("(-1)**-3"), "I -1");
  EXPECT_EQ(typed("1**-3"), "I 1");
  EXPECT_EQ(typed("2.**-1"), "R 0.5");
  EXPECT_EQ(typed("2**0.5"), "R " + Number::of(std::sqrt(2.0)).text());
  EXPECT_EQ(typed("3 + 4 * (2 - 5)"), "I -9");
  EXPECT_EQ(typed("1 - 2 - 3"), "I -4");
  EXPECT_EQ(typed("10-+3"), "I 7");
  EXPECT_EQ(typed("2*-3"), "I -6");
}

TEST(TypedExpression, ReadsNumbersInFortransForms) {
  EXPECT_EQ(typed("1.5d-3"), "R 0.0015");
  EXPECT_EQ(typed("1.5D2"), "R 150");
  EXPECT_EQ(typed("1e3"), "R 1000");
  EXPECT_EQ(typed(".5+5."), "R 5.5");
  EXPECT_EQ(typed("1.5-3"), "R -1.5");  // a difference, not an exponent
  EXPECT_EQ(typed("9223372036854775807"), "I 9223372036854775807");
}

TEST(TypedExpression, KnowsNamesWithAndWithoutAnd) {
  EXPECT_EQ(typed("n/3"), "I 1");
  EXPECT_EQ(typed("&n * &dx"), "R 2");
  EXPECT_EQ(typed("-&NX2"), "I 7");
  EXPECT_EQ(typed("(n+1)/dx"), "R 10");
}

TEST(TypedExpression, KnowsFunctionsOfOneReal) {
  EXPECT_DOUBLE_EQ(real("sin(1)"), std::sin(1));
  EXPECT_DOUBLE_EQ(real("COS(1)"), std::cos(1));
  EXPECT_DOUBLE_EQ(real("Tan(1)"), std::tan(1));
  EXPECT_DOUBLE_EQ(real("csc(1)"), 1 / std::sin(1));
  EXPECT_DOUBLE_EQ(real("sec(1)"), 1 / std::cos(1));
  EXPECT_DOUBLE_EQ(real("ctn(1)"), 1 / std::tan(1));
  EXPECT_DOUBLE_EQ(real("asin(0.5)"), std::asin(0.5));
  EXPECT_DOUBLE_EQ(real("acos(0.5)"), std::acos(0.5));
  EXPECT_DOUBLE_EQ(real("4*atan(1)"), pi);
  EXPECT_DOUBLE_EQ(real("atan2(1, -1)"), std::atan2(1, -1));
  EXPECT_DOUBLE_EQ(real("sinh(1)"), std::sinh(1));
  EXPECT_DOUBLE_EQ(real("cosh(1)"), std::cosh(1));
  EXPECT_DOUBLE_EQ(real("tanh(1)"), std::tanh(1));
  EXPECT_DOUBLE_EQ(real("asinh(1)"), std::asinh(1));
  EXPECT_DOUBLE_EQ(real("acosh(2)"), std::acosh(2));
  EXPECT_DOUBLE_EQ(real("atanh(0.5)"), std::atanh(0.5));
  EXPECT_DOUBLE_EQ(real("exp(1)"), std::exp(1));
  EXPECT_DOUBLE_EQ(real("log(2)"), std::log(2));
  EXPECT_DOUBLE_EQ(real("log10(1000)"), 3);
  EXPECT_DOUBLE_EQ(real("sqrt(16)"), 4);
}

TEST(TypedExpression, RoundsAsFortranDoes) {
  EXPECT_EQ(typed("int(-2.7)"), "I -2");
  EXPECT_EQ(typed("ls_integer(2.7)"), "I 2");
  EXPECT_EQ(typed("LS_REAL(5)/2"), "R 2.5");
  EXPECT_EQ(typed("float(5)/2"), "R 2.5");
  EXPECT_EQ(typed("aint(-2.7)"), "R -2");
  EXPECT_EQ(typed("nint(2.5)"), "I 3");
  EXPECT_EQ(typed("nint(-2.5)"), "I -3");
  EXPECT_EQ(typed("anint(2.5)"), "R 3");
  EXPECT_EQ(typed("floor(-2.5)"), "I -3");
  EXPECT_EQ(typed("ceil(-2.5)"), "I -2");
  EXPECT_EQ(typed("round(2.4)"), "I 2");
  EXPECT_EQ(typed("mod(17, 5)"), "I 2");
  EXPECT_EQ(typed("mod(-17, 5)"), "I -2");
  EXPECT_EQ(typed("mod(17.4, 4.6)"), "I 2");
}

TEST(TypedExpression, KeepsTheKindInMinMaxAbsAndSign) {
  EXPECT_EQ(typed("min(3, 2)"), "I 2");
  EXPECT_EQ(typed("max(3, 2, 7, 5)"), "I 7");
  EXPECT_EQ(typed("max(3, 2.0)"), "R 3");
  EXPECT_EQ(typed("max(n, 5)/2"), "I 2");
  EXPECT_EQ(typed("abs(-5)/2"), "I 2");
  EXPECT_EQ(typed("abs(-2.5)"), "R 2.5");
  EXPECT_EQ(typed("sign(-5, 2)"), "I 5");
  EXPECT_EQ(typed("sign(5, -2.0)"), "R -5");
  EXPECT_EQ(typed("sign(5.0, -2)"), "R -5");
  EXPECT_EQ(typed("sign(-5, 0)"), "I 5");
}

TEST(TypedExpression, NamesWhatIsWrongAndWhere) {
  EXPECT_EQ(typed("2 * m2x"), "4: unknown parameter 'm2x'; did you mean dx?");
  EXPECT_EQ(typed("2 * nothing"), "4: unknown parameter 'nothing'");
  EXPECT_EQ(typed("1 + label"), "4: 'label' is a text");
  EXPECT_EQ(typed("1 + &"), "4: a name is missing behind '&'");
  EXPECT_EQ(typed("1 + sqr(4)"), "4: unknown function 'sqr'; did you mean sqrt?");
  EXPECT_EQ(typed("atan2(1)"), "0: atan2 takes 2 arguments, got 1");
  EXPECT_EQ(typed("2*sin(1, 2)"), "2: sin takes 1 argument, got 2");
  EXPECT_EQ(typed("sin()"), "0: sin takes 1 argument, got 0");
  EXPECT_EQ(typed("max(1)"), "0: max takes 2 arguments or more, got 1");
  EXPECT_EQ(typed("1 / (n - 4)"), "2: division by zero");
  EXPECT_EQ(typed("1.0 / (dx - 0.5)"), "4: division by zero");
  EXPECT_EQ(typed("mod(3, 0.4)"), "0: division by zero");
  EXPECT_EQ(typed("0 ** -1"), "2: division by zero");
  EXPECT_EQ(typed("0.0 ** -1"), "4: division by zero");
  EXPECT_EQ(typed("1 + sqrt(-1)"), "4: the result is not a finite number");
  EXPECT_EQ(typed("log(0)"), "0: the result is not a finite number");
  EXPECT_EQ(typed("csc(0)"), "0: the result is not a finite number");
  EXPECT_EQ(typed("1e300 * 1e300"), "6: the result is not a finite number");
  EXPECT_EQ(typed("(-8.0) ** 0.5"), "7: the result is not a finite number");
  EXPECT_EQ(typed("1e999"), "0: the number 1e999 is too large or too small");
}

TEST(TypedExpression, RefusesIntegersThatOverflow) {
  const std::string fault = "the result is too large for an integer";
  EXPECT_EQ(typed("9223372036854775807 + 1"), "20: " + fault);
  EXPECT_EQ(typed("-9223372036854775807 - 2"), "21: " + fault);
  EXPECT_EQ(typed("9223372036854775807 * 2"), "20: " + fault);
  EXPECT_EQ(typed("10 ** 19"), "3: " + fault);
  EXPECT_EQ(typed("10 ** 18"), "I 1000000000000000000");
  EXPECT_EQ(typed("(-2) ** 63"), "I -9223372036854775808");
  EXPECT_EQ(typed("(-2) ** 63 / -1"), "11: " + fault);
  EXPECT_EQ(typed("abs((-2) ** 63)"), "0: " + fault);
  EXPECT_EQ(typed("mod((-2) ** 63, -1)"), "I 0");
  EXPECT_EQ(typed("-(-2) ** 63"), "0: " + fault);
  EXPECT_EQ(typed("int(1e19)"), "0: " + fault);
  EXPECT_EQ(
      typed("9223372036854775808"),
      "0: the integer 9223372036854775808 has too many digits; with a decimal point it would be a real");
}

TEST(TypedExpression, RefusesWhatIsNoExpression) {
  EXPECT_EQ(typed(""), "0: a value is missing");
  EXPECT_EQ(typed("1 +"), "3: a value is missing");
  EXPECT_EQ(typed("(1 + 2"), "6: ')' is missing");
  EXPECT_EQ(typed("1 + 2)"), "5: ')' is not understood");
  EXPECT_EQ(typed("2o.0"), "1: 'o.0' is not understood");
  EXPECT_EQ(typed("1,2"), "1: ',2' is not understood");
  EXPECT_EQ(typed("* 2"), "0: expected a number or a name, got '* 2'");
  EXPECT_EQ(typed("1 2"), "2: '2' is not understood");
  EXPECT_EQ(typed("2 ** ** 2"), "5: expected a number or a name, got '** 2'");
  EXPECT_EQ(typed("max(1,)"), "6: expected a number or a name, got ')'");
  EXPECT_EQ(result_of(std::string(100000, '(')).error, "too deeply nested");
  EXPECT_EQ(result_of(std::string(100000, '-') + "1").error, "too deeply nested");
  std::string powers = "1";
  for (int k = 0; k < 100000; ++k) powers += "**1";
  EXPECT_EQ(result_of(powers).error, "too deeply nested");
  std::string sum = "1";
  for (int k = 0; k < 100000; ++k) sum += "+1";  // long is not deep
  EXPECT_EQ(typed(sum), "I 100001");
}

TEST(TypedExpression, HasATestOfEveryFunctionsCountOfArguments) {
  for (const std::string& name : function_names()) {
    EXPECT_FALSE(wrong_count(*find_function(name), 0).empty()) << name;
    EXPECT_FALSE(result_of(name + "()").ok()) << name;
  }
  EXPECT_EQ(function_names().size(), 35u);
}

TEST(TypedExpression, NeverFailsOnRandomText) {
  std::mt19937 random(7);
  const std::string_view pieces[] = {"1",     "2.5",  "9223372036854775807",
                                     "dx",    "n",    "&",
                                     "(",     ")",    "+",
                                     "-",     "*",    "/",
                                     "**",    "^",    ",",
                                     " ",     "1e",   "d5",
                                     "mod(",  "min(", "int(",
                                     "sign(", "\xff", "."};
  int good = 0;
  for (int k = 0; k < 20000; ++k) {
    std::string text;
    const int length = static_cast<int>(random() % 12);
    for (int j = 0; j < length; ++j)
      if (k % 4 == 0)
        text += static_cast<char>(random() % 256);
      else
        text += pieces[random() % std::size(pieces)];
    const ExpressionResult out = result_of(text);
    good += out.ok();
    if (out.ok())
      EXPECT_TRUE(std::isfinite(out.value.value())) << text;
    else
      EXPECT_LE(out.at, text.size()) << text;
  }
  EXPECT_GT(good, 100);
}

TEST(RealExpression, HasNoIntegers) {
  const auto value = [](const std::string& text) {
    return evaluate_expression(text, names(), Arithmetic::real).value;
  };
  EXPECT_EQ(value("5/2").text(), "2.5");
  EXPECT_EQ(value("n/8").text(), "0.5");
  EXPECT_EQ(value("2^-1").text(), "0.5");
  EXPECT_EQ(value("nint(2.5)/2").text(), "1.5");
  EXPECT_EQ(value("99999999999999999999").real, 1e20);
  EXPECT_FALSE(value("5").is_integer);
}

}  // namespace

}  // namespace courant
