#pragma once
// Smoothing kernels W(r, h) = C theta(r/h) / h^dim, one struct each. All share these members, theta and its
// slope without C:
//   name, support           theta is 0 from R = support on
//   C(dim)                  makes the kernel integrate to 1
//   shape(R)                theta, of numbers or of packs of them, as the next two
//   gradient(R)             slope / gradient_factor
//   half_curvature(R)       half of d gradient/dR
//   slope(R)                d theta/dR
//   steepest                R at which the slope is steepest
//   dip(R), steepness(R)    theta(0) - theta(R) and its derivative for R <= steepest, exact also near 0
//   kink                    the slope is not 0 at R = 0
//   pieces                  theta as a polynomial of (end - R)+ for each of its pieces
// Written without branches, so that pair loops vectorise. All is inlined wherever it stands: files that are
// compiled once for each instruction set must not share functions with others.
#include <algorithm>
#include <type_traits>

#include "base/real.hpp"

#define COURANT_KERNEL_INLINE [[gnu::always_inline]] inline

namespace courant {

COURANT_KERNEL_INLINE Real positive(Real x) {
  return std::max(x, Real(0));
}

/// What kernels take: an integer would make them round.
template <class T>
concept NumberOrPack = !std::is_integral_v<T>;

/// Added to r^2 relative to h^2, so that two particles in one position give zero force instead of 0/0.
inline constexpr Real tiny_distance2 = 1e-24;

/// h^n for the small powers kernels need.
template <int n>
[[gnu::always_inline]] inline Real power(Real h) {
  if constexpr (n == 0) return 1;
  return h * power<n - 1>(h);
}
template <>
[[gnu::always_inline]] inline Real power<0>(Real) {
  return 1;
}

/// The constant of one of three dimensions.
constexpr Real of_dimension(int dim, Real one, Real two, Real three) {
  return dim == 1 ? one : dim == 2 ? two : three;
}

/// theta(R) = sum over pieces of t^n (c0 + c1 t + c2 t^2), t = (end - R)+: all kernels here are such sums.
struct KernelPieces {
  struct Piece {
    Real end = 0;
    Real c[3]{};
  };
  int n;
  Piece of[3]{};
};

/// Cubic B-spline.
///   theta(R) = 1 - 3/2 R^2 + 3/4 R^3 for R < 1,  1/4 (2 - R)^3 for 1 <= R < 2.
/// Source: Jonsson et al. 2016, eqs 8-10, with C = 2/3, 10/(7 pi), 1/pi. The constants printed there (3/2,
/// 45/(14 pi), 9/(4 pi)) make the kernel integrate to 2.25.
struct CubicSpline {
  static constexpr const char* name = "cubic spline";
  static constexpr Real support = 2, gradient_factor = -0.75, steepest = 2.0 / 3.0;
  static constexpr bool kink = false;
  static constexpr KernelPieces pieces{.n = 3, .of = {{2, {0.25}}, {1, {-1}}}};
  static constexpr Real C(int dim) { return of_dimension(dim, 2.0 / 3.0, 10.0 / (7.0 * pi), 1.0 / pi); }

  template <NumberOrPack T>
  COURANT_KERNEL_INLINE static T shape(const T& R) {
    const T a = positive(2 - R), b = positive(1 - R);
    return 0.25 * a * a * a - b * b * b;
  }
  COURANT_KERNEL_INLINE static Real slope(Real R) {
    const Real a = positive(2 - R), b = positive(1 - R);
    return 3 * b * b - 0.75 * a * a;
  }
  template <NumberOrPack T>
  COURANT_KERNEL_INLINE static T gradient(const T& R) {
    const T a = positive(2 - R), b = positive(1 - R);
    return a * a - 4 * (b * b);
  }
  template <NumberOrPack T>
  COURANT_KERNEL_INLINE static T half_curvature(const T& R) {
    const T a = positive(2 - R), b = positive(1 - R);
    return 4 * b - a;
  }
  COURANT_KERNEL_INLINE static Real dip(Real R) { return R * R * (1.5 - 0.75 * R); }
  COURANT_KERNEL_INLINE static Real steepness(Real R) { return R * (3 - 2.25 * R); }
};

/// Quintic B-spline: theta(R) = (3 - R)^5 - 6 (2 - R)^5 + 15 (1 - R)^5, each as long as its bracket is
/// positive. Source: Morris, Fox and Zhu 1997; C = 1/120, 7/(478 pi), 1/(120 pi).
struct QuinticSpline {
  static constexpr const char* name = "quintic spline";
  static constexpr Real support = 3, gradient_factor = -5, steepest = 0.7592984807384511;
  static constexpr bool kink = false;
  static constexpr KernelPieces pieces{.n = 5, .of = {{3, {1}}, {2, {-6}}, {1, {15}}}};
  static constexpr Real C(int dim) {
    return of_dimension(dim, 1.0 / 120.0, 7.0 / (478.0 * pi), 1.0 / (120.0 * pi));
  }

