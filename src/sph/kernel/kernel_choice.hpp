#pragma once
// The kernel of a run, chosen by the deck: one for all particles.
#include <algorithm>
#include <array>
#include <cmath>

#include "sph/kernel/kernel.hpp"

namespace courant {

/// The first four in the order of SPHKERN of *SECTION_SPH.
enum class KernelChoice {
  cubic_spline,
  quintic_spline,
  quadratic_spline,
  quartic_spline,
  wendland_c2,
  wendland_c4
};
inline constexpr std::array every_kernel{KernelChoice::cubic_spline,     KernelChoice::quintic_spline,
                                         KernelChoice::quadratic_spline, KernelChoice::quartic_spline,
                                         KernelChoice::wendland_c2,      KernelChoice::wendland_c4};

/// Calls `f` with the chosen kernel's struct: one position where the choice becomes a type.
template <class F>
decltype(auto) with_kernel(KernelChoice choice, F&& f) {
  switch (choice) {
    case KernelChoice::quintic_spline:
      return f(QuinticSpline{});
    case KernelChoice::quadratic_spline:
      return f(QuadraticSpline{});
    case KernelChoice::quartic_spline:
      return f(QuarticSpline{});
    case KernelChoice::wendland_c2:
      return f(WendlandC2{});
    case KernelChoice::wendland_c4:
      return f(WendlandC4{});
    default:
      return f(CubicSpline{});
  }
}

/// The same kernel for loops that are not compiled for it; lives as long as the program.
inline const AnyKernel& any_kernel(KernelChoice choice) {
  return with_kernel(choice, [](auto kernel) -> const AnyKernel& {
    static constexpr AnyKernel any = AnyKernel::of<decltype(kernel)>();
    return any;
  });
}

inline const char* kernel_name(KernelChoice choice) {
  return with_kernel(choice, [](auto kernel) { return decltype(kernel)::name; });
}
/// How far the kernel reaches, in h.
inline Real kernel_support(KernelChoice choice) {
  return with_kernel(choice, [](auto kernel) { return decltype(kernel)::support; });
}
/// 1/theta(R) at the distance of neighbours, R = dx/h; bounded where h is given much smaller than that.
inline Real kernel_at_spacing(KernelChoice choice, Real R) {
  constexpr Real least_shape = 0.05;
  return with_kernel(choice, [R](auto kernel) {
    return 1 / std::max(kernel.shape(R), least_shape * kernel.shape(Real(0)));
  });
}
/// What turns `gradient` of a kernel into dW/dr [1/L^(dim + 1)].
inline Real gradient_norm(KernelChoice choice, int dim, Real h) {
  return with_kernel(choice, [&](auto kernel) {
    return decltype(kernel)::gradient_factor * decltype(kernel)::C(dim) / std::pow(h, dim + 1);
  });
}
/// The largest value of `gradient` of a kernel.
inline Real steepest_gradient(KernelChoice choice) {
  return with_kernel(
      choice, [](auto kernel) { return decltype(kernel)::gradient(Real(decltype(kernel)::steepest)); });
}

}  // namespace courant
