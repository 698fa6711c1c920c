#include "post/units.hpp"

#include <cstdlib>

namespace courant {
namespace {

struct NamedUnit {
  Dimension dimension;
  const char* name;
};
constexpr NamedUnit si_names[] = {{{1, -1, -2}, "Pa"}, {{1, 1, -2}, "N"},   {{1, 0, -2}, "N/m"},
                                  {{1, 2, -3}, "W"},   {{1, 1, -3}, "W/m"}, {{0, 0, -1}, "Hz"}};

void add(std::string& to, const std::string& unit, int exponent, int& count) {
  if (exponent == 0) return;
  to += (count++ ? " " : "") + unit + (exponent > 1 ? std::to_string(exponent) : "");
}

}  // namespace

Dimension parse_dimension(const std::string& text) {
  Dimension out;
  int sign = 1;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '/') sign = -1;
    int* to = text[i] == 'M' ? &out.M : text[i] == 'L' ? &out.L : text[i] == 'T' ? &out.T : nullptr;
    if (!to) continue;
    const bool power = i + 1 < text.size() && text[i + 1] >= '1' && text[i + 1] <= '9';
    *to += sign * (power ? text[i + 1] - '0' : 1);
  }
  return out;
}

std::string PostUnits::of(Dimension d) const {
  if (d.M == 0 && d.L == 0 && d.T == 0) return "-";
  if (mass == "kg" && length == "m" && time == "s")
    for (const NamedUnit& known : si_names)
      if (known.dimension.M == d.M && known.dimension.L == d.L && known.dimension.T == d.T) return known.name;
  std::string above, below;
  int n_above = 0, n_below = 0;
  const auto place = [&](const std::string& unit, int exponent) {
    if (exponent > 0)
      add(above, unit, exponent, n_above);
    else
      add(below, unit, std::abs(exponent), n_below);
  };
  place(mass, d.M);
  place(length, d.L);
  place(time, d.T);
  if (n_below == 0) return above;
  return (n_above ? above : "1") + "/" + (n_below > 1 ? "(" + below + ")" : below);
}

}  // namespace courant
