// Shortcuts of the search must not change a bit: every scene runs with and without them.
#include <gtest/gtest.h>

#include <cstring>

#include "scene.hpp"

using namespace courant;
using courant::test::Scene;

namespace {

struct RandomVectors {
  std::uint64_t seed = 99;
  Real operator()() {
    seed = seed * 6364136223846793005ull + 1442695040888963407ull;
    return Real(seed >> 11) / 9007199254740992.0;
  }
  Vec vec() { return {(*this)() - 0.5, (*this)() - 0.5, (*this)() - 0.5}; }
};

/// Everything that a run shows, after each step.
struct Trace {
  std::vector<Real> values;
  std::int64_t leaked = 0;
  Real deepest = 0;
  Index touching = 0;
  void add(const Field<Real>& field, Index n) {
    for (int k = 0; k < 3; ++k) values.insert(values.end(), field.data(k), field.data(k) + n);
  }
};

struct WallCase {
  std::function<void(Scene&)> make;
  std::function<void(Scene&, int step)> move = [](Scene&, int) {};
  Vec gravity = Vec::Zero();
  int steps = 400;
  Real dt_factor = 0.1;
  int refresh_every = 7;
};

Trace run(const WallCase& c, bool shortcuts) {
  Scene s;
  s.options.shortcuts = shortcuts;
  c.make(s);
  s.build();
  Trace trace;
  const Real dt = c.dt_factor * s.contact->limit(s.world, s.clock).dt;
  for (int n = 0; n < c.steps; ++n) {
    if (n > 0) c.move(s, n);
    s.step(dt, c.gravity, c.refresh_every);
    const InterfaceForce now = s.contact->report();
    for (int k = 0; k < 3; ++k) trace.values.push_back(now.on_surfa[k]);
    trace.values.insert(trace.values.end(), {now.energy_stored, now.energy_damping, now.energy_friction});
    if (n % 10 > 0) continue;
    trace.add(s.world.particles.f, s.world.particles.size());
    trace.add(s.world.particles.x, s.world.particles.size());
    for (Index i = 0; i < s.world.particles.size(); ++i)
      trace.touching += s.world.particles.f.vec(i).norm() > 0;
  }
  s.contact->show_forces(s.world);
  trace.add(s.world.nodes.f, s.world.nodes.size());
  trace.add(*s.world.segments.contact_force, s.world.segments.size());
  trace.leaked = s.world.counters.at("leaked_particles");
  trace.deepest = s.world.maxima.at("max_penetration");
  return trace;
}

Trace expect_same_bits(const WallCase& c) {
  const Trace with = run(c, true), without = run(c, false);
  EXPECT_EQ(with.values.size(), without.values.size());
  EXPECT_EQ(std::memcmp(with.values.data(), without.values.data(), with.values.size() * sizeof(Real)), 0);
  EXPECT_EQ(with.leaked, without.leaked);
  EXPECT_EQ(with.deepest, without.deepest);
  EXPECT_GT(with.touching, 0);
  return with;
}

void box(Scene& s, Real a) {
  const Vec o = Vec::Zero(), X(a, 0, 0), Y(0, a, 0), Z(0, 0, a);
  s.plate(o, X, Y, 7, 5), s.plate(Z, X, Y, 4, 9);
  s.plate(o, X, Z, 3, 8), s.plate(Y, X, Z, 6, 6);
  s.plate(o, Y, Z, 11, 2), s.plate(X, Y, Z, 5, 5);
}

/// A channel with a step in its bed, one shell wide in z, and particles at rest on lattice points, many of
/// them straight over the joints of shells.
void channel(Scene& s) {
  s.world.dim = 2;
  const Real dx = 0.02, z = 0.005;
  const Vec o(0, 0, -z), Z(0, 0, 2 * z);
  s.plate(o, Vec(0.3, 0, 0), Z, 30, 1);
  s.plate(Vec(0.3, 0, -z), Vec(0, 0.04, 0), Z, 4, 1);
  s.plate(Vec(0.3, 0.04, -z), Vec(0.2, 0, 0), Z, 20, 1);
  s.plate(Vec(0, 0.1, -z), Vec(0, 0.2, 0), Z, 20, 1);
  for (int i = 0; i < 15; ++i)
    for (int j = 0; j < 3; ++j) s.x.push_back(Vec((i + 0.5) * dx, (j + 0.5) * dx, 0));
  for (int i = 0; i < 5; ++i) s.x.push_back(Vec(0.305 + 0.03 * i, 0.0499, 0));
  s.v.assign(s.x.size(), Vec::Zero());
}

TEST(Shortcuts, RestOverJointsIn2D) {
  WallCase c;
  c.make = channel;
  c.gravity = Vec(0, -9.81, 0);
  c.steps = 1500;
  expect_same_bits(c);
}

TEST(Shortcuts, MotionAlongAndAcrossWallsIn2D) {
  for (const Real speed : {0.05, 2.0}) {
    WallCase c;
    c.make = [=](Scene& s) {
      channel(s);
      RandomVectors random;
      for (Vec& v : s.v) {
        v = 2 * speed * random.vec();
        v.z() = 0;
      }
    };
    c.gravity = Vec(0, -9.81, 0);
    c.steps = 2000;
    c.refresh_every = 3;
    expect_same_bits(c);
  }
}

TEST(Shortcuts, BoxOfPatchesWithEdgesAndCorners) {
  for (const auto& [speed, literal] :
       std::vector<std::pair<Real, bool>>{{0.2, false}, {6.0, false}, {6.0, true}}) {
    WallCase c;
    c.make = [speed = speed, literal = literal](Scene& s) {
      s.law.literal = literal;
      s.thickness = 0.004;
      if (speed > 1) s.options.reach_margin = 0.05;
      box(s, 0.1);
      RandomVectors random;
      for (int i = 0; i < 300; ++i) {
        s.x.push_back(Vec(0.05, 0.05, 0.05) + 0.095 * random.vec());
        // on the bisectors of edges and in corners, where two or three walls are equally deep
        if (i % 10 == 0) s.x.back() = Vec(0.0015, 0.0015, s.x.back().z());
        if (i % 10 == 1) s.x.back() = Vec(0.0985, s.x.back().y(), 0.0985);
        if (i % 50 == 2) s.x.back() = Vec(0.0015, 0.0015, 0.0015);
        s.v.push_back(i % 10 < 3 ? Vec(Vec::Zero()) : Vec(speed * random.vec()));
      }
    };
    c.steps = speed > 1 ? 150 : 1000;
    const Trace t = expect_same_bits(c);
    EXPECT_EQ(t.leaked > 0, literal);
  }
}

// Triangles, warped and overlapping shells, in the order and at the size that chance gives.
TEST(Shortcuts, RandomShells) {
  for (int seed = 1; seed <= 12; ++seed) {
    WallCase c;
    c.make = [=](Scene& s) {
      RandomVectors random;
      random.seed = 1000 * std::uint64_t(seed);
      s.law.penopt = 1 + seed % 3;
      for (int k = 0; k < 25; ++k) {
        const Vec o = 0.1 * random.vec(), a = 0.1 * random.vec(), b = 0.1 * random.vec();
        if (seed % 2) {  // in one of three planes
          const int axis = k % 3;
          Vec p = o, e = a, f = b;
          p[axis] = 0.02 * (k % 2), e[axis] = f[axis] = 0;
          s.quads.push_back({p, p + e, p + e + f, p + (k % 4 ? f : Vec(e + f))});
        } else {
          s.quads.push_back({o, o + a, o + a + b + 0.02 * random.vec(), k % 4 ? Vec(o + b) : Vec(o + a + b)});
        }
      }
      s.plate(Vec(-0.1, -0.1, -0.06), Vec(0.2, 0, 0), Vec(0, 0.2, 0), 8, 8);
      for (int i = 0; i < 400; ++i) {
        s.x.push_back(0.15 * random.vec());
        s.v.push_back(random.vec());
      }
    };
    c.gravity = Vec(0, 0, -2);
    expect_same_bits(c);
  }
}

TEST(Shortcuts, FrictionDampingAndSoft) {
  for (int kind = 0; kind < 3; ++kind) {
    WallCase c;
    c.make = [=](Scene& s) {
      s.thickness = 0.004;
      box(s, 0.1);
      s.law.soft = kind == 0 ? 1 : 0;
      if (kind == 1) s.law.vdc = 20;
      if (kind == 2) s.law.fs = s.law.fd = 0.2;
      RandomVectors random;
      for (int i = 0; i < 200; ++i) {
        s.x.push_back(Vec(0.05, 0.05, 0.05) + 0.095 * random.vec());
        s.v.push_back(0.4 * random.vec());
      }
    };
    c.steps = 1000;
    c.gravity = Vec(0, 0, -9.81);
    expect_same_bits(c);
  }
}

// Half of the walls move and turn, also through particles that were far away.
TEST(Shortcuts, MovingWalls) {
  WallCase c;
  c.make = [](Scene& s) {
    s.held = false;
    s.plate(Vec(0, 0, 0), Vec(0.1, 0, 0), Vec(0, 0.1, 0), 3, 3);
    s.plate(Vec(0, 0, 0.06), Vec(0.1, 0, 0), Vec(0, 0.1, 0), 2, 2);
    RandomVectors random;
    for (int i = 0; i < 300; ++i) {
      s.x.push_back(Vec(0.05, 0.05, 0.03) + Vec(0.12, 0.12, 0.08).cwiseProduct(random.vec()));
      s.v.push_back(0.3 * random.vec());
    }
  };
  c.move = [](Scene& s, int) {
    const Real dt = s.clock.dt_old;
    for (Index n = 0; n < 36; ++n) {
      const Vec x = s.world.nodes.x.vec(n), from = x - Vec(0.05, 0.05, 0.03);
      const Vec to = Vec(0.05, 0.05, 0.03) + Eigen::AngleAxisd(3 * dt, Vec(1, 2, 0).normalized()) * from;
      s.world.nodes.x.set(n, to);
      s.world.nodes.v.set(n, (to - x) / dt);
    }
  };
  c.steps = 1000;
  c.refresh_every = 3;
  expect_same_bits(c);
}

// Shells of one plane whose normals point in either case, as meshes from several sources have them.
TEST(Shortcuts, NeighboursThatFaceEitherWay) {
  WallCase c;
  c.make = [](Scene& s) {
    const Real a = 0.02;
    const Vec X(a, 0, 0), Y(0, a, 0), Z(0, 0, a);
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) {
        s.plate(i * X + j * Y, (i + j) % 2 ? X : Y, (i + j) % 2 ? Y : X);
        s.plate(i * X + j * Z, (i + j) % 3 ? X : Z, (i + j) % 3 ? Z : X);
      }
    RandomVectors random;
    for (int i = 0; i < 200; ++i) {
      s.x.push_back(Vec(0.06, 0.06, 0.02) + Vec(0.1, 0.1, 0.02).cwiseProduct(random.vec()));
      s.v.push_back(Vec(random() - 0.5, random() - 0.6, -0.1));
    }
  };
  c.gravity = Vec(0, 0, -9.81);
  c.steps = 1000;
  const Trace t = expect_same_bits(c);
  EXPECT_EQ(t.leaked, 0);
}

