#include "sph/momentum.hpp"

#include "parallel/parallel.hpp"
#include "sph/fields.hpp"
#include "sph/sph.hpp"

namespace courant {

namespace {

/// What the momentum loop reads and writes besides position, velocity, mass and density.
struct MomentumArrays {
  const Real* V;                     ///< m/rho
  const Real* p;                     ///< pressure, plus bulk viscosity where there is any
  const Real* qc;                    ///< q1 c, for Monaghan viscosity
  std::array<const Real*, 6> tau{};  ///< viscous stress xx yy zz xy yz zx
  Real* f[3];
  Real* heat;  ///< dissipated power of each particle [ML2/T3]
  Real h0, q2;
};

/// Eq. 17: dv_i/dt = - sum_j m_j ((p_i + p_j)/(rho_i rho_j) + Pi_ij) grad W, eq. 7 with viscous stress added.
template <int Dim, bool UniformH, bool Monaghan, bool Stress>
void forces_of_block(const ParticleView& q, const MomentumArrays& a, const Neighbours& neighbours,
                     Index begin, Index end) {
  const Real *x = q.x[0], *y = q.x[1], *z = q.x[2], *vx = q.v[0], *vy = q.v[1], *vz = q.v[2], *rho = q.rho,
             *hh = q.h;
  const Real *V = a.V, *p = a.p, *qc = a.qc;
  const Real *txx = a.tau[0], *tyy = a.tau[1], *tzz = a.tau[2], *txy = a.tau[3], *tyz = a.tau[4],
             *tzx = a.tau[5];
  for (Index i = begin; i < end; ++i) {
    const auto list = neighbours.padded(i);
    const Index* nb = list.data();
    const Index count = static_cast<Index>(list.size() / Neighbours::lanes) * Neighbours::lanes;
    const Real h = UniformH ? a.h0 : hh[i];
    MomentumPair<Dim, UniformH, Monaghan> pair{};
    pair.h = h, pair.hinv = 1 / h, pair.norm = CubicSpline<Dim>::C / power<Dim + 1>(h),
    pair.tiny = tiny_distance2 * h * h;
    pair.p = p[i], pair.rho = rho[i], pair.qc = Monaghan ? qc[i] : 0, pair.q2 = a.q2,
    pair.inverse_rho = 1 / rho[i];
    const Real xi = x[i], yi = y[i], zi = z[i], vxi = vx[i], vyi = vy[i], vzi = vz[i];
    Real ax = 0, ay = 0, az = 0, power_i = 0;
#pragma omp simd reduction(+ : ax, ay, az, power_i)
    for (Index k = 0; k < count; ++k) {
      const Index j = nb[k];
      const Real dx = xi - x[j], dy = yi - y[j], dz = Dim == 3 ? zi - z[j] : 0;
      Real v_dot_r = 0;
      if constexpr (Monaghan)
        v_dot_r = (vxi - vx[j]) * dx + (vyi - vy[j]) * dy + (Dim == 3 ? (vzi - vz[j]) * dz : 0);
      const Real r2 = dx * dx + dy * dy + dz * dz + pair.tiny;
      const auto s = pair(r2, v_dot_r, p[j], rho[j], Monaghan ? qc[j] : 0, UniformH ? h : hh[j]);
      const Real w = V[j] * (s.pressure_i + s.pressure_j + s.viscous);
      ax -= w * dx;
      ay -= w * dy;
      if constexpr (Dim == 3) az -= w * dz;
      if constexpr (Monaghan) power_i += V[j] * s.viscous * v_dot_r;
      if constexpr (Stress) {  // tau_i with h_i, tau_j with h_j, as the pressure
        const Real rinv = 1 / std::sqrt(r2);
        const Real gi =
            V[j] * pair.inverse_rho * pair.norm * CubicSpline<Dim>::slope(r2 * rinv * pair.hinv) * rinv;
        Real gj = gi;
        if constexpr (!UniformH) {
          const Real hjinv = 1 / hh[j];
          gj = V[j] * pair.inverse_rho * CubicSpline<Dim>::C * power<Dim + 1>(hjinv) *
               CubicSpline<Dim>::slope(r2 * rinv * hjinv) * rinv;
        }
        const Real sxx = txx[i] * gi + txx[j] * gj, syy = tyy[i] * gi + tyy[j] * gj,
                   sxy = txy[i] * gi + txy[j] * gj;
        ax += sxx * dx + sxy * dy;
        ay += sxy * dx + syy * dy;
        if constexpr (Dim == 3) {
          const Real szz = tzz[i] * gi + tzz[j] * gj, syz = tyz[i] * gi + tyz[j] * gj,
                     szx = tzx[i] * gi + tzx[j] * gj;
          ax += szx * dz;
          ay += syz * dz;
          az += szx * dx + syz * dy + szz * dz;
        }
      }
    }
    const Real m = q.m[i];
    a.f[0][i] += m * ax;
    a.f[1][i] += m * ay;
    if constexpr (Dim == 3) a.f[2][i] += m * az;
    if constexpr (Monaghan) a.heat[i] += 0.5 * m * power_i;  // each partner takes half
  }
}

class Momentum : public Force {
 public:
  Momentum(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours)
      : neighbours_(std::move(neighbours)), q_(s.q) {
    Particles& p = world.particles;
    monaghan_ = std::holds_alternative<MonaghanViscosity>(s.viscosity);
    if (monaghan_) q2_ = std::get<MonaghanViscosity>(s.viscosity).q2;
    volume_ = &sph_fields::volume(p);
    heat_ = &sph_fields::dissipation(p);
    if (monaghan_) qc_ = &p.fields.add<Real>({.name = "viscous_speed", .dimension = "L/T", .restart = false});
    if (!monaghan_) total_pressure_ = &sph_fields::pressure_plus_q(p);
    const bool stress = !s.mu.empty();
    if (stress) tau_ = sph_fields::stress(p);
    loop_ = with_dimension(s.dim, [&](auto dim) {
      return with_bool(s.uniform_h, [&](auto uniform) {
        return with_bool(monaghan_, [&](auto visc) {
          return with_bool(stress, [&](auto str) -> Loop {
            return &forces_of_block<dim.value, uniform.value, visc.value, str.value>;
          });
        });
      });
    });
  }
  std::string name() const override { return "sph momentum"; }

