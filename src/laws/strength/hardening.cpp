#include "laws/strength/hardening.hpp"

#include <fmt/format.h>

namespace courant {

void drop_blank_points(Hardening& table) {
  while (!table.strain.empty() && table.strain.back() == 0 && table.stress.back() == 0)
    table.strain.pop_back(), table.stress.pop_back();
}

void check_points(const Deck& deck, const Entry& card, const Hardening& points, Real G,
                  Diagnostics& diagnostics) {
  const std::size_t n = points.strain.size();
  if (n == 1)
    deck.error(diagnostics, card, "EPS2", "expected a second point of the table",
               "a constant yield stress is SIGY without a table");
  if (points.strain[0] != 0)
    deck.error(diagnostics, card, "EPS1", fmt::format("expected 0, got '{:g}'", points.strain[0]),
               "the table starts where plastic strain does");
  for (std::size_t k = 0; k < n; ++k) {
    if (k > 0 && !(points.strain[k] > points.strain[k - 1]))
      deck.error(diagnostics, card, fmt::format("EPS{}", k + 1),
                 fmt::format("expected a number > {:g}, got '{:g}'", points.strain[k - 1], points.strain[k]),
                 "plastic strains of the table increase");
    if (!(points.stress[k] > 0))
      deck.error(diagnostics, card, fmt::format("ES{}", k + 1),
                 fmt::format("expected a number > 0, got '{:g}'", points.stress[k]));
    if (k > 0 && points.strain[k] > points.strain[k - 1] && !(points.slope(k - 1) > -3 * G))
      deck.error(diagnostics, card, fmt::format("ES{}", k + 1), falls_too_fast);
  }
}

}  // namespace courant
