#include "rigid/bodies/rigid.hpp"
#include "elements/build_nodes.hpp"

#include <gtest/gtest.h>

#include "elements/shell_faces/section_shell.hpp"
#include "elements/shell_faces/shell_faces.hpp"
#include "parallel/parallel.hpp"
#include "rigid/bodies/mat_rigid.hpp"

using namespace courant;

namespace {

/// A plate 1 x 0.5 in the xy plane of 4 x 2 shells, part 1, and its world.
struct Plate {
  Deck deck;
  Model model;
  World world;
  Diagnostics diagnostics;
  std::shared_ptr<RigidBodies> bodies;

  explicit Plate(Real cmo = 0, Real con1 = 0, Real con2 = 0) {
    MatRigid m;
    m.mid = 7, m.ro = 1000, m.E = 1e9, m.pr = 0.25, m.cmo = cmo, m.con1 = con1, m.con2 = con2;
    deck.store<MatRigid>().push_back(m);
    SectionShell s;
    s.secid = 3, s.t1 = 0.01;
    deck.store<SectionShell>().push_back(s);
    model.parts.push_back({.id = 1, .title = {}, .secid = 3, .mid = 7, .where = {}, .has_shell = true});
    model.part_of_id[1] = 0;
    for (Index i = 0; i <= 4; ++i)
      for (Index j = 0; j <= 2; ++j)
        model.nodes.push_back({.id = 100 + 3 * i + j, .x = Vec(0.25 * i, 0.25 * j, 0.1)});
    for (Index i = 0; i < 4; ++i)
      for (Index j = 0; j < 2; ++j)
        model.shells.push_back({.id = 2 * i + j + 1,
                                .part = 0,
                                .node = {3 * i + j, 3 * (i + 1) + j, 3 * (i + 1) + j + 1, 3 * i + j + 1}});
  }
  void build() {
    const auto material = [&](Index part, Index) -> std::optional<ShellMaterial> {
      const auto m = rigid_material(deck, model, part);
      if (!m) return std::nullopt;
      return ShellMaterial{m->ro, m->E, m->pr};
    };
    build_segments(deck, model, material, build_nodes(model, {}, world), world, diagnostics);
    bodies = build_rigid_bodies(deck, model, world, diagnostics);
  }
  void step(Clock& clock, Real dt) {
    clock.dt = dt;
    bodies->apply(world, clock);
    bodies->kick(world, clock);
    bodies->drift(world, clock);
    clock.t += dt, clock.dt_old = dt, ++clock.cycle;
  }
};

TEST(Shell, SegmentsHaveMassThicknessAndStiffness) {
  Plate p;
  p.build();
  ASSERT_TRUE(p.diagnostics.ok()) << p.diagnostics.text();
  EXPECT_EQ(p.world.segments.size(), 8);
  EXPECT_EQ(p.world.nodes.size(), 15);
  Real mass = 0;
  for (Index n = 0; n < 15; ++n) mass += p.world.nodes.m[n];
  EXPECT_NEAR(mass, 1000 * 0.01 * 0.5, 1e-12);
  EXPECT_NEAR(p.world.segments.K[0], 1e9 / (3 * 0.5), 1);
  EXPECT_EQ(p.world.segments.thickness[5], 0.01);
}

TEST(Shell, MaterialThatIsNotRigidIsRefusedByName) {
  Plate p;
  p.model.parts[0].mid = 8;
  p.build();
  EXPECT_EQ(p.diagnostics.errors(), 1);
  EXPECT_NE(p.diagnostics.text().find(
                "the shells of part 1 need a *MAT_RIGID, or a material with strength, with id 8"),
            std::string::npos);
  EXPECT_EQ(p.bodies, nullptr);
}

TEST(Shell, MissingSectionIsNamed) {
  Plate p;
  p.model.parts[0].secid = 4;
  p.build();
  EXPECT_NE(p.diagnostics.text().find("*SECTION_SHELL with id 4"), std::string::npos);
}

// A plate of sides a = 1 and b = 0.5 and thickness t: J = m/12 (b^2 + t^2, a^2 + t^2, a^2 + b^2).
TEST(Rigid, MassCentreAndInertiaAreThoseOfThePlate) {
  Plate p;
  p.build();
  const RigidBody& b = p.bodies->bodies()[0];
  EXPECT_NEAR(b.m, 5, 1e-12);
  EXPECT_NEAR((b.x - Vec(0.5, 0.25, 0.1)).norm(), 0, 1e-12);
  const Matrix exact = (5.0 / 12 * Vec(0.25 + 1e-4, 1 + 1e-4, 1.25)).asDiagonal();
  EXPECT_NEAR((b.J0 - exact).norm(), 0, 1e-13);
  // lumped: sum m x^2 of 5 columns of nodes with end columns half
  EXPECT_NEAR(b.J_lumped(1, 1), 5.0 / 4 * (2 * 0.5 * 0.25 + 2 * 0.0625), 1e-12);
  EXPECT_NEAR(b.J_lumped(0, 0) + b.J_lumped(1, 1), b.J_lumped(2, 2), 1e-12);
}

TEST(Rigid, FreeRotationKeepsAngularMomentumAndEnergy) {
  Plate p;
  const Vec omega(0.2, 3, 0.3), centre(0.5, 0.25, 0.1);  // about the unstable middle axis: it tumbles
  for (ModelNode& n : p.model.nodes) n.v = Vec(0.1, 0, 0) + omega.cross(n.x - centre);
  p.build();
  const RigidBody& b = p.bodies->bodies()[0];
  EXPECT_NEAR((b.omega - omega).norm(), 0, 1e-12);
  const Vec L = b.L;
  const Real energy = p.bodies->kinetic_energy();
  const Vec d0 = p.world.nodes.x.vec(14) - p.world.nodes.x.vec(0);
  Clock clock;
  Real turn = 0;
  for (int n = 0; n < 5000; ++n) {
    p.step(clock, 2e-3);
    turn = std::max(turn, (b.omega - omega).norm());
  }
  EXPECT_GT(turn, 1);
  EXPECT_NEAR((b.L - L).norm(), 0, 1e-14);
  EXPECT_NEAR(p.bodies->kinetic_energy(), energy, 1e-3 * energy);
  EXPECT_NEAR((b.x - centre - Vec(0.1, 0, 0) * 10).norm(), 0, 1e-10);
  const Vec d = p.world.nodes.x.vec(14) - p.world.nodes.x.vec(0);
  EXPECT_NEAR(d.norm(), d0.norm(), 1e-12);
}

TEST(Rigid, ForceOffTheCentreTurnsAndMoves) {
  Plate p;
  p.build();
  const RigidBody& b = p.bodies->bodies()[0];
  p.world.nodes.f.set(14, Vec(0, 0, 2));
  Clock clock;
  clock.dt_old = 1e-3;
  p.step(clock, 1e-3);
  EXPECT_NEAR((b.v - Vec(0, 0, 2.0 / 5 * 1e-3)).norm(), 0, 1e-15);
  EXPECT_NEAR((b.L - Vec(0.5, 0.25, 0).cross(Vec(0, 0, 2)) * 1e-3).norm(), 0, 1e-15);
  EXPECT_NEAR((p.bodies->reports()[0].force - Vec(0, 0, 2)).norm(), 0, 1e-15);
}

/// Two bodies of thousands of nodes, pushed unevenly: their motion and positions of nodes after some steps.
std::vector<Real> many_nodes(int on_threads) {
  const int before = threads();
  set_threads(on_threads);
  World world;
  constexpr Index count = 10000, second = 4001;
  world.nodes.fields.resize(count);
  std::vector<RigidBody> made(2);
  for (Index n = 0; n < count; ++n) {
    RigidBody& b = made[n >= second];
    const Vec at(std::sin(n), std::cos(3 * n), 0.001 * n);
    world.nodes.x.set(n, at);
    world.nodes.f.set(n, Vec(std::sin(7 * n), 0.3, std::cos(n)));
    b.nodes.push_back(n), b.X.push_back(at);
  }
  for (RigidBody& b : made) b.m = 100, b.J0 = 5 * Matrix::Identity();
  RigidBodies bodies(std::move(made));
  Clock clock;
  clock.dt_old = 1e-3;
  std::vector<Real> out;
  for (int k = 0; k < 3; ++k) {
    clock.dt = 1e-3;
    bodies.apply(world, clock);
    for (const RigidBody& b : bodies.bodies()) {
      Vec force = Vec::Zero(), moment = Vec::Zero();
      for (const Index n : b.nodes) {
        force += world.nodes.f.vec(n);
        moment += (world.nodes.x.vec(n) - b.x).cross(world.nodes.f.vec(n));
      }
      EXPECT_NEAR((b.force - force).norm(), 0, 1e-9);
      EXPECT_NEAR((b.moment - moment).norm(), 0, 1e-9);
    }
    bodies.kick(world, clock);
    bodies.drift(world, clock);
    for (const RigidBody& b : bodies.bodies())
      for (const Vec& value : {b.v, b.L, b.x}) out.insert(out.end(), value.begin(), value.end());
  }
  for (Index n = 0; n < count; ++n) out.push_back(world.nodes.x.vec(n).sum());
  set_threads(before);
  return out;
}

TEST(Rigid, ManyNodesMoveWithTheSameBitsOnAnyNumberOfThreads) {
  const std::vector<Real> one = many_nodes(1);
  for (const int n : {2, 3, 4}) EXPECT_EQ(many_nodes(n), one) << n << " threads";
}

TEST(Rigid, ConstraintCodesHoldTheirAxes) {
  const std::array<std::array<int, 3>, 8> expected = {
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}, {1, 1, 1}}};
  for (int code = 0; code <= 7; ++code) {
    Plate p(1, code, code);
    for (ModelNode& n : p.model.nodes) n.v = Vec(1, 1, 1);
    p.build();
    const RigidBody& b = p.bodies->bodies()[0];
    EXPECT_EQ(b.fixed(), code == 7);
    for (Index n = 0; n < p.world.nodes.size(); ++n) {
      EXPECT_EQ(p.world.nodes.held[n], code == 7 ? 1 : 0);
      p.world.nodes.f.set(n, Vec(1, 2, 3) * (n + 1));
    }
    Clock clock;
    for (int k = 0; k < 5; ++k) p.step(clock, 1e-3);
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(b.v[k] == 0, expected[code][k] == 1) << code << " axis " << k;
      EXPECT_EQ(std::abs(b.omega[k]) < 1e-15, expected[code][k] == 1) << code << " axis " << k;
    }
  }
}

