// LAW 2 of *COURANT_WALL_SUPPORT, no slip, and *COURANT_WALL_BELT: forces of a linear flow, which are known,
// and what is kept.
#include <gtest/gtest.h>

#include <cmath>

#include <fmt/format.h>

#include "../app/small_scene.hpp"
#include "sph/core/fields.hpp"

namespace courant {
namespace {

constexpr Real mu = 50, shear = 3, spacing = 0.1;

/// Water over a floor half a spacing below its lowest row; `wall`: what is on *COURANT_WALL_SUPPORT.
std::string held_water(int method, const std::string& wall, const std::string& more = "", int n = 12) {
  test::SmallScene scene;
  scene.n = n;
  scene.material = fmt::format("1,1000.,-1.E20,{}", mu);
  scene.hourglass = "1,0,0,0,1.E-20,1.E-20";
  std::string floor = test::floor_cards(0);
  const std::string thin = "2,2\n0.05\n";
  floor.replace(floor.find(thin), thin.size(), method == 1 ? "2,2\n0.04\n" : "2,2\n0.09999\n");
  scene.extra =
      floor + fmt::format("*COURANT_WALL_SUPPORT\n2,3,{}\n", fmt::format(fmt::runtime(wall), method)) + more;
  return scene.text();
}
const std::string held = "0.,{},2";
const std::string belt = "*COURANT_WALL_BELT\n2,3,0,0.5,4.,0.,0.\n";  // 2 m/s
constexpr Real belt_speed = 2;

/// Evaluated with vx(y).
template <class Speed>
std::unique_ptr<Simulation> sheared(const std::string& text, const Speed& vx) {
  auto s = test::build_deck(text, false);
  if (!s) return s;
  Particles& p = s->world().particles;
  for (Index i = 0; i < p.size(); ++i) p.v.set(i, Vec(vx(p.x.vec(i)[1]), 0, 0));
  std::string who;
  s->evaluate(who);
  return s;
}
Index particle_at(const Particles& p, const Vec& x) {
  Index best = 0;
  for (Index i = 0; i < p.active; ++i)
    if ((p.x.vec(i) - x).norm() < (p.x.vec(best) - x).norm()) best = i;
  return best;
}
/// Force on a particle in column x = 0.55, over mu shear and the width of the column.
Real force_in_row(const Simulation& s, Real y) {
  const Particles& p = s.world().particles;
  return p.f.vec(particle_at(p, Vec(0.55, y, 0)))[0] / (mu * shear * spacing);
}

// Linear flow over the wall has a uniform stress: nothing is pushed, whatever the wall's own velocity is.
TEST(WallDrag, LeavesLinearFlowAlone) {
  for (const int method : {0, 1})
    for (const bool moves : {false, true}) {
      const Real wall = moves ? belt_speed : 0;
      const auto s =
          sheared(held_water(method, held, moves ? belt : ""), [&](Real y) { return wall + shear * y; });
      ASSERT_TRUE(s);
      Real sum = 0;
      for (const Real y : {0.05, 0.15, 0.25}) {
        // an integral over the wall and a sum over a lattice share a stress differently between rows
        EXPECT_NEAR(force_in_row(*s, y), 0, method == 1 ? 2e-4 : 0.06) << method << moves << y;
        sum += force_in_row(*s, y);
      }
      EXPECT_NEAR(sum, 0, method == 1 ? 5e-4 : 0.02) << method << moves;
    }
}

// The same in three dimensions, the moving surface along both directions of its plane.
TEST(WallDrag, LeavesLinearFlowInSpaceAlone) {
  for (const int method : {0, 1}) {
    test::SmallScene scene;
    scene.dim = 3;
    scene.material = fmt::format("1,1000.,-1.E20,{}", mu);
    scene.hourglass = "1,0,0,0,1.E-20,1.E-20";
    scene.extra = test::floor_cards(0) + fmt::format("*COURANT_WALL_SUPPORT\n2,3,0.,{},2\n", method) +
                  "*COURANT_WALL_BELT\n2,3,0,1.,2.,0.,1.\n";
    auto s = test::build_deck(scene.text(), false);
    ASSERT_TRUE(s);
    Particles& p = s->world().particles;
    for (Index i = 0; i < p.size(); ++i)
      p.v.set(i, Vec(2 + shear * p.x.vec(i)[1], 0, 1 - shear * p.x.vec(i)[1]));
    std::string who;
    s->evaluate(who);
    Vec sum = Vec::Zero();
    for (const Real y : {0.05, 0.15, 0.25})
      sum += p.f.vec(particle_at(p, Vec(0.25, y, 0.25))) / (mu * shear * spacing * spacing);
    EXPECT_LT(sum.norm(), method == 1 ? 1e-3 : 0.05) << method << " " << sum.transpose();
  }
}

// The stress on linear flow is mu times the shear.
TEST(WallDrag, IsTheViscousStress) {
  for (const int method : {0, 1}) {
    const auto with = sheared(held_water(method, held), [](Real y) { return shear * y; });
    ASSERT_TRUE(with);
    Particles& p = with->world().particles;
    Real stress = 0;
    for (const Real y : {0.05, 0.15, 0.25, 0.35}) {
      const Index i = particle_at(p, Vec(0.55, y, 0));
      if (method == 1) stress += sph_fields::wall_drag(p).vec(i)[0] / spacing;
    }
    if (method == 0) {  // reported on all of the wall, 1.2 long; columns at its ends feel as much
      for (const InterfaceForce& f : with->sample("").interfaces) stress += f.on_surfa[0] / 1.2;
    }
    EXPECT_NEAR(stress / (-mu * shear), 1, 0.02) << method;
  }
}

// Of the work of a moving surface nothing is lost: water gets it or turns it into heat.
TEST(WallDrag, BooksTheWorkOfABelt) {
  for (const int method : {0, 1})
    for (const std::string& wall : {held, std::string("0.05,{}"), std::string("0.,{},1,0.01")}) {
      const auto s =
          sheared(held_water(method, wall, belt + "*CONTROL_TIMESTEP\n0,0.3\n", 8), [](Real) { return 0; });
      ASSERT_TRUE(s);
      sample_energy(s->world(), s->clock());
      s->world().energy.initial = s->world().energy.total();
      test::run(*s, 0.3);
      const Sample now = s->sample("");
      EXPECT_GT(now.velocity[0], 5e-4) << method << wall;
      EXPECT_GT(now.energy.external_work, now.energy.kinetic) << method << wall;
      EXPECT_LT(std::abs(now.energy.residual()), 0.01 * now.energy.external_work) << method << wall;
    }
}

// Rows that are driven above the water do work on it, and rub on it without being slowed.
TEST(WallDrag, BooksTheWorkOfDrivenParticles) {
  const std::string driven =
      "*DEFINE_BOX\n9,-9.,9.,0.5,9.,-9.,9.\n*SET_NODE_GENERAL\n8\nBOX,9\n"
      "*BOUNDARY_PRESCRIBED_MOTION_SET\n8,1,0,6\n8,2,0,7\n"
      "*DEFINE_CURVE\n6\n0.,2.\n9.,2.\n*DEFINE_CURVE\n7\n0.,0.\n9.,0.\n";
  const auto s = sheared(held_water(1, held, driven, 8), [](Real y) { return y > 0.5 ? 2 : 0; });
  ASSERT_TRUE(s);
  sample_energy(s->world(), s->clock());
  s->world().energy.initial = s->world().energy.total();
  test::run(*s, 0.3);
  const EnergyLedger energy = s->sample("").energy;
  EXPECT_GT(energy.external_work, 1);
  EXPECT_GT(energy.dissipated, 1);
  EXPECT_LT(std::abs(energy.residual()), 0.004 * energy.dissipated);
}

// A plate as heavy as the water, free to move: it gets what the water loses.
TEST(WallDrag, GivesAFreeWallWhatWaterLoses) {
  for (const int method : {0, 1}) {
    std::string text = held_water(method, held, "*CONTROL_TIMESTEP\n0,0.3\n", 6);
    for (const std::string node : {"9001,-2.,0,", "9002,3.,0,", "9003,3.,0,", "9004,-2.,0,"})  // one deep
      text.replace(text.find(node) + node.size(), node < "9003" ? 3 : 2, node < "9003" ? "0." : "1.");
    text.replace(text.find("\n1,7,7\n"), 7, "\n0\n");
    const auto s = sheared(text, [](Real y) { return 1 + y; });
    ASSERT_TRUE(s);
    const auto momentum = [&] {
      const Sample now = s->sample("");
      return Vec(now.mass * now.velocity);
    };
    const Vec before = momentum();
    sample_energy(s->world(), s->clock());
    s->world().energy.initial = s->world().energy.total();
    const Real energy = s->world().energy.initial;
    test::run(*s, 0.2);
    EXPECT_LT((momentum() - before).norm(), 1e-11 * before.norm()) << method;
    EXPECT_GT(s->sample("").bodies.at(0).v[0], 0.01) << method;
    EXPECT_LT(std::abs(s->sample("").energy.residual()), 0.01 * energy) << method;
  }
}

// Two walls that meet: no slip on both, the path back over both of them.
TEST(WallDrag, HoldsWaterInACornerAsTheFlowThatIsOddInBothDirections) {
  const std::string side =
      "*NODE\n9101,0.,-1.,-2.\n9102,0.,3.,-2.\n9103,0.,3.,3.\n9104,0.,-1.,3.\n*ELEMENT_SHELL\n2,3,9101,9102,"
      "9103,9104\n"
      "*PART\nside\n3,2,2\n*COURANT_WALL_SUPPORT\n3,3,0.,1,2\n";
  auto s = test::build_deck(held_water(1, held, side), false);
  ASSERT_TRUE(s);
  Particles& p = s->world().particles;
  for (Index i = 0; i < p.size(); ++i) {
    const Vec x = p.x.vec(i);
    p.v.set(i, Vec(shear * x[0] * x[1], 0, 0));  // harmonic
  }
  std::string who;
  s->evaluate(who);
  const Particles& q = s->world().particles;
  for (const Real y : {0.05, 0.15})
    EXPECT_NEAR(q.f.vec(particle_at(q, Vec(0.05, y, 0)))[0] / (mu * shear * spacing), 0, 2e-4) << y;
}

// Who says nothing of LAW stays smooth, beside walls that hold and in one plane with them.
TEST(WallDrag, LeavesSmoothWallsSmooth) {
  const std::string side =
      "*NODE\n9101,0.,-1.,-2.\n9102,0.,3.,-2.\n9103,0.,3.,3.\n9104,0.,-1.,3.\n*ELEMENT_SHELL\n2,3,9101,9102,"
      "9103,9104\n*PART\nside\n3,2,2\n*COURANT_WALL_SUPPORT\n3,3,0.,1\n";
  const std::string next =
      "*NODE\n9201,3.,0.,-2.\n9202,3.,0.,3.\n*ELEMENT_SHELL\n3,4,9002,9201,9202,9003\n*PART\nnext\n4,2,2\n"
      "*COURANT_WALL_SUPPORT\n4,3,0.,1\n";
  std::string text = held_water(1, held, side + next);
  for (const std::string node : {"9002,3.", "9003,3."})
    text.replace(text.find(node), 7, node.substr(0, 5) + "0.6");
  const auto s = sheared(text, [](Real) { return 1; });
  ASSERT_TRUE(s);
  const Particles& p = s->world().particles;
  const auto force = [&](Real x, Real y) { return p.f.vec(particle_at(p, Vec(x, y, 0)))[0] / mu; };
  EXPECT_NEAR(force(0.05, 0.75), 0, 1e-9);
  EXPECT_NEAR(force(0.95, 0.05), 0, 1e-9);
  EXPECT_LT(force(0.25, 0.05), -0.1);
  const auto whole = sheared(held_water(1, held), [](Real) { return 1; });
  const Particles& q = whole->world().particles;
  EXPECT_NEAR(force(0.35, 0.05), q.f.vec(particle_at(q, Vec(0.55, 0.05, 0)))[0] / mu, 1e-3);
}

// On both sides of a thin plate that nothing but the plate parts.
TEST(WallDrag, PartsWaterOnBothSidesOfAThinPlate) {
  const std::string plate =
      "*NODE\n9101,-1.,0.6,-2.\n9102,3.,0.6,-2.\n9103,3.,0.6,3.\n9104,-1.,0.6,3.\n*ELEMENT_SHELL\n2,3,9101,"
      "9102,9103,9104\n"
      "*PART\nplate\n3,2,2\n*COURANT_WALL_SUPPORT\n3,3,0.,1,2\n";
  const auto s = sheared(held_water(1, held, plate), [](Real y) { return y < 0.6 ? 0. : shear * (y - 0.6); });
  ASSERT_TRUE(s);
  for (const Real y : {0.45, 0.55, 0.65, 0.75}) EXPECT_NEAR(force_in_row(*s, y), 0, 2e-4) << y;
}

}  // namespace
}  // namespace courant
