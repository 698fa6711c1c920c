#include "generate/place_expression.hpp"

#include <fmt/format.h>

#include <cctype>

namespace courant {

std::array<bool, 3> named_places(std::string_view text) {
  std::array<bool, 3> named{};
  const auto is_word = [&](std::size_t i) {
    return i < text.size() &&
           (std::isalnum(static_cast<unsigned char>(text[i])) || text[i] == '_' || text[i] == '.');
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!is_word(i)) continue;
    const std::size_t begin = i;
    while (is_word(i)) ++i;
    if (i == begin + 1 && text[begin] >= 'x' && text[begin] <= 'z')
      named[static_cast<std::size_t>(text[begin] - 'x')] = true;
  }
  return named;
}

std::optional<Real> value_at(const PlaceExpression& expression, std::string_view what, const Vec& x,
                             const Variables& variables, Diagnostics& diagnostics) {
  const Evaluation value = evaluate(expression.text, variables, &x);
  if (value.ok()) return value.value;
  diagnostics.error(expression.where, fmt::format("{}: {} at x = {:g}, y = {:g}, z = {:g}, got '{}'", what,
                                                  value.error, x[0], x[1], x[2], expression.text));
  return std::nullopt;
}

}  // namespace courant
