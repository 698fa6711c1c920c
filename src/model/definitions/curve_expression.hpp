#pragma once
// What *DEFINE_CURVE_FUNCTION and *DEFINE_FUNCTION compute: expressions of the time.
#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/compiled_expression.hpp"
#include "model/model.hpp"

namespace courant {

/// What is wrong with a text, and where: an index into it.
struct TextFault {
  std::string message, hint;
  std::size_t at = 0;
  bool any() const { return !message.empty(); }
};

/// A function of one number. Beside the functions of base/expression.hpp, with reals:
///   IF(e, a, b, c)                a where e < 0, b where e = 0, c where e > 0
///   STEP(x, x0, h0, x1, h1)       h0 up to x0, h1 from x1 on, between them the cubic without slope at its
///   ends STEP5, HAVSIN                 the same with a polynomial of degree 5, half a wave of a sine POLY(x,
///   x0, a0, a1, ...)      sum of a_j (x - x0)^j CHEBY(x, x0, a0, a1, ...)     sum of a_j T_j(x - x0) FORCOS,
///   FORSIN(x, x0, w, a0, a1, ...)  a0 + sum of a_j cos or sin(j w (x - x0)) SHF(x, x0, a, w, phi, b)      a
///   sin(w (x - x0) - phi) + b MOD(a, b)                     a - b trunc(a/b) POW(a, b), FABS(a) as in C
/// and the numbers PI, DTOR, RTOD. Upper and lower case are the same.
class CurveExpression {
 public:
  /// An expression of TIME.
  static CurveExpression of_time(std::string_view text, TextFault& fault);
  /// "f(a, b) = ..." or "float f(float a, float b) { float c = ...; return ...; }". Only the first argument
  /// may count, which is the time.
  static CurveExpression of_function(std::string_view text, TextFault& fault);
  /// Not a number where there is no value.
  Real operator()(Real time) const;
  /// Of one evaluation.
  std::size_t operations() const;

 private:
  /// Values: PI, DTOR, RTOD, arguments, then what assignments made.
  struct Step {
    CompiledExpression value;
    std::size_t to = 0;
  };
  std::vector<Step> steps_;
  std::size_t arguments_ = 1, values_ = 0;
};

/// Operations that the curves of a deck may take together: some two seconds, and for each curve a look at a
/// formula of usual length.
class SamplingBudget {
 public:
  void add_curve() { own_ = 2e6; }
  /// False where that is more than is left, and from then on.
  bool take(Real operations) {
    const Real shared = std::max(operations - own_, Real(0));
    own_ -= operations - shared;
    spent_ = spent_ || shared > left_;
    left_ -= shared;
    return !spent_;
  }

 private:
  Real left_ = 1e8, own_ = 0;  ///< of all curves, of the one at hand
  bool spent_ = false;
};

/// A function of one number on [from, to] as a curve of straight pieces, which differ from it by less than
/// 1e-7 of its range; jumps are jumps. `operations`: of one evaluation. Returns what is wrong, else nothing:
/// the function has no value somewhere, changes too often, or takes more than the budget.
std::string sample_curve(const std::function<Real(Real)>& f, std::size_t operations, Real from, Real to,
                         SamplingBudget& budget, Curve& curve);

}  // namespace courant
