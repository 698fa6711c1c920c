// Forces have the same bits whether gradients are kept from the rates or worked out again.
#include <gtest/gtest.h>

#include "cloud.hpp"

using namespace courant;
using courant::test::Cloud;

TEST(KeptGradients, LeaveNoTraceInForces) {
  for (const int dim : {2, 3})
    for (const KernelChoice kernel : every_kernel)
      for (const Real diffusion : {0.0, 0.1}) {
        std::vector<Vec> forces[2];
        for (const bool kept : {false, true}) {
          Cloud cloud(dim, dim == 2 ? 20 : 8, 0.01, 0.3);
          Particles& p = cloud.world.particles;
          cloud.settings.kernel = kernel, cloud.settings.density_diffusion = diffusion;
          cloud.settings.uniform_h = true, cloud.settings.viscosity = MonaghanViscosity{0.5};
          cloud.neighbours = std::make_shared<Neighbours>(0.003, std::nullopt, kernel_support(kernel));
          for (Index i = 0; i < p.size(); ++i) {
            const auto k = static_cast<Real>(i);
            p.v.set(i, Vec(std::sin(3 * k), std::cos(7 * k), dim == 3 ? std::sin(5 * k) : 0));
            p.p[i] = 1000 + 10 * std::sin(k);
          }
          cloud.make_pairs(kept);
          cloud.refresh();
          cloud.run_rates();
          cloud.run_forces();
          for (Index i = 0; i < p.size(); ++i) forces[kept ? 1 : 0].push_back(p.f.vec(i));
        }
        EXPECT_TRUE(forces[0] == forces[1]) << dim << "D, " << kernel_name(kernel) << ", delta " << diffusion;
      }
}
