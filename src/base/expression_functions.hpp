#pragma once
// What the operators and functions of expressions compute, on integers and on reals.
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/expression.hpp"

namespace courant {

/// A number, or the reason why there is none.
struct Calculated {
  Number value;
  std::string fault{};
};

// of two integers an integer: a quotient loses its fraction
Calculated added(const Number& a, const Number& b);
Calculated subtracted(const Number& a, const Number& b);
Calculated multiplied(const Number& a, const Number& b);
Calculated divided(const Number& a, const Number& b);
Calculated raised(const Number& a, const Number& b);

struct ExpressionFunction {
  std::string name;  ///< in lower case
  std::size_t least = 1, most = 1;
  Calculated (*of)(const std::vector<Number>& arguments) = nullptr;
  // the same on reals alone, for speed; what is not finite is a fault
  Real (*of_real)(Real) = nullptr;         ///< of functions of one argument; may be missing
  Real (*of_reals)(Real, Real) = nullptr;  ///< with two arguments; may be missing
  bool chooses = false;                    ///< an argument that it leaves out may have no value
};

const ExpressionFunction* find_function(std::string_view name);  ///< nullptr if there is none
std::vector<std::string> function_names();
/// "atan2 takes 2 arguments, got 1", or nothing.
std::string wrong_count(const ExpressionFunction& function, std::size_t count);

std::string lower_case(std::string_view text);

}  // namespace courant