  template <NumberOrPack T>
  COURANT_KERNEL_INLINE static T shape(const T& R) {
    const T a = positive(3 - R), b = positive(2 - R), c = positive(1 - R);
    return a * a * a * a * a - 6 * (b * b * b * b * b) + 15 * (c * c * c * c * c);
  }
  COURANT_KERNEL_INLINE static Real slope(Real R) { return gradient_factor * gradient(R); }
  template <NumberOrPack T>
  COURANT_KERNEL_INLINE static T gradient(const T& R) {
    const T a = positive(3 - R), b = positive(2 - R), c = positive(1 - R);
    const T a2 = a * a, b2 = b * b, c2 = c * c;
    return a2 * a2 - 6 * (b2 * b2) + 15 * (c2 * c2);
  }
  template <NumberOrPack T>
  COURANT_KERNEL_INLINE static T half_curvature(const T& R) {
    const T a = positive(3 - R), b = positive(2 - R), c = positive(1 - R);
    return 12 * (b * b * b) - 2 * (a * a * a) - 30 * (c * c * c);
  }
  COURANT_KERNEL_INLINE static Real dip(Real R) { return R * R * (60 - R * R * (30 - 10 * R)); }
  COURANT_KERNEL_INLINE static Real steepness(Real R) { return R * (120 - R * R * (120 - 50 * R)); }
};

/// Quadratic spline: theta(R) = 3/16 (2 - R)^2, whose slope is steepest at R = 0, so that particles do not
/// clump under pressure. Source: Johnson, Stryk and Beissel 1996; C = 1, 2/pi, 5/(4 pi).
struct QuadraticSpline {
  static constexpr const char* name = "quadratic spline";
  static constexpr Real support = 2, gradient_factor = -0.375, steepest = 0;
  static constexpr bool kink = true;
  static constexpr KernelPieces pieces{.n = 2, .of = {{2, {0.1875}}}};
  static constexpr Real C(int dim) { return of_dimension(dim, 1, 2 / pi, 5 / (4 * pi)); }

  template <NumberOrPack T>
  COURANT_KERNEL_INLINE static T shape(const T& R) {
    const T a = positive(2 - R);
    return 0.1875 * a * a;
  }
  COURANT_KERNEL_INLINE static Real slope(Real R) { return gradient_factor * gradient(R); }
  template <NumberOrPack T>
  COURANT_KERNEL_INLINE static T gradient(const T& R) {
    return positive(2 - R);
  }
  /// -1/2 within the support, 0 beyond it.
  template <NumberOrPack T>
  COURANT_KERNEL_INLINE static T half_curvature(const T& R) {
    return 0.5 * positive(1 - 1e20 * positive(2 - R)) - 0.5;
  }
  COURANT_KERNEL_INLINE static Real dip(Real R) { return 0.1875 * R * (4 - R); }
  COURANT_KERNEL_INLINE static Real steepness(Real R) { return 0.375 * (2 - R); }
};

/// Quartic B-spline: theta(R) = (5/2 - R)^4 - 5 (3/2 - R)^4 + 10 (1/2 - R)^4, each as long as its bracket is
/// positive. Source: Schoenberg's M5, as in Price 2012; C = 1/24, 96/(1199 pi), 1/(20 pi).
struct QuarticSpline {
  static constexpr const char* name = "quartic spline";
  static constexpr Real support = 2.5, gradient_factor = -4, steepest = 0.6909830056250527;
  static constexpr bool kink = false;
  static constexpr KernelPieces pieces{.n = 4, .of = {{2.5, {1}}, {1.5, {-5}}, {0.5, {10}}}};
  static constexpr Real C(int dim) {
    return of_dimension(dim, 1.0 / 24.0, 96.0 / (1199.0 * pi), 1.0 / (20.0 * pi));
  }

