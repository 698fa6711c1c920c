// *COURANT_WALL_SUPPORT against integrals worked out here by other means.
#include <gtest/gtest.h>

#include <cmath>

#include <fmt/format.h>

#include "../app/small_scene.hpp"
#include "sph/core/fields.hpp"
#include "sph/walls/wall_surface.hpp"

namespace courant {
namespace {

constexpr Real h = 0.12, g = 9.81;

Real W(Real r) {
  return CubicSpline::C(2) * CubicSpline::shape(r / h) / (h * h);
}

/// Integral of W over the positions that `inside` tells, by a fine grid around x.
template <class Inside>
Real volume(const Vec& x, const Inside& inside) {
  constexpr int n = 600;
  const Real step = 4 * h / n;
  Real sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec d((i + 0.5) * step - 2 * h, (j + 0.5) * step - 2 * h, 0);
      if (inside(Vec(x + d))) sum += W(d.norm()) * step * step;
    }
  return sum;
}
/// Integral of W over the straight line from a to b, seen from x.
Real line(const Vec& x, const Vec& a, const Vec& b) {
  constexpr int n = 20000;
  Real sum = 0;
  for (int i = 0; i < n; ++i) sum += W((a + (b - a) * ((i + 0.5) / n) - x).norm()) * (b - a).norm() / n;
  return sum;
}

/// Shells one wide along the given lines.
void add_walls(World& world, const std::vector<std::pair<Vec, Vec>>& lines) {
  world.dim = 2;
  world.nodes.fields.resize(4 * static_cast<Index>(lines.size()));
  world.segments.fields.resize(static_cast<Index>(lines.size()));
  for (Index s = 0; s < static_cast<Index>(lines.size()); ++s) {
    const Vec z(0, 0, 0.5);
    const Vec corners[4] = {lines[s].first - z, lines[s].second - z, lines[s].second + z, lines[s].first + z};
    for (Index e = 0; e < 4; ++e) world.nodes.x.set(4 * s + e, corners[e]);
    world.segments.node0[s] = 4 * s, world.segments.node1[s] = 4 * s + 1;
    world.segments.node2[s] = 4 * s + 2, world.segments.node3[s] = 4 * s + 3;
  }
}
Vec slope_at(const WallSurface& surface, const Vec& x) {
  Vec sum = Vec::Zero();
  surface.for_each_seen(x, [&](const WallPoint& q, const Vec& away) { sum += away * W((q.x - x).norm()); });
  return sum;
}

TEST(WallSurface, IntegratesTheKernelOverAWallFromBothSides) {
  const Vec a(-1, 0, 0), b(1, 0, 0);
  World world;
  add_walls(world, {{a, b}});
  const WallSurface surface(world, {0}, h / 4, 2 * h);
  for (const Real d : {0.3, 0.5, 1.0, 1.5, 1.9, 2.1}) {
    const Vec above = slope_at(surface, Vec(0.013, d * h, 0)),
              below = slope_at(surface, Vec(0.013, -d * h, 0));
    EXPECT_NEAR(above[1], -line(Vec(0.013, d * h, 0), a, b), 2e-4 / h) << d;
    EXPECT_NEAR(below[1], -above[1], 1e-12 / h) << d;
    EXPECT_NEAR(above[0], 0, 1e-12 / h) << d;
  }
}

TEST(WallSurface, ShellsSideBySideAcrossThePlaneCountOnce) {
  World world;
  add_walls(world, {{Vec(-1, 0, 0), Vec(1, 0, 0)}, {Vec(1, 0, 0), Vec(-1, 0, 0)}});
  for (Index n = 4; n < 8; ++n) world.nodes.x.set(n, Vec(world.nodes.x.vec(n) + Vec(0, 0, 1)));
  const WallSurface surface(world, {0, 1}, h / 4, 2 * h);
  EXPECT_EQ(surface.faces(), 1);
}

TEST(WallSurface, SeesBothWallsOfACornerAndNothingBehindAnEdge) {
  // floor from the left, then a wall upwards, then a floor to the right: a step
  const Vec a(-1, 0, 0), foot(0, 0, 0), top(0, 0.5, 0), b(1, 0.5, 0);
  World world;
  add_walls(world, {{a, foot}, {foot, top}, {top, b}});
  const WallSurface surface(world, {0, 1, 2}, h / 4, 2 * h);
  const Vec inner(-0.06, 0.06, 0);
  const Vec seen = slope_at(surface, inner);
  EXPECT_NEAR(seen[0], line(inner, foot, top), 2e-3 / h);
  EXPECT_NEAR(seen[1], -line(inner, a, foot), 2e-3 / h);
  // in front of the wall and under the edge the upper floor is out of sight
  const Vec under(-0.06, 0.44, 0);
  EXPECT_NEAR(slope_at(surface, under)[1], 0, 1e-12 / h);
  EXPECT_NEAR(slope_at(surface, under)[0], line(under, foot, top), 2e-3 / h);
  // from above the upper floor the wall under it is out of sight
  const Vec over(0.06, 0.56, 0);
  EXPECT_NEAR(slope_at(surface, over)[0], 0, 1e-12 / h);
  EXPECT_NEAR(slope_at(surface, over)[1], -line(over, top, b), 2e-3 / h);
}

TEST(WallSurface, CutsFacesInThreeDimensions) {
  World world;
  add_walls(world, {{Vec(-0.5, 0, 0), Vec(0.5, 0, 0)}});
  world.dim = 3;
  const WallSurface surface(world, {0}, h / 4, 2 * h);
  Real area = 0;
  const Vec x(0.02, 0.5 * h, 0.03);
  Vec sum = Vec::Zero();
  surface.for_each_seen(x, [&](const WallPoint& q, const Vec& away) {
    area += away.norm();
    const Real R = (q.x - x).norm() / h;
    sum += away * (CubicSpline::C(3) * CubicSpline::shape(R) / (h * h * h));
  });
  // of a plane at distance d: 2 pi int W r dr from d on
  Real expected = 0;
  constexpr int n = 20000;
  for (int i = 0; i < n; ++i) {
    const Real R = 0.5 + 1.5 * (i + 0.5) / n;
    expected += 2 * pi * CubicSpline::C(3) * CubicSpline::shape(R) / h * R * 1.5 / n;
  }
  EXPECT_NEAR(sum[1], -expected, 1e-3 / h);
  EXPECT_GT(area, pi * (3.7 * h) * (0.9 * h));
}

TEST(WallSurface, GoesOnBehindAMirrorAsItsImage) {
  // half of a trench, its middle at x = 0
  const Vec foot(0.1, -0.3, 0), edge(0.1, 0, 0);
  const std::pair<Vec, Vec> bank{edge, Vec(1, 0, 0)}, side{foot, edge}, bed{Vec(0, -0.3, 0), foot};
  const auto image = [](const std::pair<Vec, Vec>& line) {
    const auto of = [](const Vec& x) { return Vec(-x[0], x[1], 0); };
    return std::pair<Vec, Vec>(of(line.first), of(line.second));
  };
  World half, whole, too_long, across;
  add_walls(half, {bank, side, bed});
  add_walls(whole, {bank, side, bed, image(bank), image(side), image(bed)});
  add_walls(too_long, {bank, side, {Vec(-0.32, -0.3, 0), foot}});
  add_walls(across, {bank, side, {Vec(-0.1, -0.3, 0), foot}});  // the middle of its seven pieces at x = 0
  const GhostPlane mirror{GhostPlane::Kind::mirror, Vec::Zero(), Vec(1, 0, 0), 0};
  const WallSurface of_half(half, {0, 1, 2}, h / 4, 2 * h, {mirror});
  const WallSurface of_whole(whole, {0, 1, 2, 3, 4, 5}, h / 4, 2 * h);
  const WallSurface of_long(too_long, {0, 1, 2}, h / 4, 2 * h, {mirror});
  const WallSurface of_across(across, {0, 1, 2}, h / 4, 2 * h, {mirror});
  for (const Vec& x : {Vec(0.02, -0.25, 0), Vec(0.06, -0.1, 0), Vec(0.02, 0.05, 0), Vec(0.2, 0.05, 0)}) {
    const Vec expected = slope_at(of_whole, x);
    EXPECT_GT(expected.norm(), 0.01 / h);
    EXPECT_LT((slope_at(of_half, x) - expected).norm(), 1e-12 / h) << x.transpose();
    EXPECT_LT((slope_at(of_long, x) - expected).norm(), 0.01 / h) << x.transpose();
    EXPECT_LT((slope_at(of_across, x) - expected).norm(), 0.01 / h) << x.transpose();
  }
}

TEST(WallSurface, HidesNothingByWhatStandsBehindAMirror) {
  // a plate that goes on through the mirror at x = 0 is a roof
  const std::pair<Vec, Vec> right{Vec::Zero(), Vec(0.2, -0.1, 0)}, left{Vec::Zero(), Vec(-0.2, -0.1, 0)};
  World through, roof;
  add_walls(through, {{Vec(-0.2, 0.1, 0), Vec(0.2, -0.1, 0)}});
  add_walls(roof, {right, left});
  const WallSurface of_plate(through, {0}, h / 4, 2 * h,
                             {{GhostPlane::Kind::mirror, Vec::Zero(), Vec(1, 0, 0), 0}});
  const WallSurface of_roof(roof, {0, 1}, h / 4, 2 * h);
  const Vec x(0.05, 0.05, 0), expected = slope_at(of_roof, x);
  EXPECT_LT((slope_at(of_plate, x) - expected).norm(), 0.02 * expected.norm());
}

TEST(WallSurface, GoesOnBehindPeriodicPlanesAsTheOtherEnd) {
  World one, three;
  add_walls(one, {{Vec(0, 0, 0), Vec(0.5, 0, 0)},
                  {Vec(0.5, 0, 0), Vec(0.5, 0.1, 0)},
                  {Vec(0.5, 0.1, 0), Vec(1, 0.1, 0)}});
  std::vector<std::pair<Vec, Vec>> lines;
  for (const Real at : {-1., 0., 1.}) {
    lines.push_back({Vec(at, 0, 0), Vec(at + 0.5, 0, 0)});
    lines.push_back({Vec(at + 0.5, 0, 0), Vec(at + 0.5, 0.1, 0)});
    lines.push_back({Vec(at + 0.5, 0.1, 0), Vec(at + 1, 0.1, 0)});
  }
  add_walls(three, lines);
  const WallSurface of_one(one, {0, 1, 2}, h / 4, 2 * h,
                           {{GhostPlane::Kind::periodic, Vec::Zero(), Vec(1, 0, 0), 1}});
  const WallSurface of_three(three, {0, 1, 2, 3, 4, 5, 6, 7, 8}, h / 4, 2 * h);
  for (const Vec& x : {Vec(0.03, 0.05, 0), Vec(0.97, 0.15, 0), Vec(0.5, 0.2, 0), Vec(0.03, 0.2, 0)})
    EXPECT_LT((slope_at(of_one, x) - slope_at(of_three, x)).norm(), 1e-12 / h) << x.transpose();
}

TEST(WallSurface, HasImagesOfImagesWhereMirrorsMeet) {
  World quarter, whole;
  add_walls(quarter, {{Vec(0, 0, 0), Vec(1, 0, 0)}});
  add_walls(whole, {{Vec(-1, 0, 0), Vec(1, 0, 0)}});
  for (World* world : {&quarter, &whole}) {
    world->dim = 3;
    for (Index n = 0; n < 4; ++n) {
      const Vec x = world->nodes.x.vec(n);
      world->nodes.x.set(n, Vec(x[0], 0, x[2] > 0 ? 1 : world == &quarter ? 0 : -1));
    }
  }
  const auto mirror = [](int axis) {
    return GhostPlane{GhostPlane::Kind::mirror, Vec::Zero(), Vec::Unit(axis), 0};
  };
  const WallSurface of_quarter(quarter, {0}, h / 4, 2 * h, {mirror(0), mirror(2)});
  const WallSurface of_whole(whole, {0}, h / 4, 2 * h);
  const Vec x(0.03, 0.06, 0.05);
  EXPECT_GE(of_quarter.view_from(x).flat, 0);
  EXPECT_LT((slope_at(of_quarter, x) - slope_at(of_whole, x)).norm(), 1e-3 * slope_at(of_whole, x).norm());
}

TEST(WallSurface, LeavesOutNothingThatParticlesCanSee) {
  // a long wall of short lines, a few particles beside it, one at the far end of a period
  std::vector<std::pair<Vec, Vec>> lines;
  std::vector<Index> all;
  for (int k = 0; k < 400; ++k) {
    lines.push_back({Vec(0.05 * k, 0.02 * (k % 2), 0), Vec(0.05 * (k + 1), 0.02 * ((k + 1) % 2), 0)});
    all.push_back(k);
  }
  World world;
  add_walls(world, lines);
  Particles& p = world.particles;
  const std::vector<Vec> places{Vec(3.01, 0.1, 0), Vec(3.2, 0.25, 0), Vec(7, -0.12, 0), Vec(19.97, 0.07, 0),
                                Vec(11, 5, 0)};
  p.fields.resize(static_cast<Index>(places.size()));
  p.active = p.size();
  for (Index i = 0; i < p.size(); ++i) p.x.set(i, places[i]);
  const GhostPlane period{GhostPlane::Kind::periodic, Vec::Zero(), Vec(1, 0, 0), 20};
  const GhostPlane mirror{GhostPlane::Kind::mirror, Vec(19.98, 0, 0), Vec(-1, 0, 0), 0};
  for (const std::vector<GhostPlane>& planes : {std::vector<GhostPlane>{}, {period}, {mirror}}) {
    const OccupiedCells from(p, 2 * h, planes);
    const WallSurface whole(world, all, h / 4, 2 * h, planes), seen(world, all, h / 4, 2 * h, planes, &from);
    EXPECT_LT(seen.points(), whole.points() / 4);
    for (const Vec& x : places) {
      EXPECT_LT((slope_at(seen, x) - slope_at(whole, x)).norm(), 1e-12 / h) << x.transpose();
      EXPECT_EQ(seen.view_from(x).nothing, whole.view_from(x).nothing);
    }
    EXPECT_GT(slope_at(seen, places[0]).norm(), 0.1 / h);
    EXPECT_GT(slope_at(seen, places[3]).norm(), 0.1 / h);
  }
}

/// A floor one spacing thick, its middle half a spacing under the lowest row.
std::string floor_cards() {
  std::string cards = test::floor_cards(0);
  const std::string thin = "2,2\n0.05\n";
  return cards.replace(cards.find(thin), thin.size(), "2,2\n0.09999\n");
}
/// A square of water on it.
std::string on_floor(const std::string& more, const std::string& start = "0.,0.,0.", int n = 6,
                     const std::string& control_sph = "") {
  test::SmallScene scene;
  scene.n = n;
  scene.start = start;
  scene.control_sph = control_sph;
  scene.extra = floor_cards() + more;
  return scene.text();
}
const std::string support = "*COURANT_WALL_SUPPORT\n2,3\n";

Index at(const Particles& p, const Vec& x) {
  Index best = 0;
  for (Index i = 0; i < p.active; ++i)
    if ((p.x.vec(i) - x).norm() < (p.x.vec(best) - x).norm()) best = i;
  return best;
}

TEST(WallSupport, ContinuityNoticesTheWall) {
  std::string who;
  const auto with = test::build_deck(on_floor(support, "0.3,-0.5,0."));
  const auto without = test::build_deck(on_floor("", "0.3,-0.5,0."));
  Clock one, two;
  with->evaluate(who), without->evaluate(who);
  const Particles &p = with->world().particles, &q = without->world().particles;
  for (Index i = 0; i < p.active; ++i) {
    const Vec x = p.x.vec(i);
    const Index j = at(q, x);
    const Real b = line(x, Vec(-2, 0, 0), Vec(3, 0, 0));
    EXPECT_NEAR(p.drhodt[i] - q.drhodt[j], 2 * 1000 * 0.5 * b, 1000 * 0.5 * 2e-3 / h) << x.transpose();
  }
}

TEST(WallSupport, SpraySeesNoWall) {
  // 0.1 apart and h = 0.03: nobody is in reach of another, though the lists of groups hold others; the floor
  // is
  const auto scene = [](const std::string& more) {
    test::SmallScene out;
    out.start = "0.3,-0.5,0.";
    out.section = "1,1.2,1.,1.,0.03";
    out.extra = floor_cards() + more;
    return out.text();
  };
  const auto s = test::build_deck(scene(support), false);
  ASSERT_TRUE(s);
  std::string who;
  s->evaluate(who);
  const Particles& p = s->world().particles;
  for (Index i = 0; i < p.active; ++i) EXPECT_EQ(p.drhodt[i], 0) << p.x.vec(i).transpose();
}

TEST(WallSupport, KnowsHowMuchOfTheKernelLiesBehindTheWall) {
  const auto s = test::build_deck(on_floor(support));
  std::string who;
  s->evaluate(who);
  Particles& p = s->world().particles;
  const Field<Real>& fill = sph_fields::wall_fill(p);
  for (const Real y : {0.05, 0.15}) {
    const Vec x(0.25, y, 0);
    EXPECT_NEAR(fill[at(p, x)], volume(x, [](const Vec& place) { return place[1] < 0; }), 2e-3) << y;
  }
}

TEST(WallSupport, AFloorMayEndAtAMirror) {
  const std::string mirror = "*BOUNDARY_SPH_SYMMETRY_PLANE\n0,0,0,1,0,0\n",
                    through = on_floor(support + mirror);
  std::string ends = through;
  for (const std::string node : {"9001", "9004"}) ends.replace(ends.find(node + ",-2."), 8, node + ",0.0");
  std::vector<Real> fill, derivative;
  for (const std::string& text : {through, ends}) {
    const auto s = test::build_deck(text);
    std::string who;
    s->evaluate(who);
    Particles& p = s->world().particles;
    fill.push_back(sph_fields::wall_fill(p)[at(p, Vec(0.05, 0.05, 0))]);
    derivative.push_back(sph_fields::wall_slope(p).vec(at(p, Vec(0.05, 0.05, 0)))[1]);
  }
  EXPECT_NEAR(fill[0], volume(Vec(0.05, 0.05, 0), [](const Vec& place) { return place[1] < 0; }), 2e-3);
  EXPECT_NEAR(fill[1], fill[0], 1e-3);
  EXPECT_NEAR(derivative[1], derivative[0], 1e-3 * std::abs(derivative[0]));
}

TEST(WallSupport, AUniformPressureDoesNotMoveTheLowestRow) {
  const std::string pressure = "*EOS_LINEAR_POLYNOMIAL\n1,1000.,9.E5\n";
  const auto force = [&](const std::string& more) {
    std::string text = on_floor(more, "0.,0.,0.", 12);
    const std::string old = "*EOS_LINEAR_POLYNOMIAL\n1,0.,9.E5\n";
    text.replace(text.find(old), old.size(), pressure);
    const auto s = test::build_deck(text, false);
    std::string who;
    s->evaluate(who);
    const Particles& p = s->world().particles;
    return p.f.vec(at(p, Vec(0.55, 0.05, 0)))[1];
  };
  const Real whole = 2 * 1000 * 0.1 * 0.1 * line(Vec(0.55, 0.05, 0), Vec(-2, 0, 0), Vec(3, 0, 0));  // 2 p V b
  EXPECT_NEAR(force(support) - force(""), whole, 1e-3 * whole);
  EXPECT_LT(std::abs(force(support)), 0.05 * whole);  // the sum over a lattice is no integral
}

TEST(WallSupport, RestingWaterKeepsItsPlaceAndPressureAndEnergy) {
  test::SmallScene scene;
  scene.n = 10;
  scene.termination = "2.";
  scene.extra = floor_cards() + support + test::gravity_cards +
                "*BOUNDARY_SPH_SYMMETRY_PLANE\n0,0,0,1,0,0\n1,0,0,0,0,0\n";
  const auto s = test::build_deck(scene.text(), false);
  // gravity comes at once, so the water swings; means over many periods of 4 H/c
  Real pressure = 0, on_water = 0, times = 0;
  while (s->clock().t < 4) {
    s->step([](World&, const Clock&, const std::string&) {});
    if (s->clock().t < 2 || s->clock().cycle % 16 != 0) continue;
    const Particles& p = s->world().particles;
    Real rows = 0, sum = 0;
    for (Index i = 0; i < p.active; ++i)
      if (p.x.vec(i)[1] < 0.09) sum += p.p[i], ++rows;
    for (const InterfaceForce& f : s->sample("").interfaces) on_water += f.on_surfa[1];
    pressure += sum / rows, ++times;
  }
  EXPECT_NEAR(pressure / times / (1000 * g * 0.95), 1, 0.05);  // half a spacing
  EXPECT_NEAR(on_water / times / (1000 * g), 1, 0.01);         // on support and contact together
  const Particles& p = s->world().particles;
  Real lowest = 1, highest = 0;
  for (Index i = 0; i < p.active; ++i)
    lowest = std::min(lowest, p.x.vec(i)[1]), highest = std::max(highest, p.x.vec(i)[1]);
  EXPECT_NEAR(lowest, 0.05, 0.01);
  EXPECT_NEAR(highest, 0.95, 0.02);
  EXPECT_LT(std::abs(s->sample("").energy.residual()), 1e-3 * 1000 * g * 0.5);
}

TEST(WallSupport, FrictionIsHalfRhoVSquaredTimesCf) {
  const auto s = test::build_deck(on_floor("*COURANT_WALL_SUPPORT\n2,3,0.004\n", "2.,0.,0.", 12));
  std::string who;
  s->evaluate(who);
  const Particles& p = s->world().particles;
  Real drag = 0;
  for (Index i = 0; i < p.active; ++i) drag += p.f.vec(i)[0];
  EXPECT_NEAR(drag / (-0.5 * 1000 * 4 * 0.004 * 1.2), 1, 0.02);
}

/// The force along an orthogonal wall whose upper edge is under the lowest row, on the column that rises
/// `past` beside its plane.
Real rubbed_by_a_wall_below(Real past) {
  test::SmallScene scene;
  scene.material = "1,1000.,-1.E20,1.E-3";
  scene.start = "0.,2.,0.";
  scene.extra = fmt::format(
      "*NODE\n9001,{0},0.,-2.\n9002,{0},0.,3.\n9003,{0},-2.,3.\n9004,{0},-2.,-2.\n"
      "*ELEMENT_SHELL\n1,2,9001,9002,9003,9004\n*PART\nstep\n2,2,2\n*SECTION_SHELL\n2,2\n0.05\n"
      "*MAT_RIGID\n2,7850.,2.1E11,0.3\n1,7,7\n*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n1,2,3,3\n0.\n1\n"
      "*COURANT_WALL_SUPPORT\n2,3,0,0,1\n",
      0.05 - past);
  const auto s = test::build_deck(scene.text(), false);
  std::string who;
  s->evaluate(who);
  const Particles& p = s->world().particles;
  return p.f.vec(at(p, Vec(0.05, 0.05, 0)))[1] - p.f.vec(at(p, Vec(0.55, 0.05, 0)))[1];
}

TEST(WallSupport, AParticleInThePlaneOfAWallIsNotAtTheWall) {
  const Real beside = rubbed_by_a_wall_below(0.01), in_plane = rubbed_by_a_wall_below(1e-10);
  EXPECT_LT(beside, -0.1);
  EXPECT_NEAR(in_plane / beside, 1, 0.05);
}

TEST(WallSupport, ADropOfOneOrTwoParticlesIsNotHeldByItsMirrorImage) {
  for (const std::string second : {"", "*NODE\n2,0.15,0.05,0.\n*ELEMENT_SPH\n2,1,10.\n"}) {
    test::SmallScene scene;
    scene.n = 1;
    scene.section = "1,1.2,1.,1.,0.12";
    scene.start = "0.,-3.,0.";
    scene.extra = floor_cards() + support + second + test::gravity_cards;
    const auto s = test::build_deck(scene.text(), false);
    Real lowest = 1;
    while (s->clock().t < 0.2) {
      s->step([](World&, const Clock&, const std::string&) {});
      lowest = std::min(lowest, s->world().particles.x.vec(0)[1]);
    }
    const Particles& p = s->world().particles;
    EXPECT_GT(lowest, 0);
    for (Index i = 0; i < p.active; ++i) EXPECT_GT(p.v.vec(i)[1], 0.5) << "particle " << i;  // it flies up
  }
}

TEST(WallSupport, EnergyOfAnImpactIsKeptAsWellAsWithoutIt) {
  const auto residual = [&](const std::string& more, const std::string& control_sph) {
    const auto s =
        test::build_deck(on_floor(more + "*CONTROL_TIMESTEP\n0,0.3\n", "0.,-0.3,0.", 6, control_sph));
    while (s->clock().t < 0.5) s->step([](World&, const Clock&, const std::string&) {});
    const Sample sample = s->sample("");
    return std::abs(sample.energy.residual()) / (0.5 * 360 * 0.09);  // of the impact's
  };
  const Real with = residual(support, "");
  EXPECT_LT(with, 0.01);
  EXPECT_LT(with, residual("", "") + 0.005);
  EXPECT_LT(residual(support, "\n0,0,0,0,0,0,1"), 0.01);  // IAVIS 1: q adds to the pressure on the wall, too
}

/// The floor of `on_floor`, with other motions than none.
std::string with_floor(std::string text, const std::string& rigid) {
  for (const std::string node : {"9001,-2.,0,", "9002,3.,0,", "9003,3.,0,", "9004,-2.,0,"})  // one deep
    text.replace(text.find(node) + node.size(), node < "9003" ? 3 : 2, node < "9003" ? "0." : "1.");
  return text.replace(text.find("\n1,7,7\n"), 7, "\n" + rigid + "\n");
}
std::string starting(const Vec& v) {
  std::string cards = "*INITIAL_VELOCITY_NODE\n";
  for (int n = 9001; n <= 9004; ++n) cards += fmt::format("{},{},{},{}\n", n, v[0], v[1], v[2]);
  return cards;
}
std::string driven(const Vec& v) {
  std::string cards;
  for (int k = 0; k < 2; ++k)
    cards += fmt::format("*BOUNDARY_PRESCRIBED_MOTION_RIGID\n2,{},0,{}\n*DEFINE_CURVE\n{}\n0.,{}\n100.,{}\n",
                         k + 1, 10 + k, 10 + k, v[k], v[k]);
  return cards;
}

TEST(WallSupport, OnlyTheVelocityOverTheWallCounts) {
  const std::string rubs = "*COURANT_WALL_SUPPORT\n2,3,0.004\n";
  const auto at_rest = test::build_deck(on_floor(rubs, "0.3,-0.5,0."), false);
  const auto carried =
      test::build_deck(with_floor(on_floor(rubs + starting(Vec(2, 1, 0)), "2.3,0.5,0."), "0"), false);
  std::string who;
  at_rest->evaluate(who), carried->evaluate(who);
  const Particles &p = at_rest->world().particles, &q = carried->world().particles;
  Real seen = 0;
  for (Index i = 0; i < p.active; ++i) {
    const Index j = at(q, p.x.vec(i));
    seen = std::max(seen, std::abs(p.drhodt[i]));
    EXPECT_NEAR(q.drhodt[j], p.drhodt[i], 1e-3 * 1000 * 0.5 / h)
        << p.id[i];  // plane in one, pieces in the other
    EXPECT_LT((q.f.vec(j) - p.f.vec(i)).norm(), 1e-3 * 1000 * 0.004 * 0.1) << p.id[i];
  }
  EXPECT_GT(seen, 100);
}

TEST(WallSupport, ASmoothWallThatMovesChangesNothingInTheFrictionOfARoughOne) {
  // a smooth plate beside the water, at rest and rising, above a rough floor over which the water flows
  const auto under_friction = [](const std::string& speed) {
    const std::string side =
        "*NODE\n9101,-0.05,-0.05,0.\n9102,-0.05,3.,0.\n9103,-0.05,3.,1.\n9104,-0.05,-0.05,1.\n"
        "*ELEMENT_SHELL\n2,3,9101,9102,9103,9104\n*PART\nside\n3,2,3\n*MAT_RIGID\n3,7850.,2.1E11,0.3\n0\n"
        "*INITIAL_VELOCITY_NODE\n";
    std::string moves;
    for (int n = 9101; n <= 9104; ++n) moves += std::to_string(n) + ",0.," + speed + ",0.\n";
    const auto s = test::build_deck(
        on_floor("*COURANT_WALL_SUPPORT\n2,3,0.004\n*COURANT_WALL_SUPPORT\n3,3\n" + side + moves, "2.,0.,0."),
        false);
    std::string who;
    s->evaluate(who);
    Particles& p = s->world().particles;
    const Index corner = at(p, Vec(0.05, 0.05, 0));
    EXPECT_GT(sph_fields::wall_rubbing(p)[corner], 0);
    return sph_fields::wall_velocity(p).vec(corner);
  };
  EXPECT_EQ(under_friction("0.").norm(), 0);
  EXPECT_LT(under_friction("5.").norm(), 1e-12);
}

// A plate as heavy as the water, free: what the water loses it gets, turning included.
TEST(WallSupport, WaterAndAFreeWallKeepTheirMomentum) {
  for (const std::string& form : {"0", "1"})
    for (const std::string& iavis : {"0", "1"}) {
      std::string text = with_floor(on_floor("*COURANT_WALL_SUPPORT\n2,3,0.01\n" + starting(Vec::Zero()),
                                             "0.7,-1.,0.", 6, ",0," + form + "\n0,0,0,0,0,0," + iavis),
                                    "0");
      text.replace(text.find("*INITIAL_VELOCITY\n"), 0, "*CONTROL_TIMESTEP\n0,0.3\n");
      text.replace(text.find("2,7850."), 7, "2,720.");  // 720 * 0.1 * 5 = 360
      const auto s = test::build_deck(text, false);
      std::string who;
      s->evaluate(who);  // without it nothing is active
      const auto momentum = [&] {
        const Sample now = s->sample("");
        return Vec(now.mass * now.velocity);
      };
      const auto turning = [&] {
        const World& w = s->world();
        Real sum = 0;
        for (Index i = 0; i < w.particles.active; ++i)
          sum += w.particles.m[i] * w.particles.x.vec(i).cross(w.particles.v.vec(i))[2];
        const RigidBody& plate = s->bodies()->bodies().at(0);
        return sum + plate.m * plate.x.cross(plate.v)[2] + plate.L[2];
      };
      const Vec before = momentum();
      const Real turning_before = turning();
      test::run(*s, 0.15);
      EXPECT_LT((momentum() - before).norm(), 1e-11 * before.norm()) << form << iavis;
      // friction acts at the wall, the particle it acts on stands half a spacing off
      EXPECT_LT(std::abs(turning() - turning_before), 0.02 * std::abs(turning_before)) << form << iavis;
      const Vec plate = s->sample("").bodies.at(0).v;
      EXPECT_LT(plate[1], -0.2) << form << iavis;  // pushed off
      EXPECT_LT(std::abs(s->sample("").energy.residual()), 0.01 * 0.5 * 360 * 1.49) << form << iavis;
    }
}

TEST(WallSupport, AForceOnAPistonIsThatOfTheWaterHammer) {
  // a floor that begins to rise with 0.1 m/s under water at rest: p = rho c v where the wave has not turned
  // back
  test::SmallScene scene;
  scene.n = 16;
  scene.extra = floor_cards() + support + driven(Vec(0, 0.1, 0)) +
                "*BOUNDARY_SPH_SYMMETRY_PLANE\n0,0,0,1,0,0\n1.6,0,0,0,0,0\n";
  const auto s = test::build_deck(with_floor(scene.text(), "1,0,7"), false);
  Real sum = 0, n = 0;
  while (s->clock().t < 0.08) {  // 1.6 m at 30 m/s: the top answers after 0.053 s there, 0.107 s back
    s->step([](World&, const Clock&, const std::string&) {});
    if (s->clock().t < 0.04) continue;
    Real on_water = 0;
    for (const InterfaceForce& f : s->sample("").interfaces) on_water += f.on_surfa[1];
    sum += on_water / 1.6, ++n;
  }
  EXPECT_NEAR(sum / n / (1000 * 30 * 0.1), 1, 0.05);
}

TEST(WallSupport, CompletesTheMomentMatrixOfRenormalisedForms) {
  const auto s = test::build_deck(on_floor(support, "0.,0.,0.", 12, ",0,1"), false);
  std::string who;
  s->evaluate(who);
  Particles& p = s->world().particles;
  for (const Real y : {0.05, 0.15}) {
    const Index i = at(p, Vec(0.55, y, 0));
    const Matrix whole = sph_fields::moment(p).tensor(i) + sph_fields::wall_moment(p).tensor(i);
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b) EXPECT_NEAR(whole(a, b), a == b, 0.05) << y << a << b;
    EXPECT_LT(sph_fields::renormalisation(p).tensor(i).norm(), 0.07) << y;
  }
}