TEST(Rigid, GravityAloneConservesTheLedger) {
  Plate p(1, 4, 7);
  p.build();
  std::vector<BodyLoad> loads;
  const Vec base(-1, -2, 9.81);  // the bodies feel the opposite
  for (int k = 0; k < 3; ++k)
    loads.push_back({.direction = Vec::Unit(k), .curve = {.abscissa = {0}, .ordinate = {base[k]}}});
  p.bodies->set_loads(BodyAcceleration(loads));
  EnergyLedger start, end;
  Clock clock;
  p.bodies->sample(p.world, clock, start);
  for (int k = 0; k < 100; ++k) p.step(clock, 1e-3);
  p.bodies->sample(p.world, clock, end);
  EXPECT_NEAR(p.bodies->bodies()[0].v.z(), -9.81 * 0.0995, 1e-12);
  EXPECT_EQ(p.bodies->bodies()[0].v.x(), 0);
  EXPECT_NEAR(end.kinetic + end.potential, start.kinetic + start.potential, 0.02 * end.kinetic);
}

// With mass points the sum of m w^2 r is that of the centre, and the moment turns the plate's long side
// outwards. What is far from the axis gains energy, and the ledger has it.
TEST(Rigid, ATurningFrameDrivesBodiesOutwards) {
  for (const bool on_its_part : {true, false}) {
    Plate p(1, 3, 4);  // z is held, turns about z only
    p.build();
    const BodyLoad about_z{.kind = BodyLoad::Kind::rotation,
                           .direction = Vec::UnitZ(),
                           .centre = Vec(0.25, 0.1, 0),
                           .curve = {.abscissa = {0}, .ordinate = {2}},
                           .parts = {on_its_part ? 0 : 1}};
    p.bodies->set_loads(BodyAcceleration({about_z}));
    EnergyLedger start, end;
    Clock clock;
    p.bodies->sample(p.world, clock, start);
    p.step(clock, 1e-4);
    const RigidBody& b = p.bodies->bodies()[0];
    Vec force = Vec::Zero(), moment = Vec::Zero();
    for (Index n = 0; n < p.world.nodes.size(); ++n) {
      Vec r = p.model.nodes[static_cast<std::size_t>(p.world.nodes.id[n] - 100)].x - about_z.centre;
      r[2] = 0;
      force += p.world.nodes.m[n] * 4 * r;
      moment += (r + about_z.centre - b.x0).cross(p.world.nodes.m[n] * 4 * r);
    }
    if (!on_its_part) force = moment = Vec::Zero();
    EXPECT_LT((b.force - force).norm(), 1e-12);
    EXPECT_LT((b.moment - Vec(0, 0, moment[2])).norm(), 1e-12);
    for (int k = 0; k < 5000; ++k) p.step(clock, 1e-4);
    p.bodies->sample(p.world, clock, end);
    EXPECT_EQ(end.kinetic > 0.5, on_its_part);
    EXPECT_NEAR(end.kinetic + end.potential, start.kinetic + start.potential, 1e-3 * end.kinetic + 1e-15);
  }
}

