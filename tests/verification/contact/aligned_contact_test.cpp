// Blocks on floors of the same grid: nodes exactly over edges, and outer edges exactly over outer edges.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "shell_decks.hpp"
#include "solid_decks.hpp"

using namespace courant;
using test::simulation_of;
using test::SolidDeck;

namespace aligned_contact_test {
namespace {

using Turn = Eigen::Matrix3d;

struct Slide {
  std::string kind;
  bool shells = false, rigid = false, turned = false;
  Real speed = 1, friction = 0, width = 0.2;
  /// Of the block from the floor, as long as it is in flight, [L], [L/T].
  Vec from = Vec::Zero();
  Real sinks = 0, weight = 9.81;
};

std::string name_of(const Slide& s) {
  return fmt::format("{} shells {} rigid {} turned {} speed {}", s.kind, s.shells, s.rigid, s.turned,
                     s.speed);
}

/// A cube of 0.2 m and 8 kg on a held floor of 1.2 m, both of cells of 0.1 m.
std::string deck_of(const Slide& s, Real until) {
  const Turn turn = s.turned ? Turn(Eigen::AngleAxisd(0.83, Vec(1, -2, 0.7).normalized())) : Turn::Identity();
  const auto shifted = [&](const Vec& by) { return [=](const Vec& x) { return Vec(turn * (x + by)); }; };
  const Real thickness = 0.01, top = s.shells ? 0.5 * thickness : 0;
  SolidDeck deck;
  deck.block(Vec(0.2, 0.2, 0.2), 2, 2, 2, 1, shifted(Vec(s.from + Vec(0, 0.5 * (s.width - 0.2), top))));
  const int across = static_cast<int>(std::lround(s.width / 0.1));
  if (!s.shells) deck.block(Vec(1.2, s.width, 0.1), 12, across, 1, 2, shifted(Vec(0, 0, -0.1)));
  std::string floor;
  if (s.shells) {
    test::ShellDeck plate;
    plate.plate(1.2, s.width, 12, across, 2);
    const std::size_t first = deck.nodes.size();
    for (const Vec& x : plate.nodes) deck.nodes.push_back(turn * x);
    floor = "*ELEMENT_SHELL\n";
    for (int j = 0; j < across; ++j)
      for (int i = 0; i < 12; ++i) {
        const std::size_t n = first + 1 + static_cast<std::size_t>(i + 13 * j);
        floor += fmt::format("{:8}{:8}{:8}{:8}{:8}{:8}\n", 1000 + i + 12 * j, 2, n, n + 1, n + 14, n + 13);
      }
  }
  const std::string sides = s.kind == "AUTOMATIC_SINGLE_SURFACE" ? "0" : "1,2,3,3";
  const Vec v = turn * Vec(s.speed, 0, -s.sinks), g = turn * Vec(0, 0, s.weight);
  deck.cards = "*SECTION_SOLID\n1,1\n*SECTION_SHELL\n2,2\n0.01,0.01,0.01,0.01\n*HOURGLASS\n1,6,1.0\n";
  deck.cards +=
      fmt::format("*PART\nblock\n1,1,1,,1\n*MAT_{}\n1,1000.0,1e7,0.3\n", s.rigid ? "RIGID" : "ELASTIC");
  deck.cards += fmt::format("*PART\nfloor\n2,{},2\n*MAT_RIGID\n2,1000.0,1e7,0.3\n1,7,7\n", s.shells ? 2 : 1);
  deck.cards += fmt::format("*CONTACT_{}\n{}\n{:g},{:g}\n\n", s.kind, sides, s.friction, s.friction);
  deck.cards +=
      fmt::format("*INITIAL_VELOCITY_GENERATION\n1,2,0.0,{:.16g},{:.16g},{:.16g}\n0\n", v[0], v[1], v[2]);
  deck.cards += "*DEFINE_CURVE\n9\n0,1\n99,1\n";
  for (Eigen::Index k = 0; k < 3; ++k)
    if (std::abs(g[k]) > 1e-12) deck.cards += fmt::format("*LOAD_BODY_{}\n9,{:.16g}\n", "XYZ"[k], g[k]);
  std::string text = deck.text(until);
  return text.insert(text.find("*ELEMENT_SOLID"), floor);
}

/// Its speed along the floor at the end, of that of the start, and the energy that came, of the kinetic one.
std::pair<Real, Real> slid(const Slide& s, Real until) {
  const auto sim = simulation_of(deck_of(s, until));
  test::start_ledger(*sim);
  const World& world = sim->world();
  const Turn turn = s.turned ? Turn(Eigen::AngleAxisd(0.83, Vec(1, -2, 0.7).normalized())) : Turn::Identity();
  Real made = 0;
  while (sim->clock().t < until)
    sim->step([&](World& w, const Clock& clock, const std::string&) {
      sample_energy(w, clock);
      made = std::max(made, w.energy.unexplained());
    });
  Vec p = Vec::Zero();
  Real m = 0;
  for (Index n = 0; n < world.nodes.size(); ++n) {
    if (world.nodes.held[n]) continue;
    p += world.nodes.m[n] * world.nodes.v.vec(n), m += world.nodes.m[n];
  }
  return {(turn.transpose() * p)[0] / (m * s.speed), made / (0.5 * 8 * s.speed * s.speed)};
}

}  // namespace

// A floor as wide as the block: where a corner of the one comes through two faces of the other in one step,
// it touched the upright one, which stopped blocks and made energy.
TEST(AlignedContact, ABlockKeepsItsSpeedOnAFloorAsWideAsItIs) {
  int k = 0;
  for (const bool shells : {false, true})
    for (const bool rigid : {false, true})
      for (const Real speed : {0.3, 1.0, 5.0})
        for (const char* kind :
             {"AUTOMATIC_SURFACE_TO_SURFACE", "AUTOMATIC_SINGLE_SURFACE", "AUTOMATIC_NODES_TO_SURFACE"}) {
          if (++k % 2 == 0 && speed > 0.3) continue;
          const Slide s{.kind = kind, .shells = shells, .rigid = rigid, .turned = k % 3 == 0, .speed = speed};
          const auto [left, made] = slid(s, std::min(0.5 / speed, 0.4));
          EXPECT_NEAR(left, 1, 0.02) << name_of(s);
          EXPECT_LT(made, 0.02) << name_of(s);
        }
}

// Nodes over an outer edge are, by rounding, within none of the faces along it: they fade off that edge
// alone.
TEST(AlignedContact, NodesFollowTheEdgeThatTheyAreOver) {
  for (const bool rigid : {false, true}) {
    const Slide s{
        .kind = "AUTOMATIC_NODES_TO_SURFACE", .shells = true, .rigid = rigid, .turned = rigid, .speed = 0.3};
    const auto [left, made] = slid(s, 0.8);
    EXPECT_NEAR(left, 1, 0.01) << name_of(s);
    EXPECT_LT(made, 0.01) << name_of(s);
  }
}

// It flies onto the floor, a little down, its sides exactly over those of the floor.
TEST(AlignedContact, ABlockThatArrivesFromOutsideMakesNoEnergy) {
  for (const bool shells : {false, true})
    for (const bool rigid : {false, true}) {
      const Slide s{.kind = "AUTOMATIC_SURFACE_TO_SURFACE",
                    .shells = shells,
                    .rigid = rigid,
                    .turned = rigid,
                    .width = shells == rigid ? 0.2 : 0.4,
                    .from = Vec(-0.25, 0, 0.003),
                    .sinks = 0.02,
                    .weight = 0};
      const auto [left, made] = slid(s, 0.4);
      EXPECT_NEAR(left, 1, 0.02) << name_of(s);
      EXPECT_LT(made, 0.01) << name_of(s);
    }
}

}  // namespace aligned_contact_test
