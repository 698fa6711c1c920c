// Curves by formulas: what expressions give, where they are refused, and how curves follow them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "model/definitions/curve_expression.hpp"

using namespace courant;

namespace {

Real of_time(const std::string& text, Real t) {
  TextFault fault;
  const CurveExpression f = CurveExpression::of_time(text, fault);
  EXPECT_FALSE(fault.any()) << text << ": " << fault.message;
  return fault.any() ? std::numeric_limits<Real>::quiet_NaN() : f(t);
}
Real of_function(const std::string& text, Real t) {
  TextFault fault;
  const CurveExpression f = CurveExpression::of_function(text, fault);
  EXPECT_FALSE(fault.any()) << text << ": " << fault.message;
  return fault.any() ? std::numeric_limits<Real>::quiet_NaN() : f(t);
}
std::string fault_of_time(const std::string& text, std::size_t at) {
  TextFault fault;
  CurveExpression::of_time(text, fault);
  EXPECT_EQ(fault.at, at) << text;
  return fault.message;
}
std::string fault_of_function(const std::string& text, std::size_t at) {
  TextFault fault;
  CurveExpression::of_function(text, fault);
  EXPECT_EQ(fault.at, at) << text;
  return fault.message;
}

}  // namespace

TEST(CurveExpression, FunctionsOfTime) {
  EXPECT_DOUBLE_EQ(of_time("3/2*TIME", 2), 3);  // all numbers are reals
  EXPECT_DOUBLE_EQ(of_time("2.0*sin(2*PI*time/4)+abs(-1)", 1), 3);
  EXPECT_DOUBLE_EQ(of_time("SIN(30*DTOR)+0*RTOD", 0), 0.5);
  EXPECT_DOUBLE_EQ(of_time("EXP(-TIME)*MAX(TIME,2,5)", 1), 5 * std::exp(-1.0));
  // by hand: a quarter of the way 3/16 - 2/64 = 0.15625; 10/64 - 15/256 + 6/1024 = 0.103515625
  EXPECT_DOUBLE_EQ(of_time("STEP(TIME,1,2,5,6)", 2), 2 + 4 * 0.15625);
  EXPECT_DOUBLE_EQ(of_time("STEP5(TIME,1,2,5,6)", 2), 2 + 4 * 0.103515625);
  EXPECT_DOUBLE_EQ(of_time("HAVSIN(TIME,1,2,5,6)", 2), 2 + 2 * (1 - std::sqrt(0.5)));
  for (const char* name : {"STEP", "STEP5", "HAVSIN"}) {
    EXPECT_DOUBLE_EQ(of_time(std::string(name) + "(TIME,1,2,5,6)", -3), 2);
    EXPECT_DOUBLE_EQ(of_time(std::string(name) + "(TIME,1,2,5,6)", 9), 6);
  }
  EXPECT_DOUBLE_EQ(of_time("POLY(TIME,1,2,3,4)", 3), 2 + 6 + 16);
  EXPECT_DOUBLE_EQ(of_time("CHEBY(TIME,0,1,2,3,4)", 0.5), 1 + 1 - 1.5 - 4);  // T2 -1/2, T3 -1
  EXPECT_NEAR(of_time("FORCOS(TIME,0,PI,1,2,3)", 0.5), 1 + 0 - 3, 1e-12);
  EXPECT_NEAR(of_time("FORSIN(TIME,0,PI,1,2,3)", 0.5), 1 + 2 + 0, 1e-12);
  EXPECT_NEAR(of_time("SHF(TIME,1,3,PI,PI/2,7)", 1), 4, 1e-12);
  EXPECT_DOUBLE_EQ(of_time("MOD(TIME,2)", 7.5), 1.5);
  EXPECT_DOUBLE_EQ(of_time("TIME**2^2", 2), 16);
}

TEST(CurveExpression, IfChoosesBySignAndTheOthersNeedNoValue) {
  for (const auto& [t, value] : {std::pair<Real, Real>{0.5, 1}, {1, 2}, {2, 3}})
    EXPECT_DOUBLE_EQ(of_time("IF(TIME-1,1,2,3)", t), value);
  EXPECT_DOUBLE_EQ(of_time("IF(TIME-1,0,0,SQRT(TIME-1))", 0.5), 0);
  EXPECT_TRUE(std::isnan(of_time("IF(TIME-1,SQRT(TIME-1),0,0)", 0.5)));
  EXPECT_TRUE(std::isnan(of_time("IF(1/TIME,1,2,3)", 0)));
}

