// What walls feel, and what particles remember when they leave.
#include <gtest/gtest.h>

#include "scene.hpp"

using namespace courant;
using courant::test::Scene;

namespace {

struct Sums {
  Vec particles = Vec::Zero(), nodes = Vec::Zero(), segments = Vec::Zero();
};

Sums sums(const World& w) {
  Sums s;
  for (Index i = 0; i < w.particles.size(); ++i) s.particles += w.particles.f.vec(i);
  for (Index n = 0; n < w.nodes.size(); ++n) s.nodes += w.nodes.f.vec(n);
  for (Index k = 0; k < w.segments.size(); ++k) s.segments += w.segments.contact_force->vec(k);
  return s;
}

/// Both interfaces see the same plate, one of them particle 0 and the other one particle 1.
void share_a_plate(bool held) {
  Scene s;
  s.held = held;
  s.plate(Vec(0, 0, 0), Vec(0.1, 0, 0), Vec(0, 0.1, 0), 2, 2);
  s.x = {Vec(0.02, 0.03, 0.004), Vec(0.02, 0.02, 0.007)};
  s.build();
  World& w = s.world;
  const std::vector<Index> segments = {0, 1, 2, 3}, identity = {0, 1};
  std::vector<std::shared_ptr<Contact>> contacts;
  for (int k = 0; k < 2; ++k) {
    std::vector<bool> tracked(2, false);
    tracked[k] = true;
    contacts.push_back(std::make_shared<Contact>(s.law, s.options, 2 + k, segments, tracked, w));
    contacts[k]->refreshed(w, s.clock, identity);
  }
  for (int step = 0; step < 3; ++step) {
    for (int k = 0; k < 3; ++k) std::fill_n(w.particles.f.data(k), 2, 0.0);
    s.clear_walls();
    for (auto& c : contacts) c->start(w, s.clock);
    for (auto& c : contacts) c->block(w, s.clock, 0, 2);
    for (auto& c : contacts) c->finish(w, s.clock), s.gather(*c);
    if (step != 1)  // what nobody asked for must not be missing later
      for (int twice = 0; twice < 2; ++twice)
        for (auto& c : contacts) c->show_forces(w);
    const Sums f = sums(w);
    EXPECT_GT(f.particles.z(), 0);
    if (step == 1 && held) {
      EXPECT_EQ(f.nodes.norm() + f.segments.norm(), 0);
      continue;
    }
    EXPECT_NEAR((f.nodes + f.particles).norm(), 0, 1e-12 * f.particles.norm());
    EXPECT_NEAR((f.segments + f.particles).norm(), 0, 1e-12 * f.particles.norm());
    EXPECT_NEAR((contacts[0]->report().on_surfa + contacts[1]->report().on_surfa - f.particles).norm(), 0,
                1e-12 * f.particles.norm());
  }
}

TEST(Reaction, PassesAddItToNodesAndFaces) {
  for (const bool held : {true, false}) {
    Scene s;
    s.held = held;
    s.plate(Vec(0, 0, 0), Vec(0.1, 0, 0), Vec(0, 0.1, 0), 2, 2);
    s.x = {Vec(0.02, 0.03, 0.004), Vec(0.07, 0.02, 0.007)};
    s.build();
    World& w = s.world;
    add_contact(w, s.contact);
    for (int step = 0; step < 2; ++step) {
      s.clear(), s.clear_walls();
      for (Force* pass : w.passes.all<Force>()) {
        pass->start(w, s.clock), pass->block(w, s.clock, 0, pass->over(w).size());
        pass->finish(w, s.clock);
      }
    }
    const Sums f = sums(w);
    EXPECT_GT(f.particles.z(), 0);
    EXPECT_NEAR((f.nodes + (held ? 0 : 1) * f.particles).norm(), 0, 1e-12 * f.particles.norm());
    if (!held) EXPECT_NEAR((f.segments + f.particles).norm(), 0, 1e-12 * f.particles.norm());
  }
}

TEST(Reaction, TwoInterfacesAddUpOnSharedNodes) {
  share_a_plate(true);
  share_a_plate(false);
}

TEST(Reaction, IsTakenBackWhenTheParticleHasGone) {
  for (const bool held : {true, false}) {
    Scene s;
    s.held = held;
    s.plate(Vec(0, 0, 0), Vec(0.1, 0, 0), Vec(0, 0.1, 0), 2, 2);
    s.x = {Vec(0.02, 0.03, 0.004)};
    s.build();
    courant::test::run(*s.contact, s.world, s.clock);
    s.gather(*s.contact);
    s.contact->show_forces(s.world);
    EXPECT_GT(sums(s.world).nodes.norm(), 0);
    s.world.particles.x.set(0, Vec(0.02, 0.03, 0.5));
    s.refresh();
    s.clear_walls();
    courant::test::run(*s.contact, s.world, s.clock);
    s.gather(*s.contact);
    s.contact->show_forces(s.world);
    EXPECT_EQ(sums(s.world).nodes.norm() + sums(s.world).segments.norm(), 0);
  }
}

/// 60 x 60 particles at uneven depths in a plate of 40 x 40 faces that moves: forces of nodes, then of faces.
std::vector<Real> forces_of_many(int on_threads) {
  const int before = threads();
  set_threads(on_threads);
  Scene s;
  s.held = false;
  s.plate(Vec(0, 0, 0), Vec(1, 0, 0), Vec(0, 1, 0), 40, 40);
  for (int k = 0; k < 3600; ++k)
    s.x.emplace_back((k % 60 + 0.5) / 60, (k / 60 + 0.5) / 60, 0.002 + 0.001 * ((k * 7) % 5));
  s.build();
  courant::test::run(*s.contact, s.world, s.clock);
  s.gather(*s.contact);
  set_threads(before);
  const Sums f = sums(s.world);
  EXPECT_GT(f.particles.z(), 0);
  EXPECT_NEAR((f.nodes + f.particles).norm(), 0, 1e-12 * f.particles.norm());
  EXPECT_NEAR((f.segments + f.particles).norm(), 0, 1e-12 * f.particles.norm());
  std::vector<Real> out;
  for (Index n = 0; n < s.world.nodes.size(); ++n) out.push_back(s.world.nodes.f.vec(n).z());
  for (Index k = 0; k < s.world.segments.size(); ++k) {
    // each face's share lies where its particles do, so the sum of its nodes is its own
    Real of_nodes = 0;
    for (int e = 0; e < 4; ++e) of_nodes += s.world.nodes.f.vec(4 * k + e).z();
    out.push_back(s.world.segments.contact_force->vec(k).z());
    EXPECT_NEAR(of_nodes, out.back(), 1e-12 * f.particles.norm());
  }
  return out;
}

TEST(Reaction, OfManyTouchesHasTheSameBitsOnAnyNumberOfThreads) {
  const std::vector<Real> one = forces_of_many(1);
  for (const int n : {2, 3, 4}) EXPECT_EQ(forces_of_many(n), one) << n << " threads";
}

// One that was pulled back from behind a wall and leaves the box there comes back as a new one.
TEST(Refreshed, ForgetsThoseThatLeave) {
  Scene s;
  s.thickness = 0.004;
  s.plate(Vec(0, 0, 0), Vec(0.1, 0, 0), Vec(0, 0.1, 0));
  s.x = {Vec(0.05, 0.05, 0.003), Vec(0.04, 0.05, 0.003)};
  s.v = {Vec::Zero(), Vec(0, 0, -4)};
  s.build();
  s.step(1e-3);
  s.step(1e-3);
  Particles& p = s.world.particles;
  auto& admissible = *dynamic_cast<Field<Real>*>(p.fields.find("contact_1_admissible"));
  ASSERT_GT(admissible.vec(1).norm(), 0);
  p.active = 1;  // the other one is in the halo now
  s.refresh();
  EXPECT_EQ(admissible.vec(1).norm(), 0);
}

}  // namespace