// Both walls in closed form: of the floor, what is in front of the side wall, and of that, what is over the
// floor.
TEST(WallSupport, IntegratesOverBothWallsOfACorner) {
  const std::string side =
      "*NODE\n9011,0.,0.,-2.\n9012,0.,3.,-2.\n9013,0.,3.,3.\n9014,0.,0.,3.\n*ELEMENT_SHELL\n2,2,9011,9012,"
      "9013,9014\n";
  std::string text = on_floor(side + support, "0.3,-0.5,0.", 6, ",0,1");
  const auto s = test::build_deck(text, false);
  ASSERT_TRUE(s);
  std::string who;
  s->evaluate(who);
  Particles& p = s->world().particles;
  for (const Vec& place : {Vec(0.05, 0.05, 0), Vec(0.15, 0.05, 0), Vec(0.05, 0.15, 0)}) {
    const Index i = at(p, place);
    const Vec x = p.x.vec(i), b = sph_fields::wall_slope(p).vec(i);
    EXPECT_NEAR(b[0], -line(x, Vec::Zero(), Vec(0, 3, 0)), 1e-3 / h) << x.transpose();
    EXPECT_NEAR(b[1], -line(x, Vec::Zero(), Vec(3, 0, 0)), 1e-3 / h) << x.transpose();
    const auto behind = [](const Vec& y) { return y[0] < 0 || y[1] < 0; };
    EXPECT_NEAR(sph_fields::wall_fill(p)[i], volume(x, behind), 4e-3) << x.transpose();
    const Matrix moment = sph_fields::wall_moment(p).tensor(i);  // as pieces have it
    Matrix pieces = Matrix::Zero();
    constexpr int n = 4000;
    for (int k = 0; k < n; ++k)
      for (const int along : {0, 1}) {
        Vec q = Vec::Zero(), away = Vec::Zero();
        q[along] = (k + 0.5) / n, away[1 - along] = -1;
        pieces += W((q - x).norm()) / n * (q - x) * away.transpose();
      }
    pieces = 0.5 * (pieces + pieces.transpose().eval()) + volume(x, behind) * Matrix::Identity();
    for (int c = 0; c < 2; ++c)
      for (int d = 0; d < 2; ++d) EXPECT_NEAR(moment(c, d), pieces(c, d), 4e-3) << x.transpose();
  }
}

