#pragma once
// Two edges that touch, for tests.
#include <array>
#include <memory>

#include "contact/edges/edge_contact.hpp"

namespace courant::test::edges {

inline constexpr Real r = 0.05, k = 4;  // of the softer edge, times 0.1

/// Edge a along x above edge b, at a third of a and at 0.6 of b, or side by side over 0.8 of the length 1 of
/// both.
struct EdgeScene {
  World world;
  Clock clock;
  NodeContactLaw law;
  std::shared_ptr<EdgeContact> contact;
  bool parallel = false, held = false;
  std::array<unsigned, 2> sides{1, 2};
  Real gap = 0.001;
  Vec v{0, 0, -1};

  void build() {
    Nodes& nodes = world.nodes;
    nodes.fields.resize(4);
    const Real z = 2 * r + gap;
    const Vec a0 = parallel ? Vec(0.2, 0, z) : Vec(-0.3, 0, z), along(1, 0, 0);
    const Vec b0 = parallel ? Vec(0, 0, 0) : Vec(0, -0.6, 0), of_b = parallel ? along : Vec(0, 1, 0);
    const Vec x[4] = {a0, a0 + along, b0, b0 + of_b};
    for (Index n = 0; n < 4; ++n) {
      nodes.x.set(n, x[n]), nodes.id[n] = n + 1, nodes.m[n] = 1 + 0.5 * static_cast<Real>(n);
      nodes.held[n] = held && n > 1;
      nodes.v.set(n, n < 2 ? v : Vec(Vec::Zero()));
    }
    std::vector<ContactEdge> edges(2);
    edges[0].node = {0, 1}, edges[1].node = {2, 3};
    edges[0].k = 90, edges[1].k = 40, edges[0].area = 0.3, edges[1].area = 0.2;
    for (std::size_t e = 0; e < 2; ++e) edges[e].r = r, edges[e].sides = sides[e], edges[e].always = true;
    world.segments.fields.resize(2);
    world.segments.keep_contact_force();
    for (Index face = 0; face < 2; ++face) edges[static_cast<std::size_t>(face)].faces = {face};
    contact = std::make_shared<EdgeContact>(law, edges, WallBodies{}, nullptr, 1, world);
  }
  void step(Real dt) {
    clock.dt = clock.dt_old = dt;
    for (Index n = 0; n < 4; ++n) world.nodes.x.add(n, dt * world.nodes.v.vec(n));
    contact->start(world, clock);
    for (Index begin = 0; begin < 2; begin += block_size) contact->block(world, clock, begin, 2);
    contact->finish(world, clock);
  }
  /// 0.004 deep, then on at `v`.
  void come(const Vec& on) {
    step(0), step(0.005);
    for (Index n : {0, 1}) world.nodes.v.set(n, on);
    step(1e-4);
  }
  Vec force_on(Index n) const {
    Vec f = Vec::Zero();
    contact->add_force_on(n, f);
    return f;
  }
  Vec on_a() const { return force_on(0) + force_on(1); }
  EnergyLedger recorded() {
    EnergyLedger out;
    contact->record(world, clock, out);
    return out;
  }
  EnergyLedger sampled() const {
    EnergyLedger out;
    contact->sample(world, clock, out);
    return out;
  }
};

}  // namespace courant::test::edges