  template <NumberOrPack T>
  COURANT_KERNEL_INLINE static T shape(const T& R) {
    const T a = positive(2.5 - R), b = positive(1.5 - R), c = positive(0.5 - R);
    return a * a * a * a - 5 * (b * b * b * b) + 10 * (c * c * c * c);
  }
  COURANT_KERNEL_INLINE static Real slope(Real R) { return gradient_factor * gradient(R); }
  template <NumberOrPack T>
  COURANT_KERNEL_INLINE static T gradient(const T& R) {
    const T a = positive(2.5 - R), b = positive(1.5 - R), c = positive(0.5 - R);
    return a * a * a - 5 * (b * b * b) + 10 * (c * c * c);
  }
  template <NumberOrPack T>
  COURANT_KERNEL_INLINE static T half_curvature(const T& R) {
    const T a = positive(2.5 - R), b = positive(1.5 - R), c = positive(0.5 - R);
    return 7.5 * (b * b) - 1.5 * (a * a) - 15 * (c * c);
  }
  COURANT_KERNEL_INLINE static Real dip(Real R) {
    const Real e = positive(R - 0.5);
    return R * R * (15 - 6 * R * R) + 10 * (e * e * e * e);
  }
  COURANT_KERNEL_INLINE static Real steepness(Real R) {
    const Real e = positive(R - 0.5);
    return R * (30 - 24 * R * R) + 40 * (e * e * e);
  }
};

/// Wendland's C2 function for up to three dimensions: theta(R) = (1 - R/2)^4 (1 + 2 R). Its Fourier transform
/// is positive, so that particles do not pair. Source: Wendland 1995, Dehnen and Aly 2012; C = 3/4,
/// 7/(4 pi), 21/(16 pi).
struct WendlandC2 {
  static constexpr const char* name = "Wendland C2";
  static constexpr Real support = 2, gradient_factor = -0.625, steepest = 0.5;
  static constexpr bool kink = false;
  static constexpr KernelPieces pieces{.n = 4, .of = {{2, {5.0 / 16, -1.0 / 8}}}};
  static constexpr Real C(int dim) { return of_dimension(dim, 0.75, 7.0 / (4.0 * pi), 21.0 / (16.0 * pi)); }

  template <NumberOrPack T>
  COURANT_KERNEL_INLINE static T shape(const T& R) {
    const T b = positive(1 - 0.5 * R), b2 = b * b;
    return b2 * b2 * (1 + 2 * R);
  }
  COURANT_KERNEL_INLINE static Real slope(Real R) { return gradient_factor * gradient(R); }
  template <NumberOrPack T>
  COURANT_KERNEL_INLINE static T gradient(const T& R) {
    const T a = positive(2 - R);
    return R * (a * a * a);
  }
  template <NumberOrPack T>
  COURANT_KERNEL_INLINE static T half_curvature(const T& R) {
    const T a = positive(2 - R);
    return 0.5 * (a * a) * (a - 3 * R);
  }
  COURANT_KERNEL_INLINE static Real dip(Real R) {
    return R * R * (2.5 - R * (2.5 - R * (0.9375 - 0.125 * R)));
  }
  COURANT_KERNEL_INLINE static Real steepness(Real R) { return -slope(R); }
};

/// Wendland's C4 function for up to three dimensions: theta(R) = (1 - s)^6 (1 + 6 s + 35/3 s^2), s = R/2.
/// Source: Wendland 1995, Dehnen and Aly 2012; C = 27/32, 9/(4 pi), 495/(256 pi).
struct WendlandC4 {
  static constexpr const char* name = "Wendland C4";
  static constexpr Real support = 2, gradient_factor = -7.0 / 96.0;
  static constexpr Real steepest = 0.47114274276562274;  // 2 (2 + sqrt(39)) / 35
  static constexpr bool kink = false;
  static constexpr KernelPieces pieces{.n = 6, .of = {{2, {7.0 / 24, -11.0 / 48, 35.0 / 768}}}};
  static constexpr Real C(int dim) {
    return of_dimension(dim, 27.0 / 32.0, 9.0 / (4.0 * pi), 495.0 / (256.0 * pi));
  }

