#pragma once
// Expressions of scenes that may use the place x, y, z of a particle beside the scene's parameters.
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "base/diagnostic.hpp"
#include "base/real.hpp"
#include "generate/expression.hpp"

namespace courant {

struct PlaceExpression {
  std::string text{};
  Location where{};  ///< in the scene, for messages
  bool given() const { return !text.empty(); }
};

/// Which of x, y, z an expression names.
std::array<bool, 3> named_places(std::string_view text);

/// Value of an expression at x; `variables` are the scene's parameters and hold no x, y, z. A fault
/// is an error in `diagnostics` that names `what` and the place, and gives nothing back.
std::optional<Real> value_at(const PlaceExpression& expression, std::string_view what, const Vec& x,
                             const Variables& variables, Diagnostics& diagnostics);

}  // namespace courant
