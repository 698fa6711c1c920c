#pragma once
// Arithmetic as LS-DYNA's *PARAMETER_EXPRESSION has it: a value is an integer or a real, and which of them it
// is decides what is computed: 5/2 is 2, 5/2.0 is 2.5. In scenes all numbers are reals.
//
//   + - * / **        ** binds tighter than a sign before it, and from the right; ^ is the same
//   ( )
//   sin cos tan csc sec ctn asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp log log10 sqrt
//   min max           two arguments or more; real if one of them is
//   abs sign          of the kind of their arguments; sign(a, b) is |a| with the sign of b
//   mod               of its arguments rounded to integers, with the sign of the first one: an integer
//   int nint          integer: without the fraction; nearest, halves away from 0
//   aint anint        the same as reals
//   float LS_REAL     real;  LS_INTEGER as int
//   floor ceil round  integers; scenes use them, LS-DYNA does not know them
//
// Angles are in radians. Function names do not distinguish upper and lower case.
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/real.hpp"

namespace courant {

/// An integer or a real.
struct Number {
  bool is_integer = false;
  Id integer = 0;  ///< if is_integer
  Real real = 0;   ///< if not
  static Number of(Id value) { return {true, value, 0}; }
  static Number of(Real value) { return {false, 0, value}; }
  Real value() const { return is_integer ? static_cast<Real>(integer) : real; }
  std::string text() const;  ///< shortest text that reads as the same number
};

/// The names that an expression may use.
struct ExpressionNames {
  /// The value of a name, written without &. Nothing if there is none; `reason` may then state why.
  std::function<std::optional<Number>(std::string_view name, std::string& reason)> find{};
  std::function<std::vector<std::string>()> all{};  ///< for the message about an unknown name
};

enum class Arithmetic {
  typed,  ///< integers and reals
  real,   ///< all numbers are reals
};

/// A value, or the reason why there is none (`error` not empty).
struct ExpressionResult {
  Number value;
  std::string error, hint;
  std::size_t at = 0;  ///< position of the error in the text, from 0
  bool ok() const { return error.empty(); }
};

/// Never throws. Errors: what is not understood, an unknown name or function, a wrong number of arguments,
/// division by zero, a result that is not finite or does not fit 64 bits, more than 100 parentheses in each
/// other.
ExpressionResult evaluate_expression(std::string_view text, const ExpressionNames& names,
                                     Arithmetic arithmetic = Arithmetic::typed);

/// The integer that is left without the fraction; nothing if it does not fit.
std::optional<Id> truncated(Real value);

}  // namespace courant
