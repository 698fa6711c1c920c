// Terms of discrete beams, cables, welds, springs, damping by stiffness and of lumped inertias by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "../../verification/beams/beam_decks.hpp"
#include "../../verification/shells/shell_decks.hpp"
#include "../../verification/structures/solid_decks.hpp"
#include "elements/beam/weld.hpp"
#include "elements/discrete/discrete.hpp"
#include "elements/stiffness_damping.hpp"
#include "hexahedra.hpp"
#include "shell_patch.hpp"
#include "state/shared_fields.hpp"

using namespace courant;

namespace element_terms_test {
namespace {

using test::do_nothing;
using test::simulation_of;
using test::beams::BeamDeck;

/// The step that the deck takes first, over TSSFAC 0.9.
Real first_step(const std::string& deck) {
  auto s = simulation_of(deck);
  s->step(do_nothing);
  return s->clock().dt_old / 0.9;
}
/// One free discrete beam along x, of length 2, mass 2 and inertia 0.4.
std::string beam_of_springs(int scoor, const std::string& springs, const std::string& dampers) {
  BeamDeck deck;
  deck.at({0, 0, 0}), deck.at({2, 0, 0});
  deck.beam(1, 1, 2);
  deck.cards = fmt::format("*PART\nbeams\n1,1,1\n*SECTION_BEAM\n1,6,,,,{}\n1.0,0.4\n", scoor) +
               "*MAT_LINEAR_ELASTIC_DISCRETE_BEAM\n1,2.0," + springs + "\n" + dampers + "\n";
  return deck.text(1);
}

}  // namespace

// Two ends of 1 and 0.2: w^2 = 4 k/m along, 4 k/J about; with the lever of SCOOR 3, which shear turns both
// ends by, 4 k/m + k L^2/J. Damping c: w^2 dt^2/4 + c (4/m) dt/2 = 1.
TEST(ElementTerms, StepsOfDiscreteBeamsAreThoseOfTheirModes) {
  EXPECT_NEAR(first_step(beam_of_springs(0, "100.0,0.0,0.0,0.0,0.0,0.0", "0.0")), 2 / std::sqrt(200), 1e-6);
  EXPECT_NEAR(first_step(beam_of_springs(0, "0.0,0.0,0.0,0.0,60.0,0.0", "0.0")), 2 / std::sqrt(4 * 60 / 0.4),
              1e-6);
  EXPECT_NEAR(first_step(beam_of_springs(3, "0.0,100.0,0.0,0.0,0.0,0.0", "0.0")),
              2 / std::sqrt(4 * 100 / 2.0 + 100 * 4 / 0.4), 1e-6);
  const Real w2 = 200, c = 10 * 4 / 2.0;  // K dt^2/4 + C dt/2 = 1
  const Real dt = (-0.5 * c + std::sqrt(0.25 * c * c + w2)) / (0.5 * w2);
  EXPECT_NEAR(first_step(beam_of_springs(0, "100.0,0.0,0.0,0.0,0.0,0.0", "10.0,0.0,0.0,0.0,0.0,0.0")), dt,
              1e-6);
}

// Free beams with levers keep momentum and angular momentum, and energy, in a motion of all six.
TEST(ElementTerms, DiscreteBeamsAreInBalance) {
  for (const int scoor : {0, 2, 3, -1, 1}) {
    auto s = simulation_of(beam_of_springs(scoor, "100.0,200.0,300.0,20.0,40.0,60.0", "0.0"));
    World& world = s->world();
    Field<Real>& spin = *shared_fields::angular_velocity.find(world.nodes.fields);
    const Field<Real>& I = *shared_fields::rotary_inertia.find(world.nodes.fields);
    const Vec v[2] = {Vec(0.3, -0.2, 0.1), Vec(-0.1, 0.4, 0.2)},
              w[2] = {Vec(0.5, 0.3, -0.4), Vec(-0.2, 0.1, 0.6)};
    for (Index n = 0; n < 2; ++n) world.nodes.v.set(n, v[n]), spin.set(n, w[n]);
    const auto momenta = [&] {
      Vec p = Vec::Zero(), L = Vec::Zero();
      for (Index n = 0; n < 2; ++n) {
        p += world.nodes.m[n] * world.nodes.v.vec(n);
        L += world.nodes.m[n] * world.nodes.x.vec(n).cross(world.nodes.v.vec(n)) + I[n] * spin.vec(n);
      }
      return std::pair(p, L);
    };
    EXPECT_NEAR(I[0], 0.2, 1e-12);
    const auto start = momenta();
    test::start_ledger(*s);
    for (int k = 0; k < 60; ++k) s->step(do_nothing);
    EXPECT_NEAR((momenta().first - start.first).norm(), 0, 1e-12) << scoor;
    // forces without the lever act along the line between the ends only to first order of their motion
    if (scoor == 3 || scoor == 2)
      EXPECT_NEAR((momenta().second - start.second).norm(), 0, scoor == 3 ? 1e-9 : 1.0) << scoor;
    EXPECT_LT(test::energy_error_of_a_step(*s), 0.05) << scoor;
  }
}

namespace {

/// A cable 2 long along x, of K = E CA/L = 1000 and mass 0.1, its end driven with 0.5.
std::unique_ptr<Simulation> cable(const std::string& law, const std::string& more) {
  BeamDeck deck;
  deck.at({0, 0, 0}, ",7,7"), deck.at({2, 0, 0}, ",5,7");
  deck.beam(1, 1, 2);
  deck.part(1, "6\n1e-4,0.0,0,1e-4\n", "*MAT_CABLE_DISCRETE_BEAM\n" + law + "\n");
  deck.cards +=
      "*BOUNDARY_PRESCRIBED_MOTION_NODE\n2,1,0,1\n*DEFINE_CURVE\n1\n0.0,0.5\n1e9,0.5\n"
      "*CONTROL_TIMESTEP\n0.0,0.1\n" +
      more;
  return simulation_of(deck.text(10));
}
Real tension_of(const Simulation& s) {
  return dynamic_cast<const Field<Real>*>(s.world().groups.at(0)->fields.find("axial_force"))->data()[0];
}

}  // namespace

// Stretched by 0.5 t its tension is K 0.5 t; pressed together it does not push.
TEST(ElementTerms, CablesCarryTensionAlone) {
  auto s = cable("1,1000.0,2e7", "");
  while (s->clock().t < 0.2) s->step(do_nothing);
  EXPECT_NEAR(tension_of(*s), 1000 * 0.5 * (s->clock().t - s->clock().dt_old), 1);
  for (int k = 0; k < 2; ++k) s->step(do_nothing);
  const Real K = 1000, F = tension_of(*s), length = 2 + 0.5 * (s->clock().t - s->clock().dt_old);
  EXPECT_NEAR(s->clock().dt_old / 0.1, std::sqrt(0.1 * 1e-2 * 0 + 1000.0 * 1e-4 / (K + F / length)), 2e-4);
  BeamDeck slack;
  slack.at({0, 0, 0}, ",7,7"), slack.at({2, 0, 0}, ",5,7");
  slack.beam(1, 1, 2);
  slack.part(1, "6\n1e-4,0.0,0,1e-4\n", "*MAT_CABLE_DISCRETE_BEAM\n1,1000.0,2e7\n");
  slack.velocity([](int n) { return Vec(n == 2 ? -1 : 0, 0, 0); });
  auto loose = simulation_of(slack.text(1));
  for (int k = 0; k < 20; ++k) loose->step(do_nothing);
  EXPECT_EQ(loose->world().nodes.v.data(0)[1], -1);
}

// NF 4: the mean over that many steps breaks the weld, wherever they are in the memory of the last ones: (360
// + 3 x 10)/4 does not, (360 + 40 + 2 x 10)/4 does; over three or five others would.
TEST(ElementTerms, WeldsFailByTheMeanOfTheirSteps) {
  for (int shift = 0; shift < 4; ++shift) {
    World world;
    FieldSet& set = world.add_set("welds");
    set.resize(1);
    ElementGroup group(set, 0, 2);
    WeldSections sections(WeldStrength{.most = {100, 0, 0, 0, 0, 0}, .filter = 4}, group);
    const auto look = [&](Real tension) { return sections.look(0, {tension, 0, 0, 0, 0, 0}, 1); };
    for (int k = 0; k < 4 + shift; ++k) EXPECT_EQ(look(10), "");
    EXPECT_EQ(look(360), "") << shift;
    EXPECT_NE(look(40), "") << shift;
  }
}

// Sum of squares over the strengths: tension counts, pressure does not; each strength that of its own force.
TEST(ElementTerms, WeldsCarryEachForceByItsOwnStrength) {
  MatSpotweld card;
  card.nrr = 10, card.nrs = 20, card.nrt = 30, card.mrr = 40, card.mss = 50, card.mtt = 60;
  const WeldStrength strength = weld_strength(card);
  const SectionForces forces{1, 2, 3, 4, 5, 6};  // tension, torsion, about s, about t, shear along s and t
  const auto square = [](Real a) { return a * a; };
  EXPECT_NEAR(strength.used(forces),
              square(1 / 10.) + square(2 / 40.) + square(3 / 50.) + square(4 / 60.) + square(5 / 20.) +
                  square(6 / 30.),
              1e-14);
  EXPECT_NEAR(strength.used({-1, -2, 0, 0, 0, 0}), square(2 / 40.), 1e-14);
}

namespace {

struct Elastic : StrengthLaw {
  void update(const PointBlock&) const override {}
  Real bulk_modulus() const override { return 5; }
  Real shear_modulus() const override { return 2; }
};

}  // namespace

// beta C:D with the pressure of its trace; the work of the old one, turned with the element. In shells that
// of plane stress.
TEST(ElementTerms, DampingByStiffnessIsBetaTimesTheElasticRate) {
  World world;
  FieldSet& set = world.add_set("solids");
  set.resize(1);
  ElementGroup group(set, 0, 8);
  StiffnessDamping damping(-0.1, {}, group, 1, 1);  // beta 0.1
  Elastic law;
  Real rate[6] = {0.1, 0.2, -0.05, 0.03, -0.02, 0.07}, stress[6] = {1, 2, 3, 4, 5, 6};
  const Real dt = 0.01;
  PointBlock points;
  points.count = 1, points.dt = dt;
  for (std::size_t k = 0; k < 6; ++k) points.rate[k] = &rate[k], points.stress[k] = &stress[k];
  const Real angle = 0.8, no = 0, half = std::tan(0.5 * angle), volume = 3;
  Real work = 0;
  const auto add = [&](const Real& about_z) {
    damping.add(law, 0, points, {0, {&no, &no, &about_z}, &volume, &work});
  };
  add(no);
  Matrix D, s;
  D << 0.1, 0.03, 0.07, 0.03, 0.2, -0.02, 0.07, -0.02, -0.05;
  s << 1, 4, 6, 4, 2, 5, 6, 5, 3;
  const Matrix C = 0.1 * ((5 - 4.0 / 3) * D.trace() * Matrix::Identity() + 4 * D);
  const int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  for (int k = 0; k < 6; ++k)
    EXPECT_NEAR(damping.damped(0, k)[0], s(row[k], column[k]) + C(row[k], column[k]), 1e-12) << k;
  EXPECT_EQ(work, 0) << "there was none before";
  add(half);
  Real best =
      1e300;  // whichever measure of the half turn there is, the old stress turns by `angle`, not by 0
  for (const Real turned : {angle, 2 * std::atan(half)}) {
    const Matrix R = Eigen::AngleAxisd(turned, Vec::UnitZ()).toRotationMatrix();
    best = std::min(best, std::abs(work - 0.5 * dt * volume * (R * C * R.transpose()).cwiseProduct(D).sum()));
  }
  EXPECT_NEAR(best, 0, 1e-6);
  EXPECT_GT(std::abs(work - 0.5 * dt * volume * C.cwiseProduct(D).sum()), 1e-5) << "it turned";

  FieldSet& of_shells = world.add_set("shells");
  of_shells.resize(1);
  ElementGroup shells(of_shells, 1, 4);
  StiffnessDamping plane(-0.1, {}, shells, 1, 0);
  plane.add_in_plane(law, 0, points, 0);
  const Real E = 9 * 5 * 2 / (3 * 5.0 + 2), nu = E / 4 - 1, modulus = E / (1 - nu * nu);
  const Real expected[6] = {
      modulus * (0.1 + nu * 0.2), modulus * (0.2 + nu * 0.1), 0, 4 * 0.03, -4 * 0.02, 4 * 0.07};
  for (int k = 0; k < 6; ++k)
    if (k != 2) EXPECT_NEAR(plane.damped(0, k)[0], stress[k] + 0.1 * expected[k], 1e-12) << k;
}

// q = rho l (Q1 l e^2 + Q2 c e) with the density of now: of a cube that is half as long along x, rho is 2, l
// the cube root of 1/2, c of the law; its power is q tr D V.
TEST(ElementTerms, BulkViscosityHasTheDensityOfNow) {
  test::Hexahedra g = test::Hexahedra::brick({1, 1, 1}, Vec(1, 1, 1), 0);
  for (Vec& x : g.x) x[0] *= 0.5;
  g.lambda = g.shear = 1e-9;  // its sound speed is small
  g.control.Q1 = 1.5, g.control.Q2 = 0.5, g.control.QM = 0;
  const Real rate = -2;
  for (std::size_t n = 0; n < g.x.size(); ++n) g.v[n] = Vec(rate * g.x[n][0], 0, 0);
  const Real dt = 1e-6;
  g.advance(dt);
  const Real l = std::cbrt(0.5), c = std::sqrt(3e-9 / 2), q = 2 * l * 2 * (1.5 * l * 2 + 0.5 * c);
  Real push = 0;
  for (int c8 = 0; c8 < 8; ++c8)
    if (g.x[static_cast<std::size_t>(g.corner[c8][0])][0] > 0.1) push += g.corner_force[3 * c8][0];
  EXPECT_NEAR(push, q, 1e-4 * q) << "on a face of area 1";
}

// In expansion there is none.
TEST(ElementTerms, BulkViscosityIsOfCompressionAlone) {
  test::Hexahedra g = test::Hexahedra::brick({1, 1, 1}, Vec(1, 1, 1), 0);
  g.lambda = g.shear = 1e-9, g.control.Q1 = 1.5, g.control.Q2 = 0.5, g.control.QM = 0;
  for (std::size_t n = 0; n < g.x.size(); ++n) g.v[n] = Vec(2 * g.x[n][0], 0, 0);
  g.advance(1e-6);
  for (int k = 0; k < 24; ++k) EXPECT_NEAR(g.corner_force[k][0], 0, 1e-12);
}

// A shell that bends alone, with ISTUPD 1, keeps its thickness: its layers thin and thicken alike.
TEST(ElementTerms, BentShellsKeepTheirThickness) {
  for (const int points : {2, 3}) {
    test::ShellDeck deck;
    deck.plate(1, 1, 1, 1, 1);
    deck.part(1, 0.1, "*MAT_ELASTIC\n1,1000.0,1.0E6,0.3\n", points);
    deck.cards += "*CONTROL_SHELL\n,,,1\n";
    auto s = simulation_of(deck.text(1));
    Field<Real>& spin = *shared_fields::angular_velocity.find(s->world().nodes.fields);
    for (Index n = 0; n < 4; ++n) spin.set(n, Vec(0, s->world().nodes.x.data(0)[n] > 0.5 ? 1 : -1, 0));
    for (int k = 0; k < 10; ++k) s->step(do_nothing);
    const auto* t = dynamic_cast<const Field<Real>*>(s->world().groups.at(0)->fields.find("shell_thickness"));
    ASSERT_NE(t, nullptr);
    EXPECT_NEAR(t->data()[0], 0.1, 1e-6) << points;  // of the square of the strains of 1e-3
  }
}

// A node that turns with 3 and another with 5 by tensors of their own: a fifth of a radian of the quicker
// one.
TEST(ElementTerms, NodesThatTurnAskForAFifthOfARadianAStep) {
  const std::string deck =
      "*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*NODE\n1,0.0,0.0,0.0\n2,1.0,0.0,0.0\n*ELEMENT_INERTIA\n"
      "       1       1\n       1.0       0.0       0.0       2.0       0.0       3.0       5.0\n"
      "       2       2\n       1.0       0.0       0.0       2.0       0.0       3.0       5.0\n*END\n";
  auto s = simulation_of(deck);
  Field<Real>& spin = *shared_fields::angular_velocity.find(s->world().nodes.fields);
  spin.set(0, Vec(0, 0, 300)), spin.set(1, Vec(0, 500, 0));
  s->step(do_nothing);
  Real least = 1e300;
  for (auto* limit : s->world().passes.all<TimeLimit>())
    least = std::min(least, limit->limit(s->world(), s->clock()).dt);
  EXPECT_NEAR(least, 0.2 / 500, 1e-9);
}

// KD and V0, S, OFFSET and the direction of a spring: S (1 + KD |V|/V0) K (L - L0 + OFFSET); its energy of
// the start is K OFFSET^2/2.
TEST(ElementTerms, SpringsByTheirCards) {
  struct Case {
    std::string element, section;
    Real force, energy;
  };
  // node 2 goes away along x with 2; at t = 0 the stretch is OFFSET
  for (const Case& one : {Case{"0,0,1.0,0,0.0", "0,0.0,0.0", 0, 0},
                          {"0,0,1.0,0,0.05", "0,0.0,0.0", 5, 0.125},
                          {"0,0,3.0,0,0.05", "0,0.0,0.0", 15, 0.375},
                          {"0,0,1.0,0,0.05", "0,0.5,4.0", 5 * (1 + 0.5 * 2 / 4), 0.125}}) {
    const std::string deck =
        "*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*NODE\n1,0.0,0.0,0.0,7,7\n2,1.0,0.0,0.0,5,7\n*PART\nspring\n1,"
        "1,1\n"
        "*SECTION_DISCRETE\n1," +
        one.section + "\n*MAT_SPRING_ELASTIC\n1,100.0\n*ELEMENT_DISCRETE\n1,1,1,2," + one.element.substr(2) +
        "\n*ELEMENT_MASS\n       1       2             1.0\n*INITIAL_VELOCITY_NODE\n2,2.0\n*END\n";
    auto s = simulation_of(deck);
    ASSERT_NE(s, nullptr);
    test::start_ledger(*s);
    EXPECT_NEAR(s->world().energy.discrete, one.energy, 1e-9) << one.element;
    EXPECT_NEAR(s->world().energy.internal, one.energy, 1e-9) << one.element;
    std::vector<SpringForce> springs;
    for (const auto* pass : s->world().passes.all<const SpringReporter>()) pass->report_springs(springs);
    EXPECT_NEAR(springs.at(0).force[0], one.force, 1e-9) << one.element << one.section;
    EXPECT_NEAR(springs.at(0).resultant, one.force, 1e-9);
  }
}

// Each part of a shell's motion gives its own generalised force: membrane, bending, twist and transverse
// shear of one square element, of E 2, nu 0.25 and thickness t, per unit of time.
TEST(ElementTerms, ShellsAnswerEachMotionByItsOwnModulus) {
  const Real t = 0.2, E = 2, nu = 0.25, G = E / (2 * (1 + nu)), plate = E / (1 - nu * nu), dt = 1e-3;
  struct Case {
    const char* what;
    Vec (*v)(const Vec&);
    Vec (*w)(const Vec&);
    Real energy;  ///< 1/2 strain . stress of the motion through dt, over dt^2
  };
  const auto none = [](const Vec&) { return Vec(0, 0, 0); };
  const Case cases[] = {
      {"stretch", [](const Vec& x) { return Vec(x[0], 0, 0); }, none, 0.5 * plate * t},
      {"shear", [](const Vec& x) { return Vec(x[1], 0, 0); }, none, 0.5 * G * t},
      {"bend x", none, [](const Vec& x) { return Vec(0, x[0], 0); }, 0.5 * plate * t * t * t / 12},
      {"bend y", none, [](const Vec& x) { return Vec(-x[1], 0, 0); }, 0.5 * plate * t * t * t / 12},
      {"both", none, [](const Vec& x) { return Vec(-x[1], x[0], 0); }, (1 + nu) * plate * t * t * t / 12},
      {"twist", none, [](const Vec& x) { return Vec(-x[0], x[1], 0); }, 2 * G * t * t * t / 12},
      {"across x", [](const Vec& x) { return Vec(0, 0, x[0]); }, none, 0.5 * 5.0 / 6 * G * t},
      {"across y", [](const Vec& x) { return Vec(0, 0, x[1]); }, none, 0.5 * 5.0 / 6 * G * t},
      {"lean x", none, [](const Vec&) { return Vec(0, 1, 0); }, 0.5 * 5.0 / 6 * G * t},
      {"lean y", none, [](const Vec&) { return Vec(1, 0, 0); }, 0.5 * 5.0 / 6 * G * t},
      {"turn", [](const Vec& x) { return Vec(-x[1], x[0], 0); }, none, 0},
      {"tilt", [](const Vec& x) { return Vec(0, 0, x[0]); }, [](const Vec&) { return Vec(0, -1, 0); }, 0}};
  for (const int corners : {4, 3})
    for (const Case& one : cases) {
      if (corners == 3 && std::string(one.what) == "twist") continue;  // no linear field: it shears, too
      test::ShellPatch g = test::ShellPatch::plate(1, 1, corners, 0, t);
      g.control.shear_factor = 5.0 / 6;
      for (std::size_t n = 0; n < g.x.size(); ++n) {
        const Vec x = g.x[n] - Vec(0.5, 0.5, 0);
        g.v[n] = one.v(x), g.w[n] = one.w(x);
      }
      const auto before = g.x;
      for (std::size_t n = 0; n < g.x.size(); ++n) g.x[n] += dt * g.v[n];
      g.advance(dt);
      Real internal = 0, power = 0;
      for (const Real e : g.internal) internal += e;
      EXPECT_NEAR(internal, one.energy * dt * dt, 3e-3 * dt * dt * (0.001 + one.energy))
          << one.what << corners;
      const auto loads = g.on_nodes();
      for (std::size_t n = 0; n < g.x.size(); ++n)
        power += loads.force[n].dot(g.v[n]) + loads.moment[n].dot(g.w[n]);
      EXPECT_NEAR(std::abs(power), 2 * one.energy * dt, 6e-3 * dt * (0.001 + one.energy))
          << one.what << corners;
    }
}

namespace {

/// A weld 1.6 long along z whose upper end turns about it with 1000 and does nothing else.
std::unique_ptr<Simulation> turning_weld(Real most_torsion) {
  auto s = simulation_of(fmt::format(
      "*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*PART\nweld\n1,1,1\n*SECTION_BEAM\n1,9,1.0\n5.0,5.0,0.0,0.0\n"
      "*NODE\n1,0.0,0.0,0.0,7,7\n2,0.0,0.0,1.6,7,4\n*ELEMENT_BEAM\n       1       1       1       2\n"
      "*MAT_SPOTWELD\n1,7.85e-9,205000.0,0.3,1.0e9\n0.0,0.0,0.0,0.0,{:.9g}\n*END\n",
      most_torsion));
  shared_fields::angular_velocity.find(s->world().nodes.fields)->set(1, Vec(0, 0, 1000));
  test::start_ledger(*s);
  return s;
}
Real torsion_of(const Simulation& s) {
  std::vector<WeldForce> welds;
  for (const auto* pass : s.world().passes.all<const WeldReporter>()) pass->report_welds(s.world(), welds);
  return welds.at(0).torsion;
}

}  // namespace

// What fails in the midst of its motion has done its moment's half of the step before: that is taken back, so
// that what is lost and what moves on make up the energy of the start.
TEST(ElementTerms, DeletionTakesBackTheWorkOfMoments) {
  auto whole = turning_weld(1e9);
  Real before = 0, most = 0, torsion = 0;
  for (int k = 0; k < 60; ++k)
    whole->step([&](World& world, const Clock& clock, const std::string&) {
      sample_energy(world, clock);
      if (world.energy.internal - before > most)
        most = world.energy.internal - before, torsion = std::abs(torsion_of(*whole));
      before = world.energy.internal;
    });
  ASSERT_GT(most, 0);
  auto s = turning_weld(0.999 * torsion);
  for (int k = 0; k < 60 && s->world().counters["deleted_elements"] == 0; ++k) s->step(do_nothing);
  ASSERT_EQ(s->world().counters["deleted_elements"], 1);
  s->step([&](World& world, const Clock& clock, const std::string&) { sample_energy(world, clock); });
  EXPECT_NEAR(s->world().energy.residual(), 0, 0.1 * most) << "half of a step's change of energy else";
}

// With a preload that is held until 0.4 the length of no force is that of then; the strain at which it breaks
// is of the length at the start: (L - 2.2)/2.
TEST(ElementTerms, CablesBreakAtTheStrainOfTheirFirstLength) {
  auto s = cable("1,1000.0,2e7,0,50.0,0.4,0.0,1\n0,0.0,0.0,0.2", "");
  ASSERT_NE(s, nullptr);
  Real length = 0;
  for (int k = 0; k < 20000 && s->clock().t < 1.5; ++k) {
    s->step(do_nothing);
    if (tension_of(*s) > 0) length = s->world().nodes.x.data(0)[1];
  }
  EXPECT_NEAR(length, 2.2 + 0.2 * 2, 5e-3);
}

// q = rho l (Q1 l e^2 + Q2 c e) in compression alone, with the density and the size of now, worked out for an
// equation of state; what it takes of the work is q and that of before through what the element opens.
TEST(ElementTerms, ViscosityOfFluidsHasTheDensityOfNow) {
  for (const Real rate : {-2.0, 2.0}) {
    Real V0 = 3, rho0 = 5, viscous = 0.7;
    SolidState state{};
    state.V0 = &V0, state.rho0 = &rho0, state.viscous_pressure = &viscous;
    SolidScratch scratch;
    SolidControl control;
    control.Q1 = 1.5, control.Q2 = 0.5;
    scratch.compression[0] = 1, scratch.sound_speed[0] = 4, scratch.work[0] = 10;
    scratch.rate[0][0] = rate, scratch.rate[1][0] = 0.25 * rate, scratch.rate[2][0] = -0.5 * rate;
    scratch.opened[0][0] = 0.01, scratch.opened[1][0] = 0.02;
    test::Hexahedra::brick({1, 1, 1}, Vec(1, 1, 1), 0).loops.viscosity({0, 1, 0.1}, control, state, scratch);
    const Real l = std::cbrt(1.5), closing = std::max(-0.75 * rate, 0.0);
    const Real q = 10 * l * closing * (1.5 * l * closing + 0.5 * 4);
    EXPECT_NEAR(viscous, q, 1e-6 * (1 + q)) << rate;
    EXPECT_NEAR(scratch.work[0], 10 - 0.7 * 0.01 - q * 0.02, 1e-6 * (1 + q)) << rate;
  }
}

// Hourglass moments of a bent square: of QB alone, and of its size: t^3 of a stiffness whatever the size, t^2
// A of a viscosity.
TEST(ElementTerms, HourglassMomentsOfShellsAreOfQb) {
  const auto moment = [](bool stiffness, Real QM, Real QB, Real size, Real* energy = nullptr) {
    test::ShellPatch g = test::ShellPatch::plate(1, 1, 4, 0, 0.2);
    g.control.stiffness = stiffness, g.control.QM = g.control.QW = QM, g.control.QB = QB;
    for (std::size_t n = 0; n < 4; ++n) g.x[n] *= size;
    g.mass[0] *= size * size;
    const Real sign[4] = {1, -1, -1, 1};  // nodes row by row
    for (std::size_t n = 0; n < 4; ++n) g.w[n] = Vec(sign[n], 0, 0);
    g.advance(1e-3);
    g.advance(1e-3);
    if (energy) *energy = g.hourglass_energy[0];
    return std::abs(g.on_nodes().moment[0][0]);
  };
  for (const bool stiffness : {true, false}) {
    Real energy = 0;
    const Real one = moment(stiffness, 0.1, 0.1, 1, &energy);
    EXPECT_GT(one, 0);
    EXPECT_NEAR(moment(stiffness, 0.3, 0.1, 1) / one, 1, 1e-9) << stiffness;
    EXPECT_NEAR(moment(stiffness, 0.1, 0.3, 1) / one, 3, 1e-9) << stiffness;
    EXPECT_NEAR(moment(stiffness, 0.1, 0.1, 2) / one, stiffness ? 1 : 4, 1e-9) << stiffness;
    // means of the forces before and after each step, of a rate of 4 nodes: 0 + 1/2 and 1/2 + 1; viscous 1/2
    // and 1
    EXPECT_NEAR(energy, 4 * one * 1e-3 * (stiffness ? 0.5 * (0.5 + 1.5) / 1 * 0.5 * 2 : 1.5),
                4 * one * 1e-3 * 1e-6)
        << stiffness;
  }
}

// ADDMASS is spread over the nodes of a part by area: of two shells of 1 and 3, an eighth and three eighths
// of it on each corner, in all ADDMASS; FINMASS is the mass with it.
TEST(ElementTerms, MassesOfPartsAreSpreadByArea) {
  for (const bool final_mass : {false, true}) {
    test::ShellDeck deck;
    deck.plate(4, 1, 2, 1, 1, [](const Vec& x) { return Vec(x[0] > 1 && x[0] < 3 ? 1 : x[0], x[1], 0); });
    deck.part(1, 0.1, "*MAT_ELASTIC\n1,10.0,1.0E6,0.3\n");
    deck.cards += fmt::format("*ELEMENT_MASS_PART\n       1{:>16}{:>16}\n", final_mass ? "0.0" : "8.0",
                              final_mass ? "12.0" : "0.0");
    auto s = simulation_of(deck.text(1));
    const Nodes& nodes = s->world().nodes;
    for (const Index n : {0, 3}) EXPECT_NEAR(nodes.m[n], (1 + 2) * 0.25, 1e-12) << n;
    for (const Index n : {2, 5}) EXPECT_NEAR(nodes.m[n], (3 + 6) * 0.25, 1e-12) << n;
    for (const Index n : {1, 4}) EXPECT_NEAR(nodes.m[n], (4 + 8) * 0.25, 1e-12) << n;
  }
}

}  // namespace element_terms_test
