#pragma once
// A small world of particles and plates for contact tests, with its own leapfrog loop.
#include <functional>
#include <memory>
#include <numeric>

#include "../run_pass.hpp"
#include "contact/contact.hpp"

namespace courant::test {

struct Scene {
  World world;
  Clock clock;
  std::vector<std::array<Vec, 4>> quads;
  std::vector<Vec> x, v;
  Real thickness = 0.02, m = 1e-3, rho = 1000, c = 10, K = 1e9;
  bool held = true;
  ContactLaw law;
  ContactOptions options{.reach_margin = 0.02};
  std::shared_ptr<Contact> contact;
  std::function<void()> before_move = [] {};

  /// n1 x n2 quads over the parallelogram from `o` along a and b; no node is shared, not even within the
  /// patch.
  void plate(const Vec& o, const Vec& a, const Vec& b, int n1 = 1, int n2 = 1) {
    for (int i = 0; i < n1; ++i)
      for (int j = 0; j < n2; ++j) {
        const Vec p = o + a * i / n1 + b * j / n2;
        quads.push_back({p, p + a / n1, p + a / n1 + b / n2, p + b / n2});
      }
  }

  void build(Real node_mass = 1) {
    world.nodes.fields.resize(Index(4 * quads.size()));
    Segments& g = world.segments;
    g.fields.resize(Index(quads.size()));
    for (Index s = 0; s < g.size(); ++s) {
      for (int e = 0; e < 4; ++e) {
        world.nodes.x.set(4 * s + e, quads[s][e]);
        world.nodes.m[4 * s + e] = node_mass;
        world.nodes.held[4 * s + e] = held ? 1 : 0;
      }
      g.node0[s] = 4 * s, g.node1[s] = 4 * s + 1, g.node2[s] = 4 * s + 2, g.node3[s] = 4 * s + 3;
      g.thickness[s] = thickness;
      g.K[s] = K;
      g.id[s] = s + 1;
    }
    Particles& p = world.particles;
    p.fields.resize(Index(x.size()));
    p.active = p.moving = p.size();
    for (Index i = 0; i < p.size(); ++i) {
      p.x.set(i, x[i]);
      p.v.set(i, v.empty() ? Vec(Vec::Zero()) : v[i]);
      p.m[i] = m, p.rho[i] = rho, p.c[i] = c, p.id[i] = i + 1;
    }
    std::vector<Index> segments(g.size());
    std::iota(segments.begin(), segments.end(), 0);
    contact = std::make_shared<Contact>(law, options, 1, segments, std::vector<bool>(p.size(), true), world);
    refresh();
  }

  void refresh() {
    std::vector<Index> identity(world.particles.size());
    std::iota(identity.begin(), identity.end(), 0);
    contact->refreshed(world, clock, identity);
  }

  void clear() {
    for (int k = 0; k < 3; ++k) {
      std::fill_n(world.particles.f.data(k), world.particles.size(), 0.0);
      std::fill_n(world.nodes.f.data(k), world.nodes.size(), 0.0);
    }
  }
  /// What nodes and faces of walls that move get of an interface, as the passes behind it do.
  void gather(const Contact& from) {
    if (!from.has_moving_walls()) return;
    for (Index n = 0; n < world.nodes.size(); ++n) {
      Vec force = Vec::Zero();
      from.add_reaction_on_node(n, force);
      world.nodes.f.add(n, force);
    }
    for (Index s = 0; s < world.segments.size(); ++s) {
      Vec force = Vec::Zero();
      from.add_reaction_on_segment(s, force);
      world.segments.contact_force->add(s, force);
    }
  }
  /// Forces on walls that move are cleared in each step; those on walls that are held, by the interface.
  void clear_walls() {
    for (int k = 0; k < 3 && !held; ++k) {
      std::fill_n(world.nodes.f.data(k), world.nodes.size(), 0.0);
      std::fill_n(world.segments.contact_force->data(k), world.segments.size(), 0.0);
    }
  }

  Vec force(const Vec& at) {
    world.particles.x.set(0, at);
    world.particles.v.set(0, Vec::Zero());
    refresh();
    clear();
    courant::test::run(*contact, world, clock);
    return world.particles.f.vec(0);
  }

  void step(Real dt, const Vec& gravity = Vec::Zero(), int refresh_every = 5) {
    clock.dt = dt;
    if (clock.cycle % refresh_every == 0) refresh();
    clear();
    courant::test::run(*contact, world, clock);
    gather(*contact);
    contact->strike(world, clock);
    contact->record(world, clock, world.energy);
    before_move();
    Particles& p = world.particles;
    for (Index i = 0; i < p.size(); ++i) {
      p.v.add(i, (p.f.vec(i) / p.m[i] + gravity) * clock.dt_mean());
      p.x.add(i, p.v.vec(i) * dt);
    }
    clock.t += dt;
    clock.dt_old = dt;
    ++clock.cycle;
  }

  Real kinetic() const {
    Real e = 0;
    for (Index i = 0; i < world.particles.size(); ++i)
      e += 0.5 * world.particles.m[i] * world.particles.v.vec(i).squaredNorm();
    return e;
  }
};

}  // namespace courant::test
