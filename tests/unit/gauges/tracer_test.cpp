// *DATABASE_TRACER: what trhist prints of particles and nodes.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "../app/small_scene.hpp"
#include "extension/additions.hpp"

namespace courant {
namespace {

std::vector<Real> numbers_of_trhist(Simulation& s) {
  const auto& all = ascii_histories();
  const auto at =
      std::find_if(all.begin(), all.end(), [](const AsciiHistory& one) { return one.name == "trhist"; });
  EXPECT_NE(at, all.end());
  std::istringstream text(at->text(s.world(), s.clock()));
  std::vector<Real> out;
  for (Real number = 0; text >> number;) out.push_back(number);
  return out;
}

TEST(Tracer, FollowsParticlesByPositionAndById) {
  test::SmallScene scene;
  scene.start = "2.,0.5,0.", scene.extra =
                                 "*DATABASE_TRHIST\n0.1\n*DATABASE_TRACER\n0.,0,0.31,0.27\n"
                                 "*DATABASE_TRACER\n0.5,0,,,,,8\n";
  auto s = test::build_deck(scene.text(), false);
  std::string dt_set_by;
  s->evaluate(dt_set_by);
  for (Index i = 0; i < s->world().particles.size(); ++i) s->world().particles.p[i] = 7;
  const std::vector<Real> start = numbers_of_trhist(*s);
  ASSERT_EQ(start.size(), 1U + 2 * 16);
  EXPECT_NEAR(start[1], 0.35, 1e-9);  // the nearest particle
  EXPECT_NEAR(start[2], 0.25, 1e-9);
  EXPECT_EQ(start[4], 2);
  EXPECT_EQ(start[5], 0.5);
  for (const std::size_t stress : {7U, 8U, 9U}) EXPECT_EQ(start[stress], -7);
  EXPECT_EQ(start[10], 0);
  EXPECT_EQ(start[14], 1000);
  EXPECT_NEAR(start[15], 1, 1e-5);
  EXPECT_EQ(start[16], 1);
  EXPECT_NEAR(start[17], 0.15, 1e-9);  // particle 8
  EXPECT_EQ(start[32], 0);             // not before 0.5
  test::run(*s, 0.1);
  const std::vector<Real> later = numbers_of_trhist(*s);
  EXPECT_NEAR(later[1] - 0.35, 2 * later[0], 0.02);
}

TEST(Tracer, OfNoParticleAndWithoutAnIntervalIsTold) {
  Diagnostics diagnostics;
  test::SmallScene scene;
  scene.extra = "*DATABASE_TRACER\n0.,0,,,,,999\n";
  EXPECT_EQ(Simulation::build("deck.k", in_memory(scene.text()), diagnostics), nullptr);
  EXPECT_NE(diagnostics.text().find("node 999 is no particle"), std::string::npos) << diagnostics.text();
  EXPECT_NE(diagnostics.text().find("tracers are written nowhere"), std::string::npos);
}

}  // namespace
}  // namespace courant
