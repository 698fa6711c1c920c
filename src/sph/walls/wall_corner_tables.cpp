#include "sph/walls/wall_corner_tables.hpp"

#include <algorithm>
#include <cmath>

#include "parallel/parallel.hpp"

namespace courant {

namespace {

/// Points and weights of Gauss on [0, 1]; of third order, right for polynomials of the fifth.
constexpr std::array<std::pair<Real, Real>, 3> gauss{
    {{0.1127016653792583, 5.0 / 18}, {0.5, 8.0 / 18}, {0.8872983346207417, 5.0 / 18}}};

/// int_from^to f ds
template <class F>
Real integral(Real from, Real to, const F& f) {
  Real sum = 0;
  for (const auto& [s, weight] : gauss) sum += weight * f(from + s * (to - from));
  return (to - from) * sum;
}

/// A function of a distance that is 0 from the support on, as its integral needs it often.
class Ray {
 public:
  template <class F>
  Ray(Real support, const F& f) : support_(support), values_(n + 2) {
    for (int i = 0; i < n; ++i) values_[static_cast<std::size_t>(i)] = f(support * i / n);
  }
  Real operator()(Real R) const {
    const Real place = R / support_ * n;
    if (!(place < n)) return 0;
    const auto i = static_cast<std::size_t>(place);
    return values_[i] + (place - Real(i)) * (values_[i + 1] - values_[i]);
  }

 private:
  static constexpr int n = 4000;
  Real support_;
  std::vector<Real> values_;
};

constexpr std::size_t index(int n, int i, int j) {
  return static_cast<std::size_t>(i * (n + 1) + j);
}
constexpr std::size_t index(int n, int i, int j, int k) {
  return static_cast<std::size_t>((i * (n + 1) + j) * (n + 1) + k);
}

/// int_R^support f r dr of a ray.
template <class F>
Ray tail_of(Real support, const F& f) {
  constexpr int steps = 2000;
  const Real step = support / steps;
  std::vector<Real> tail(steps + 2);
  for (int i = steps - 1; i >= 0; --i)
    tail[static_cast<std::size_t>(i)] = tail[static_cast<std::size_t>(i + 1)] +
                                        integral(i * step, (i + 1) * step, [&](Real r) { return f(r) * r; });
  return Ray(support, [&](Real R) {
    const Real place = R / step;
    const auto i = static_cast<std::size_t>(place);
    return tail[i] + (place - Real(i)) * (tail[i + 1] - tail[i]);
  });
}

/// int f(sqrt(R^2 + t^2)) dt over all t.
template <class F>
Real along_line(Real support, Real R, const F& f) {
  const Real most = std::sqrt(std::max(support * support - R * R, Real(0)));
  constexpr int steps = 40;
  Real sum = 0;
  for (int k = 0; k < steps; ++k)
    sum += integral(most * k / steps, most * (k + 1) / steps, [&](Real t) { return f(std::hypot(R, t)); });
  return 2 * sum;
}

/// table(i, j) = int_{y_j}^support f(x_i, s) ds
template <class F>
std::vector<Real> tail_table(int n, Real support, const F& f) {
  std::vector<Real> out(index(n, n, n) + 1);
  const Real step = support / n;
  for_each(n + 1, [&](Index i) {
    for (int j = n - 1; j >= 0; --j)
      out[index(n, i, j)] = out[index(n, i, j + 1)] +
                            integral(j * step, (j + 1) * step, [&](Real s) { return f(i * step, s); });
  });
  return out;
}
/// table(i, j, k) = int_{z_k}^support f(x_i, y_j, s) ds
template <class F>
std::vector<Real> deep_table(int n, Real support, const F& f) {
  std::vector<Real> out(index(n, n, n, n) + 1);
  const Real step = support / n;
  for_each(n + 1, [&](Index i) {
    for (int j = 0; j <= n; ++j)
      for (int k = n - 1; k >= 0; --k)
        out[index(n, i, j, k)] = out[index(n, i, j, k + 1)] + integral(k * step, (k + 1) * step, [&](Real s) {
                                   return f(i * step, j * step, s);
                                 });
  });
  return out;
}

}  // namespace

WallCornerTables::WallCornerTables(KernelChoice choice, int dim) {
  with_kernel(choice, [&](auto k) {
    using Kernel = decltype(k);
    const Real support = support_ = Kernel::support;
    const auto W = [&](Real R) { return R < support ? Kernel::C(dim) * Kernel::shape(R) : Real(0); };
    // across the corner there is one more dimension in space
    const Ray line(support, [&](Real R) { return dim == 2 ? W(R) : along_line(support, R, W); });
    const Ray line_tail = tail_of(support, line);
    plane_ = tail_table(n2, support, [&](Real d, Real s) { return line(std::hypot(d, s)); });
    edge_ = tail_table(n2, support, [&](Real a, Real s) { return at(plane_, s, a); });
    lever_.resize(plane_.size());
    for (int i = 0; i <= n2; ++i)
      for (int j = 0; j <= n2; ++j)
        lever_[index(n2, i, j)] = line_tail(support / n2 * std::hypot(Real(i), Real(j)));
    if (dim == 2) return;
    const Ray tail = tail_of(support, W);
    const auto beyond = [&](const auto& f) {
      return tail_table(n2, support, [&](Real R, Real t) { return f(std::hypot(R, t)); });
    };
    const std::vector<Real> part = beyond(W), part_tail = beyond(tail);  // of lines beyond b
    corner_ = deep_table(n3, support, [&](Real d, Real b, Real s) { return at(part, std::hypot(d, s), b); });
    corner_lever_ = std::vector<Real>(corner_.size());
    const Real step = support / n3;
    for (int i = 0; i <= n3; ++i)
      for (int j = 0; j <= n3; ++j)
        for (int l = 0; l <= n3; ++l)
          corner_lever_[index(n3, i, j, l)] = at(part_tail, step * std::hypot(Real(i), Real(j)), step * l);
    three_ = deep_table(n3, support, [&](Real a, Real b, Real s) { return at(corner_, s, a, b); });
  });
}

Real WallCornerTables::at(const std::vector<Real>& table, Real x, Real y) const {
  const Real scale = n2 / support_, u = x * scale, v = y * scale;
  if (!(u < n2 && v < n2)) return 0;
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const Real s = u - i, t = v - j;
  const Real* row = table.data() + index(n2, i, j);
  const Real* next = row + n2 + 1;
  return (1 - s) * (row[0] + t * (row[1] - row[0])) + s * (next[0] + t * (next[1] - next[0]));
}

Real WallCornerTables::at(const std::vector<Real>& table, Real x, Real y, Real z) const {
  const Real scale = n3 / support_, u = x * scale, v = y * scale, w = z * scale;
  if (!(u < n3 && v < n3 && w < n3)) return 0;
  const int i = static_cast<int>(u), j = static_cast<int>(v), k = static_cast<int>(w);
  const Real r = u - i, s = v - j, t = w - k;
  const auto along = [&](int a, int b) {
    const Real* p = table.data() + index(n3, a, b, k);
    return p[0] + t * (p[1] - p[0]);
  };
  return (1 - r) * ((1 - s) * along(i, j) + s * along(i, j + 1)) +
         r * ((1 - s) * along(i + 1, j) + s * along(i + 1, j + 1));
}

}  // namespace courant
