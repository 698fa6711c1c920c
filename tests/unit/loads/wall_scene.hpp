#pragma once
// Particles and nodes with rigid walls.
#include <gtest/gtest.h>

#include "../keyword/decks_in_memory.hpp"
#include "../sph/cloud.hpp"
#include "loads/loads.hpp"
#include "loads/point_motion.hpp"
#include "state/reports.hpp"
#include "time/step.hpp"

namespace courant::test {

/// Steps of changing size.
struct WallSteps : TimeLimit {
  std::string name() const override { return "steps"; }
  bool rings() const override { return false; }
  Limit limit(const World&, const Clock& clock) override {
    return {1e-3 * static_cast<Real>(1 + (clock.cycle * 7) % 5), "test"};
  }
};

struct Pull : Force {
  Points points;
  Vec force;
  Pull(Points points, const Vec& force) : points(points), force(force) {}
  std::string name() const override { return "pull"; }
  const FieldSet& over(const World&) const override { return points.fields(); }
  void declare(const World&, Accesses& a) const override { a.updates(*points.f); }
  void block(World&, const Clock&, Index begin, Index end) override {
    for (Index i = begin; i < end; ++i) points.f->add(i, force);
  }
};

/// A particle (id 1) and nodes 11, 12, ... of mass 2 with rigid walls; a rigid body moves the last node.
struct WallScene {
  Cloud cloud{3, 1, 0.01, 0};
  World& w = cloud.world;
  Model model;
  PassTimer timer;
  std::unique_ptr<Stepper> stepper;
  Diagnostics diagnostics;
  RigidWallPenalty penalty{};
  Real kinetic = 0;
  Vec momentum = Vec::Zero();  ///< of the points

  explicit WallScene(Index nodes = 2) {
    w.particles.m[0] = 2;
    w.particles.h[0] = 100;  // it may go far in a step
    w.nodes.fields.resize(nodes);
    model.nodes.resize(1 + static_cast<std::size_t>(nodes));
    model.nodes[0].id = 1;
    model.sph.push_back({0, 0, 2.0, {}});
    for (Index n = 0; n < nodes; ++n) {
      w.nodes.id[n] = 11 + n, w.nodes.m[n] = 2, w.nodes.follow[n] = n == nodes - 1;
      model.nodes[1 + static_cast<std::size_t>(n)].id = 11 + n;
    }
  }
  std::array<Points, 2> sets() { return {points_of(w.particles), points_of(w.nodes)}; }
  void place(const Vec& x, const Vec& v) {
    for (const Points& p : sets()) p.x->set(0, x), p.v->set(0, v);
    model.nodes[0].x = model.nodes[1].x = x;
  }
  void walls(const std::string& keywords) {
    const ReadDeck read = read_in_memory(in_memory("*KEYWORD\n" + keywords + "*END\n"));
    EXPECT_TRUE(read.diagnostics.ok()) << read.diagnostics.text();
    add_rigid_walls(read.deck, model, penalty, w, diagnostics);
  }
  void gravity(const Vec& g) {
    for (const Points& p : sets())
      w.passes.add(make_body_load(
          BodyAcceleration({{.direction = -g.normalized(),
                             .curve = {.id = 1, .abscissa = {0, 1}, .ordinate = {g.norm(), g.norm()}}}}),
          p, w, p.set == &w.particles.fields ? cloud.neighbours : nullptr));
  }
  void start() {
    for (const Points& p : sets()) {
      w.passes.add(make_clear_forces(p));
      w.passes.add(make_point_motion(p));
    }
    w.passes.add(std::make_shared<WallSteps>());
    stepper = std::make_unique<Stepper>(w, cloud.neighbours.get(), StepRules{}, timer);
  }
  void steps(int n) {
    for (int k = 0; k < n; ++k)
      stepper->step(cloud.clock, [&](World& world, const Clock& clock, const std::string&) {
        sample_energy(world, clock);
        kinetic = 0, momentum.setZero();
        for (const Points& p : sets())
          for (Index i = 0; i < loaded_points(p, w); ++i) {
            const Vec v = p.v->vec(i) + p.f->vec(i) / (*p.m)[i] * 0.5 * clock.dt_mean();
            if (p.follow && (*p.follow)[i]) continue;
            kinetic += 0.5 * (*p.m)[i] * v.squaredNorm();
          }
      });
    momentum.setZero();
    for (const Points& p : sets())
      for (Index i = 0; i < loaded_points(p, w); ++i)
        if (!(p.follow && (*p.follow)[i])) momentum += (*p.m)[i] * p.v->vec(i);
  }
  RigidWallForce wall(std::size_t k = 0) { return w.passes.all<RigidWallReporter>().at(k)->report_wall(); }
};

}  // namespace courant::test