TEST(CurveExpression, RefusesWhatItDoesNotKnow) {
  EXPECT_EQ(fault_of_time("1+DX(17)", 2), "unknown function 'dx'");
  EXPECT_EQ(fault_of_time("2*temp", 2), "unknown name 'temp'");
  EXPECT_EQ(fault_of_time("STEP(TIME,0,1)", 0), "step takes 5 arguments, got 3");
  EXPECT_EQ(fault_of_time("2*(TIME", 7), "')' is missing");
}

TEST(CurveExpression, FunctionsInC) {
  EXPECT_DOUBLE_EQ(of_function("f(t)=2*t+pow(t,3);", 2), 12);
  EXPECT_DOUBLE_EQ(of_function("float load(float t, float x) {\n  /* half; of all */ float a = t/2; // "
                               "note\n  a = a + 1;\n  return "
                               "fabs(-a)*3;\n}\n",
                               4),
                   9);
  EXPECT_EQ(fault_of_function("f(t,x)=2*x", 7),
            "the value depends on 'x', and only the first argument, the time, is known here");
  EXPECT_EQ(fault_of_function("f(t) { if (t) return 1; }", 7), "'if' is not supported");
  EXPECT_EQ(fault_of_function("f(t) { return 1; } g", 19), "something follows the function");
  EXPECT_EQ(fault_of_function("f(t) { a = 1", 10), "';' is missing");
}

TEST(CurveExpression, ACurveFollowsItsFormulaAndJumpsWhereThatDoes) {
  const auto far = [](const std::function<Real(Real)>& f, Real end) {
    Curve curve;
    SamplingBudget budget;
    EXPECT_EQ(sample_curve(f, 5, 0, end, budget, curve), "");
    Real most = 0;
    for (int k = 0; k <= 77777; ++k)
      most = std::max(most, std::abs(curve(end * k / 77777) - f(end * k / 77777)));
    return most;
  };
  EXPECT_LT(far([](Real t) { return std::sin(2 * pi * 50 * t); }, 1), 1e-7 * 2);
  EXPECT_LT(far([](Real t) { return std::sin(2 * pi * 4096 * t); }, 0.1), 1e-7 * 2);  // of the first points
  EXPECT_LT(far([](Real t) { return 1e6 + std::exp(-30 * t); }, 1), 1e-7);
  Curve curve;
  SamplingBudget budget;
  EXPECT_EQ(sample_curve([](Real t) { return t < 0.3 ? 1.0 : 5.0; }, 5, 0, 1, budget, curve), "");
  EXPECT_EQ(curve(0.3 - 1e-11), 1);
  EXPECT_EQ(curve(0.3 + 1e-11), 5);
  Curve none;
  EXPECT_NE(sample_curve([](Real t) { return t < 0.5 ? t : std::sqrt(-t); }, 5, 0, 1, budget, none), "");
}

TEST(CurveExpression, CurvesOfADeckTakeNoMoreThanTheirBudgetTogether) {
  SamplingBudget budget;
  Curve curve;
  for (int k = 0; k < 1000; ++k) {  // usual ones have space, however many
    curve = {};
    ASSERT_EQ(sample_curve([](Real t) { return 2 * t; }, 5, 0, 1, budget, curve), "") << k;
  }
  curve = {};
  EXPECT_NE(sample_curve([](Real t) { return t; }, 3000, 0, 1, budget, curve), "");
  EXPECT_TRUE(curve.abscissa.empty()) << "refused before anything is computed";
  EXPECT_NE(sample_curve([](Real t) { return t; }, 1, 0, 1, budget, curve), "");
  const std::string statements = [] {
    std::string out = "float f(float t) {";
    for (int k = 0; k < 1000; ++k) out += " a = t;";
    return out + " return a; }";
  }();
  TextFault fault;
  CurveExpression::of_function(statements, fault);
  EXPECT_EQ(fault.message, "the function has more than 1000 statements");
}