TEST(Rigid, UnsupportedConstraintsAreRefusedByName) {
  Plate local(-1, 0, 0);
  local.build();
  EXPECT_EQ(local.diagnostics.errors(), 1);
  Plate code(1, 8, 0);
  code.build();
  EXPECT_EQ(code.diagnostics.errors(), 1);
  Plate spc;
  spc.model.nodes[4].fixed[2] = true;
  spc.build();
  EXPECT_EQ(spc.diagnostics.errors(), 1);
  EXPECT_NE(spc.diagnostics.text().find("node 104"), std::string::npos);
}

TEST(Rigid, StateRestoresABody) {
  Plate a, b;
  for (Plate* p : {&a, &b}) {
    for (ModelNode& n : p->model.nodes) n.v = Vec(0.2, 3, 0.3).cross(n.x);
    p->build();
  }
  Clock clock;
  for (int k = 0; k < 50; ++k) a.step(clock, 1e-3);
  SavedState state;
  Archive saver = Archive::saver(state), loader = Archive::loader(state);
  a.bodies->keep(saver);
  b.bodies->keep(loader);
  Clock other = clock;
  a.step(clock, 1e-3);
  b.step(other, 1e-3);
  EXPECT_EQ((a.world.nodes.x.vec(9) - b.world.nodes.x.vec(9)).norm(), 0);
}

}  // namespace
