// Laws of strength in the points of beams, where yy, zz and yz of the stress are 0.
#include "laws/strength/beam_stress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "model/build_model.hpp"

using namespace courant;

namespace {

/// A law, with the numbers of one point.
struct BeamPoint {
  explicit BeamPoint(const StrengthLaw& of) : law(of) {
    for (const HistoryVariable& h : of.history()) {
      const std::size_t first = history.size();
      history.resize(first + static_cast<std::size_t>(h.components), 0);
      if (h.name == element_size) history[first] = 1;
    }
  }
  PointBlock block() {
    PointBlock out;
    out.count = 1, out.dt = dt, out.sound_speed = &c;
    numbers.clear();
    for (Real& one : history) numbers.push_back(&one);
    out.history = numbers;
    for (std::size_t k = 0; k < 6; ++k) out.stress[k] = &stress[k], out.rate[k] = &rate[k];
    return out;
  }
  const StrengthLaw& law;
  std::array<Real, 6> stress{}, rate{};
  std::vector<Real> history;
  std::vector<Real*> numbers;
  Real dt = 1e-6, c = 0;
};

void for_each_law_of_beams(const std::function<void(const std::string&, const StrengthLaw&)>& body) {
  for (const StrengthEntry& kind : strength_registry())
    for (const StrengthReference& r : kind.references) {
      ReadOptions options;
      options.open = [&](const std::string&) {
        return std::optional<std::string>("*KEYWORD\n*" + kind.keyword + "\n" + r.deck + "*END\n");
      };
      Diagnostics diagnostics;
      const Deck deck = read_deck("m.k", options, diagnostics);
      const Model model = build_model(deck, diagnostics);
      for (const auto& [id, law] : kind.all(deck, model))
        if (serves_in_beams(*law)) body(kind.keyword, *law);
    }
}

}  // namespace

// The rate across that comes out, put into the law in three dimensions, must give the same point: so nothing
// acts across the beam, in tension and back, with torsion.
TEST(BeamStress, IsThatOfThreeDimensionsWithTheRateAcross) {
  int laws = 0;
  for_each_law_of_beams([&](const std::string& keyword, const StrengthLaw& law) {
    ++laws;
    BeamPoint beam(law), solid(law);
    Real across = 0, most = 0;
    for (int step = 0; step < 400; ++step) {
      const Real e = step < 250 ? 2e-5 : -2e-5;
      for (BeamPoint* point : {&beam, &solid})
        point->rate = {e / point->dt, 0, 0, 0.3 * e / point->dt, 0, -0.2 * e / point->dt};
      update_in_beam(law, beam.block(), &across);
      solid.rate[1] = solid.rate[2] = across;
      law.update(solid.block());
      most = std::max(most, std::abs(solid.stress[0]));
      ASSERT_NEAR(beam.stress[0], solid.stress[0], 1e-6 * most) << keyword << ", step " << step;
      // trials end at 1e-10 of the stress, one step after the other
      for (const std::size_t k : {1, 2, 4})
        ASSERT_NEAR(solid.stress[k], 0, 1e-6 * most) << keyword << ", step " << step;
    }
    EXPECT_GT(most, 0) << keyword;
  });
  EXPECT_GT(laws, 15);
}
