#include <cmath>

#include "parallel/parallel.hpp"
#include "sph/fields.hpp"
#include "sph/kernel.hpp"
#include "sph/sph.hpp"
#include "sph/view.hpp"

namespace courant {

namespace {

/// Symmetric velocity gradient D, components xx yy zz xy yz zx; null where nobody needs it.
struct StrainRate {
  std::array<Real*, 6> d{};
};

/// Eq. 6: drho_i/dt = rho_i sum_j m_j/rho_j v_ij . grad_i W_ij, and with `Gradient` also
/// D_ab = -1/2 sum_j m_j/rho_j (v_ij,a grad_b W + v_ij,b grad_a W). Both with h_i (FORM 0).
template <int Dim, bool UniformH, bool Gradient>
void rates_of_block(const ParticleView& p, const Real* V, const Neighbours& neighbours, Index begin,
                    Index end, Real h0, Real* drhodt, const StrainRate& strain) {
  using Kernel = CubicSpline<Dim>;
  const Real *x = p.x[0], *y = p.x[1], *z = p.x[2], *vx = p.v[0], *vy = p.v[1], *vz = p.v[2];
  for (Index i = begin; i < end; ++i) {
    const auto list = neighbours.padded(i);
    const Index* nb = list.data();
    const Index count = static_cast<Index>(list.size() / Neighbours::lanes) * Neighbours::lanes;
    const Real h = UniformH ? h0 : p.h[i];
    const Real hinv = 1 / h, tiny = tiny_distance2 * h * h;
    const Real xi = x[i], yi = y[i], zi = z[i], vxi = vx[i], vyi = vy[i], vzi = vz[i];
    Real div = 0, xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;
#pragma omp simd reduction(+ : div, xx, yy, zz, xy, yz, zx)
    for (Index k = 0; k < count; ++k) {
      const Index j = nb[k];
      const Real dx = xi - x[j], dy = yi - y[j], dz = Dim == 3 ? zi - z[j] : 0;
      const Real ux = vxi - vx[j], uy = vyi - vy[j], uz = Dim == 3 ? vzi - vz[j] : 0;
      const Real r2 = dx * dx + dy * dy + dz * dz + tiny;
      const Real rinv = 1 / std::sqrt(r2);
      const Real g = V[j] * Kernel::slope(r2 * rinv * hinv) * rinv;
      div += g * (ux * dx + uy * dy + uz * dz);
      if constexpr (Gradient) {
        xx -= g * ux * dx;
        yy -= g * uy * dy;
        xy -= g * (ux * dy + uy * dx);
        if constexpr (Dim == 3) {
          zz -= g * uz * dz;
          yz -= g * (uy * dz + uz * dy);
          zx -= g * (uz * dx + ux * dz);
        }
      }
    }
    const Real norm = Kernel::C / power<Dim + 1>(h);
    drhodt[i] = p.rho[i] * norm * div;
    if constexpr (Gradient) {
      const Real d[6] = {xx, yy, zz, 0.5 * xy, 0.5 * yz, 0.5 * zx};
      for (int k = 0; k < 6; ++k) strain.d[k][i] = norm * d[k];
    }
  }
}

class Continuity : public Rate {
 public:
  Continuity(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours)
      : neighbours_(std::move(neighbours)), volume_(sph_fields::volume(world.particles)) {
    const bool gradient = !s.mu.empty();
    if (gradient) strain_fields_ = sph_fields::strain_rate(world.particles);
    loop_ = with_dimension(s.dim, [&](auto dim) {
      return with_bool(s.uniform_h, [&](auto uniform) {
        return with_bool(gradient, [&](auto grad) -> Loop {
          return &rates_of_block<dim.value, uniform.value, grad.value>;
        });
      });
    });
  }
  std::string name() const override { return "sph continuity"; }

  void evaluate(World& world, const Clock&) override {
    Particles& p = world.particles;
    Real* V = volume_.data();
    const Real *m = p.m.data(), *rho = p.rho.data();
    for_each(p.moving, [=](Index i) { V[i] = m[i] / rho[i]; });
    const ParticleView view(p);
    StrainRate strain;
    for (int k = 0; k < 6; ++k)
      if (strain_fields_[k]) strain.d[k] = strain_fields_[k]->data();
    const Real h0 = p.active > 0 ? p.h[0] : 1;
    Real* drhodt = p.drhodt.data();
    for_each_block(p.active, [&](Index begin, Index end) {
      loop_(view, V, *neighbours_, begin, end, h0, drhodt, strain);
    });
  }

 private:
  using Loop = void (*)(const ParticleView&, const Real*, const Neighbours&, Index, Index, Real, Real*,
                        const StrainRate&);
  std::shared_ptr<Neighbours> neighbours_;
  Field<Real>& volume_;
  std::array<Field<Real>*, 6> strain_fields_{};
  Loop loop_ = nullptr;
};

}  // namespace

std::shared_ptr<Rate> make_continuity(const SphSettings& s, World& world,
                                      std::shared_ptr<Neighbours> neighbours) {
  return std::make_shared<Continuity>(s, world, std::move(neighbours));
}

}  // namespace courant