  template <NumberOrPack T>
  COURANT_KERNEL_INLINE static T shape(const T& R) {
    const T s = 0.5 * R, b = positive(1 - s), b2 = b * b;
    return b2 * b2 * b2 * (1 + s * (6 + 35.0 / 3.0 * s));
  }
  COURANT_KERNEL_INLINE static Real slope(Real R) { return gradient_factor * gradient(R); }
  template <NumberOrPack T>
  COURANT_KERNEL_INLINE static T gradient(const T& R) {
    const T a = positive(2 - R), a2 = a * a;
    return R * (2 + 5 * R) * (a2 * a2 * a);
  }
  template <NumberOrPack T>
  COURANT_KERNEL_INLINE static T half_curvature(const T& R) {
    const T a = positive(2 - R), a2 = a * a;
    return (a2 * a2) * (2 + R * (4 - 17.5 * R));
  }
  COURANT_KERNEL_INLINE static Real dip(Real R) {
    const Real s = 0.5 * R, s2 = s * s;
    return s2 * (28.0 / 3.0 - s2 * (70 - s * (448.0 / 3.0 - s * (140 - s * (64 - 35.0 / 3.0 * s)))));
  }
  COURANT_KERNEL_INLINE static Real steepness(Real R) { return -slope(R); }
};

/// Any of these kernels, known only when the program runs: one compiled loop serves all. About a fifth slower
/// than a loop of a kernel's own; the numbers agree to rounding.
class AnyKernel {
 public:
  template <class Kernel>
  static constexpr AnyKernel of() {
    AnyKernel out;
    out.support = Kernel::support, out.gradient_factor = Kernel::gradient_factor, out.kink = Kernel::kink;
    for (int dim = 1; dim <= 3; ++dim) out.C_[dim] = Kernel::C(dim);
    const int n = out.n_ = Kernel::pieces.n;
    for (const KernelPieces::Piece& piece : Kernel::pieces.of) {
      if (piece.end == 0) break;
      Piece& to = out.pieces_[out.count_++];
      to.end = piece.end;
      for (int m = 0; m < 3; ++m) {
        to.shape[m] = piece.c[m];
        to.gradient[m] = -(n + m) * piece.c[m] / Kernel::gradient_factor;
        to.half_curvature[m] = 0.5 * (n + m) * (n + m - 1) * piece.c[m] / Kernel::gradient_factor;
      }
      out.powers_ = out.powers_ && piece.c[1] == 0 && piece.c[2] == 0;
    }
    return out;
  }
  Real support = 0, gradient_factor = 0;
  bool kink = false;
  COURANT_KERNEL_INLINE Real C(int dim) const { return C_[dim]; }

  template <NumberOrPack T>
  COURANT_KERNEL_INLINE T shape(const T& R) const {
    return sum<2>(R, &Piece::shape);
  }
  template <NumberOrPack T>
  COURANT_KERNEL_INLINE T gradient(const T& R) const {
    return sum<1>(R, &Piece::gradient);
  }
  template <NumberOrPack T>
  COURANT_KERNEL_INLINE T half_curvature(const T& R) const {
    return sum<0>(R, &Piece::half_curvature);
  }
  /// `gradient` and `half_curvature` at once.
  template <NumberOrPack T>
  COURANT_KERNEL_INLINE void slopes(const T& R, T& gradient, T& half_curvature) const {
    gradient = half_curvature = 0 * R;
    for (int k = 0; k < count_; ++k) {
      const Piece& piece = pieces_[k];
      const T t = positive(piece.end - R), factor = below(t);
      half_curvature = half_curvature + times(factor, piece.half_curvature, t);
      gradient = gradient + times(factor * t, piece.gradient, t);
    }
  }

 private:
  struct Piece {
    Real end = 0;
    Real shape[3]{}, gradient[3]{}, half_curvature[3]{};
  };
  /// Sum over the pieces of t^(n - 2 + Raise) times the polynomial `of` each.
  template <int Raise, class T>
  COURANT_KERNEL_INLINE T sum(const T& R, const Real (Piece::*of)[3]) const {
    T out = 0 * R;
    for (int k = 0; k < count_; ++k) {
      const T t = positive(pieces_[k].end - R);
      T factor = below(t);
      for (int m = 0; m < Raise; ++m) factor = factor * t;
      out = out + times(factor, pieces_[k].*of, t);
    }
    return out;
  }
  template <class T>
  COURANT_KERNEL_INLINE T times(const T& factor, const Real (&c)[3], const T& t) const {
    if (powers_) return factor * c[0];
    return factor * (c[0] + t * (c[1] + c[2] * t));
  }
  /// t^(n - 2); 0 for t = 0.
  template <class T>
  COURANT_KERNEL_INLINE T below(const T& t) const {
    if (n_ == 2) return 1 - positive(1 - 1e20 * t);
    T out = t;
    for (int k = 3; k < n_; ++k) out = out * t;
    return out;
  }

  int n_ = 0, count_ = 0;
  bool powers_ = true;  ///< pieces are single powers of t
  Real C_[4]{};
  Piece pieces_[3];
};

}  // namespace courant