TEST(WallSupport, FollowsAnHThatChanges) {
  for (const std::string& form : {"0", "1"}) {
    std::string text =
        on_floor(support + test::gravity_cards + "*BOUNDARY_SPH_SYMMETRY_PLANE\n0,0,0,1,0,0\n1,0,0,0,0,0\n",
                 "0.,0.,0.", 10, ",0," + form);
    const std::string old = "1,1.2,1.,1.";
    text.replace(text.find(old), old.size(), "1,1.2,0.5,2.");
    text.replace(text.find("*CONTROL_TERMINATION\n1."), 23, "*CONTROL_TERMINATION\n9.");
    const auto s = test::build_deck(text, false);
    Real on_water = 0, times = 0;
    while (s->clock().t < 4) {
      s->step([](World&, const Clock&, const std::string&) {});
      if (s->clock().t < 2 || s->clock().cycle % 16 != 0) continue;
      for (const InterfaceForce& f : s->sample("").interfaces) on_water += f.on_surfa[1];
      ++times;
    }
    EXPECT_NEAR(on_water / times / (1000 * g), 1, 0.01) << form;
    EXPECT_LT(std::abs(s->sample("").energy.residual()), 5e-3 * 1000 * g * 0.5) << form;
  }
}

}  // namespace
}  // namespace courant
