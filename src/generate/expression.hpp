#pragma once
// Expressions in scenes: the arithmetic of base/expression.hpp with reals only, the scene's parameters by
// name, and the placeholders `${...}`.
#include <map>
#include <string>
#include <string_view>

#include "base/real.hpp"

namespace courant {

using Variables = std::map<std::string, Real>;

/// A value, or the reason why there is none (`error` not empty).
struct Evaluation {
  Real value = 0;
  std::string error;
  bool ok() const { return error.empty(); }
};

/// Value of an expression such as `1.2 * d1 / ${resolution}`. `${name}` and `name` mean the same. Never
/// throws; a result that is not finite (division by zero) is an error. `place`: what x, y, z mean, where they
/// mean a place.
Evaluation evaluate(std::string_view text, const Variables& variables, const Vec* place = nullptr);

/// The shortest text of a number that fits `width` columns, with a leading blank where that costs no digits.
/// Empty if fewer than four correct digits would remain. `width` 0: no limit.
std::string number_text(Real value, int width = 0);

/// Text with its placeholders filled.
struct Substitution {
  std::string text;
  std::string error;
  int line = 0;  ///< of the error within the text, from 0
  bool ok() const { return error.empty(); }
};

/// Replaces `${expression}` by its value and `${expression:width}` by its value right-aligned in `width`
/// columns, so that fixed-format cards keep their columns.
Substitution substitute(std::string_view text, const Variables& variables);

}  // namespace courant