// Round a free edge and back while candidates stay the same, each time down to a touch on the other side:
// what was on one side when it was last looked at must not seem to come through the wall.
TEST(Shortcuts, RoundAnEdge) {
  WallCase c;
  const std::vector<Vec> corners = {Vec(-0.03, 0.05, 0.009), Vec(-0.03, 0.05, 0.06),
                                    Vec(0.04, 0.05, 0.06),   Vec(0.04, 0.05, -0.06),
                                    Vec(-0.03, 0.05, -0.06), Vec(-0.03, 0.05, -0.009)};
  std::vector<Vec> path;
  for (int k = 0; k < 4; ++k)
    for (std::size_t j = 0; j < corners.size(); ++j)
      path.push_back(corners[k % 2 ? corners.size() - 1 - j : j]);
  c.make = [=](Scene& s) {
    s.options.reach_margin = 0.2;
    s.plate(Vec(-0.1, 0, 0), Vec(0.1, 0, 0), Vec(0, 0.1, 0), 5, 5);
    s.x = {path[0]};
    s.v = {Vec::Zero()};
  };
  const int leg = 50;
  c.move = [=](Scene& s, int step) {
    const std::size_t k = std::size_t(step / leg);
    if (k + 1 >= path.size()) return;
    s.world.particles.v.set(0, (path[k + 1] - path[k]) / (leg * s.clock.dt));
  };
  c.steps = leg * int(path.size() - 1);
  c.dt_factor = 1e-3;
  c.refresh_every = 1000000;
  EXPECT_EQ(expect_same_bits(c).leaked, 0);
}

TEST(Shortcuts, BirthAndDeath) {
  WallCase c;
  c.make = [](Scene& s) {
    channel(s);
    s.law.birth = 0.01, s.law.death = 0.05;
  };
  c.gravity = Vec(0, -9.81, 0);
  c.steps = 1500;
  expect_same_bits(c);
}

}  // namespace
