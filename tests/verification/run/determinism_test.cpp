// The hydraulic jump with inflow, box and contact: the same bits on 1, 2 and 4 threads.
#include <gtest/gtest.h>

#include "app/run/simulation.hpp"
#include "parallel/parallel.hpp"
#include "scenes.hpp"

using namespace courant;

TEST(Determinism, TheJumpHasTheSameBitsOnAnyNumberOfThreads) {
  std::vector<Real> reference;
  for (const int n : {1, 2, 4}) {
    set_threads(n);
    auto s = test::simulation("hydraulic_jump", {{"endtim", "0.4"}});
    while (s->clock().t < 0.4) s->step([](World&, const Clock&, const std::string&) {});
    sample_energy(s->world(), s->clock());
    const Particles& p = s->world().particles;
    std::vector<Real> state{s->clock().t, s->world().energy.total(), s->world().energy.dissipated,
                            s->world().energy.external_work, s->world().maxima.at("max_penetration")};
    for (const auto* f : {&p.x, &p.v})
      for (int k = 0; k < 3; ++k) state.insert(state.end(), f->data(k), f->data(k) + p.size());
    for (const auto* f : {&p.rho, &p.p, &p.E}) state.insert(state.end(), f->data(), f->data() + p.size());
    if (reference.empty()) reference = state;
    EXPECT_TRUE(reference == state) << n << " threads";
  }
  set_threads(0);
}