  void add(World& world, const Clock&) override {
    Particles& p = world.particles;
    MomentumArrays a{};
    a.V = volume_->data();
    a.p = total_pressure_ ? total_pressure_->data() : p.p.data();
    if (monaghan_) {
      Real* qc = qc_->data();
      const Real* c = p.c.data();
      const Index* part = p.part.data();
      const PartViscosity* q = q_.data();
      for_each(p.moving, [=](Index i) { qc[i] = q[part[i]].q1 * c[i]; });
      a.qc = qc;
      std::fill_n(heat_->data(), p.active, 0.0);
    }
    for (int k = 0; k < 6; ++k)
      if (tau_[k]) a.tau[k] = tau_[k]->data();
    for (int k = 0; k < 3; ++k) a.f[k] = p.f.data(k);
    a.heat = heat_->data();
    a.h0 = p.active > 0 ? p.h[0] : 1;
    a.q2 = q2_;
    const ParticleView view(p);
    for_each_block(p.active, [&](Index begin, Index end) { loop_(view, a, *neighbours_, begin, end); });
  }

 private:
  using Loop = void (*)(const ParticleView&, const MomentumArrays&, const Neighbours&, Index, Index);
  std::shared_ptr<Neighbours> neighbours_;
  std::vector<PartViscosity> q_;
  bool monaghan_ = true;
  Real q2_ = 0;
  Field<Real>* volume_ = nullptr;
  Field<Real>* heat_ = nullptr;
  Field<Real>* qc_ = nullptr;
  Field<Real>* total_pressure_ = nullptr;
  std::array<Field<Real>*, 6> tau_{};
  Loop loop_ = nullptr;
};

}  // namespace

std::shared_ptr<Force> make_momentum(const SphSettings& s, World& world,
                                     std::shared_ptr<Neighbours> neighbours) {
  return std::make_shared<Momentum>(s, world, std::move(neighbours));
}

}  // namespace courant
