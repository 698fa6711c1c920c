#pragma once
// Kernels of eight pairs at once, for loops that take the kernel as a type (files *_loops.cpp).
#include <type_traits>

#include "sph/core/pair_packs.hpp"
#include "sph/kernel/kernel_choice.hpp"

namespace courant::COURANT_SIMD {

COURANT_INLINE Pack positive(const Pack& a) {
  return max(a, Pack::zero());
}

/// The kernel of a loop: of a type of its own, or what the run has.
template <class Kernel>
COURANT_INLINE Kernel kernel_of([[maybe_unused]] const AnyKernel* any) {
  if constexpr (std::is_same_v<Kernel, AnyKernel>)
    return *any;
  else
    return {};
}

/// C/h^Dim
template <int Dim, class Kernel>
COURANT_INLINE Real shape_norm(const Kernel& kernel, Real h) {
  return kernel.C(Dim) / power<Dim>(h);
}
template <int Dim, class Kernel>
COURANT_INLINE Pack shape_norm(const Kernel& kernel, const Pack& hinv) {
  return kernel.C(Dim) * hinv * hinv * (Dim == 3 ? hinv : Pack::of(1));
}
/// The factor that turns `gradient_shape` into (dW/dr)/r.
template <int Dim, class Kernel>
COURANT_INLINE Real gradient_norm(const Kernel& kernel, Real h) {
  return kernel.gradient_factor * kernel.C(Dim) / power<Dim + 1>(h);
}
template <int Dim, class Kernel>
COURANT_INLINE Pack gradient_norm(const Kernel& kernel, const Pack& hinv) {
  return kernel.gradient_factor * kernel.C(Dim) * hinv * hinv * hinv * (Dim == 3 ? hinv : Pack::of(1));
}
/// `gradient` and `half_curvature` of the kernel.
template <class Kernel>
COURANT_INLINE void slopes_at(const Kernel& kernel, const Pack& R, Pack& gradient, Pack& half_curvature) {
  if constexpr (std::is_same_v<Kernel, AnyKernel>)
    kernel.slopes(R, gradient, half_curvature);
  else
    gradient = kernel.gradient(R), half_curvature = kernel.half_curvature(R);
}
/// Slope of the kernel, but for a constant, over r.
template <class Kernel>
COURANT_INLINE Pack gradient_shape(const Kernel& kernel, const Pack& R, const Pack& rinv) {
  return kernel.gradient(R) * rinv;
}

/// Slope of the kernel over gradient_norm of h_i; where h differs, the mean of the slopes with h_i and h_j.
template <int Dim, bool UniformH, class Kernel>
COURANT_INLINE Pack mean_gradient(const Kernel& kernel, const Pack& r, const Pack& hinv,
                                  [[maybe_unused]] const Real* h, [[maybe_unused]] std::ptrdiff_t j,
                                  [[maybe_unused]] const Pack& norm) {
  const Pack own = kernel.gradient(r * hinv);
  if constexpr (UniformH)
    return own;
  else
    return 0.5 * (own + kernel.gradient(r * (1 / h[j])) * gradient_norm<Dim>(kernel, h[j]) / norm);
}
/// 1/h of eight particles, all the same or each its own.
template <bool UniformH>
COURANT_INLINE Pack inverse_h(const Real* h, Real h0, Index i, Index count) {
  return UniformH ? Pack::of(1 / h0) : 1 / Pack::load(h + i, count);
}

/// Calls `f` with a kernel type that loops of options are compiled for: the cubic spline's own where
/// instruction sets are worth it, else that of any kernel. Under
/// AddressSanitizer, which makes loops slow to compile, that one does for all.
template <class F>
COURANT_INLINE auto with_loop_kernel([[maybe_unused]] KernelChoice choice, const F& f) {
#if COURANT_SIMD_BYTES > 16 && !defined(__SANITIZE_ADDRESS__)
  if (choice == KernelChoice::cubic_spline) return f(std::type_identity<CubicSpline>{});
#endif
  return f(std::type_identity<AnyKernel>{});
}

}  // namespace courant::COURANT_SIMD
