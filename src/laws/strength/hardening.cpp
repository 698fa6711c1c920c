#include "laws/strength/hardening.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace courant {

void drop_blank_points(Hardening& table) {
  while (!table.strain.empty() && table.strain.back() == 0 && table.stress.back() == 0)
    table.strain.pop_back(), table.stress.pop_back();
}

SteepestFall steepest_fall_in_solids(Real G) {
  return {-3 * G, "the yield stress falls faster than 3 G: stress has no unique answer"};
}

SteepestFall steepest_fall(const Model& model, Id mid, Real E, Real nu) {
  const auto in_plies = [mid](const std::vector<ModelPly>& plies) {
    return std::any_of(plies.begin(), plies.end(), [mid](const ModelPly& ply) { return ply.mid == mid; });
  };
  bool shells = std::any_of(model.layups.begin(), model.layups.end(),
                            [&](const ModelLayup& layup) { return in_plies(layup.plies); });
  bool beams = false;
  for (const ModelPart& part : model.parts) {
    shells = shells || in_plies(part.plies) || (part.has_shell && part.mid == mid);
    beams = beams || (part.has_beam && part.mid == mid);
  }
  if (shells && E > 0)
    return {-E / (2 * (1 - nu)),
            "the yield stress falls faster than E/(2 (1 - PR)): stress in shells has no unique answer"};
  if (beams && E > 0)
    return {-E, "the yield stress falls faster than E: stress in beams has no unique answer"};
  return steepest_fall_in_solids(E / (2 * (1 + nu)));
}

void check_points(const Deck& deck, const Entry& card, const Hardening& points, const SteepestFall& fall,
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
    if (k > 0 && points.strain[k] > points.strain[k - 1] && !(points.slope(k - 1) > fall.slope))
      deck.error(diagnostics, card, fmt::format("ES{}", k + 1), fall.too_fast);
  }
}

}  // namespace courant
