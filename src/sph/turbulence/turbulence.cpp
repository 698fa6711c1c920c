// The passes of turbulence models.
#include "sph/turbulence/turbulence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/eigenvalues.hpp"
#include "parallel/parallel.hpp"
#include "sph/core/fields.hpp"
#include "sph/core/pair_volumes.hpp"
#include "sph/core/view.hpp"
#include "sph/sph.hpp"
#include "sph/turbulence/turbulence_loops.hpp"
#include "sph/walls/wall_distance.hpp"

namespace courant {

namespace {

/// What both passes of a model share.
struct TurbulenceFields {
  std::array<Field<Real>*, 3> gradient{};
  Field<Real>&moment, &slope, &eddy;
  Field<Real>*k = nullptr, *epsilon = nullptr, *k_flow = nullptr, *epsilon_flow = nullptr;  ///< k-epsilon

  TurbulenceFields(Particles& p, bool k_epsilon)
      : moment(own(p, "turbulence_moment", "-", 6)),
        slope(own(p, "turbulence_slope", "1/L", 3)),
        eddy(sph_fields::eddy_viscosity(p)) {
    for (int c = 0; c < 3; ++c)
      gradient[static_cast<std::size_t>(c)] =
          &own(p, std::string("turbulence_gradient_") + "xyz"[c], "1/T", 3);
    if (!k_epsilon) return;
    k = &sph_fields::turbulent_energy(p), epsilon = &sph_fields::turbulent_dissipation(p);
    k_flow = &own(p, "turbulent_energy_flow", "L2/T3", 1);
    epsilon_flow = &own(p, "turbulent_dissipation_flow", "L2/T4", 1);
  }
  static Field<Real>& own(Particles& p, const std::string& name, const char* dimension, int components) {
    Field<Real>& field = p.fields.add<Real>(
        {.name = name, .dimension = dimension, .components = components, .restart = false});
    field.fill(0);  // loops in the plane leave z alone
    return field;
  }
};

/// Sums over neighbours, from positions and velocities after the last motion.
class TurbulenceSums : public Rate {
 public:
  TurbulenceSums(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
                 std::shared_ptr<PairVolumes> volumes)
      : k_epsilon_(s.turbulence.model == TurbulenceModel::k_epsilon),
        loop_(turbulence_loop(s.kernel, s.dim, s.uniform_h, k_epsilon_)),
        neighbours_(with_whole_lists(std::move(neighbours))),
        volumes_(std::move(volumes)),
        fields_(world.particles, k_epsilon_),
        viscosity_(sph_fields::viscosity(world.particles)),
        heat_(sph_fields::viscous_dissipation(world.particles)) {
    a_.kernel = &any_kernel(s.kernel);
    a_.sigma_k = s.turbulence.sigma_k, a_.sigma_e = s.turbulence.sigma_e;
    for (std::size_t part = 0; part < s.mu.size(); ++part)  // that of the liquid, small beside eddies
      if (s.ro[part] > 0) a_.nu = std::max(a_.nu, s.mu[part] / s.ro[part]);
  }
  std::string name() const override { return "turbulence (sums)"; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    a.reads(p.x, Reach::others).reads(p.v, Reach::others).reads(p.h, Reach::others);
    a.reads(volumes_->before(), Reach::others);
    for (const auto* g : fields_.gradient) a.writes(*g);
    a.writes(fields_.moment).writes(fields_.slope);
    a.reads(viscosity_, Reach::others).updates(p.f).writes(heat_);
    if (!k_epsilon_) return;
    a.reads(*fields_.k, Reach::others).reads(*fields_.epsilon, Reach::others);
    a.reads(fields_.eddy, Reach::others).writes(*fields_.k_flow).writes(*fields_.epsilon_flow);
  }
  void start(World& world, const Clock&) override {
    Particles& p = world.particles;
    for (int c = 0; c < 3; ++c) {
      a_.x[c] = p.x.data(c), a_.v[c] = p.v.data(c), a_.f[c] = p.f.data(c);
      a_.slope[c] = fields_.slope.data(c);
      for (int d = 0; d < 3; ++d) a_.gradient[c][d] = fields_.gradient[static_cast<std::size_t>(c)]->data(d);
    }
    for (int c = 0; c < 6; ++c) a_.moment[c] = fields_.moment.data(c);
    a_.h = p.h.data(), a_.h0 = p.active > 0 ? p.h[0] : 1, a_.V = volumes_->current();
    a_.mu = viscosity_.data(), a_.heat = heat_.data();
    if (!k_epsilon_) return;
    a_.k = fields_.k->data(), a_.epsilon = fields_.epsilon->data(), a_.eddy = fields_.eddy.data();
    a_.k_flow = fields_.k_flow->data(), a_.epsilon_flow = fields_.epsilon_flow->data();
  }
  void block(World&, const Clock&, Index begin, Index end) override {
    loop_(a_, lists_of(*neighbours_, begin, end));
  }

 private:
  bool k_epsilon_;
  TurbulenceLoop loop_;
  std::shared_ptr<Neighbours> neighbours_;
  std::shared_ptr<PairVolumes> volumes_;
  TurbulenceFields fields_;
  Field<Real>&viscosity_, &heat_;
  TurbulenceArrays a_{};
};

/// nu_t of the model, from the rate of strain D: the symmetric part of the gradient sum_j V_j (v_j - v_i)
/// grad W_ij times the inverse of the moment matrix, exact for linear velocities also beside walls and
/// surfaces, where sums are one-sided (Randles and Libersky 1996). Where a particle stands so alone that the
/// matrix is near singular it is the plain sum.
///
/// Mixing length: nu_t = c_mu l^2 |S|, l = f min(kappa y, LMAX), y the distance from the nearest wall,
/// |S| = sqrt(2 D:D); f = min(1, (a/(h |sum V grad W|))^3) as De Padova et al. 2017 but without a
/// dimension. Smagorinsky: nu_t = l^2 |S|, l = min(kappa y, CS spacing). k-epsilon (Launder and Spalding
/// 1974): nu_t = c_mu k^2/epsilon,
///   Dk/Dt   = P - epsilon + diffusion,  P = min(nu_t |S|^2, sqrt(c_mu) k |S|)
///   Deps/Dt = (C1 P - C2 epsilon) epsilon/k + diffusion,
/// sinks in closed form before and behind the sources, so that neither goes below 0; nothing flows through
/// walls and surfaces. Particles with strength have no turbulence, and keep the k with which they start.
///
/// The first row beside a wall that rubs (within a spacing of it, y) takes what the law of the wall says and
/// no sum can: P = u*^3/(kappa y), epsilon = c_mu^(3/4) k^(3/2)/(kappa y).
class Turbulence : public Material {
 public:
  Turbulence(const SphSettings& s, World& world, std::shared_ptr<const Neighbours> neighbours)
      : dim_(s.dim),
        neighbours_(std::move(neighbours)),
        rules_(s.turbulence),
        spacing_(s.spacing),
        mu_(s.mu),
        friction_(s.walls.friction),
        strength_(s.strength),
        fields_(world.particles, rules_.model == TurbulenceModel::k_epsilon),
        viscosity_(sph_fields::viscosity(world.particles)) {
    Particles& p = world.particles;
    const Real reach = rules_.model == TurbulenceModel::mixing_length
                           ? std::max(rules_.lmax / rules_.kappa, last_row * s.spacing)
                       : rules_.model == TurbulenceModel::smagorinsky
                           ? std::max(rules_.cs / rules_.kappa, last_row) * s.spacing
                           : last_row * s.spacing;
    if (!rules_.walls.empty()) {
      const Real cell = s.dim == 2 ? 0.5 * spacing_ : spacing_;
      walls_.emplace(rules_.walls, reach, cell, s.walls.planes, world);
    }
    if (!s.walls.segments.empty()) wall_slope_ = &sph_fields::wall_slope(p);
    const Real c0 = maximum(p.size(), [&](Index i) { return p.c[i]; });
    least_k_ = 1e-10 * c0 * c0;
    least_epsilon_ = epsilon_of(least_k_, 10 * s.spacing);
    for (Index i = 0; i < p.size(); ++i) start_particle(p, i);
    if (fields_.k) world.counters.try_emplace(counter, 0);
  }
  std::string name() const override { return "turbulence"; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    a.reads(p.x).reads(p.v).reads(p.m).reads(p.h).reads(p.rho).reads(p.part);
    for (const auto* g : fields_.gradient) a.reads(*g);
    a.reads(fields_.moment).reads(fields_.slope).writes(viscosity_);
    if (wall_slope_) a.reads(*wall_slope_);
    if (fields_.k)
      a.updates(*fields_.k).updates(*fields_.epsilon).reads(*fields_.k_flow).reads(*fields_.epsilon_flow);
    a.writes(fields_.eddy);
    if (!walls_) return;
    a.in_start().reads(p.x, Reach::others);
    if (!walls_->any_moves()) return;
    const Segments& s = world.segments;
    a.reads(world.nodes.x).reads(world.nodes.v).reads(world.nodes.held);
    a.reads(s.node0).reads(s.node1).reads(s.node2).reads(s.node3).reads(s.part);
  }
  void start(World& world, const Clock&) override {
    if (walls_) walls_->follow(world, neighbours_->rebuilds());
    at_floor_.assign(static_cast<std::size_t>(block_count(world.particles.active)), 0);
  }
  void block(World& world, const Clock& clock, Index begin, Index end) override {
    Particles& p = world.particles;
    for (Index i = begin; i < end; ++i) {
      if (!is_liquid(p, i)) {
        fields_.eddy[i] = 0, viscosity_[i] = mu_[p.part[i]];
        continue;
      }
      const Flow flow = flow_of(p, i);
      const Real nu_t =
          rules_.model == TurbulenceModel::k_epsilon ? advance(i, flow, clock.dt_old) : algebraic(p, i, flow);
      const Real nu = mu_[p.part[i]] / p.rho[i];
      fields_.eddy[i] = nu_t;
      viscosity_[i] = p.rho[i] * (nu + nu_t);
    }
  }
  void finish(World& world, const Clock&) override {
    if (!fields_.k) return;
    std::int64_t sum = 0;
    for (const Index n : at_floor_) sum += n;
    auto& most = world.counters[counter];
    most = std::max(most, sum);
  }

 private:
  /// What the model asks of the flow around a particle.
  struct Flow {
    Real S = 0;                                      ///< |S| [1/T]
    Real y = std::numeric_limits<Real>::infinity();  ///< distance from the nearest wall [L]
    Real row = 0;     ///< 1 in the first row beside a wall that rubs, else 0 [-]
    Real u_star = 0;  ///< [L/T]
    Real open = 0;    ///< 1 at a free surface, else 0 [-]; where LSURF asks for it
  };

  bool is_liquid(const Particles& p, Index i) const { return strength_.empty() || !strength_[p.part[i]]; }
  void start_particle(Particles& p, Index i) {
    const Real of_model = fields_.k ? start_k(i, p.part[i]) : 0, nu_t = is_liquid(p, i) ? of_model : 0;
    fields_.eddy[i] = nu_t;
    viscosity_[i] = mu_[p.part[i]] + p.rho[i] * nu_t;
  }
  Real start_k(Index i, Index part) {
    Field<Real>&k = *fields_.k, &epsilon = *fields_.epsilon;
    k[i] = std::max(rules_.k[part], least_k_), epsilon[i] = std::max(rules_.epsilon[part], least_epsilon_);
    return rules_.cmu * k[i] * k[i] / epsilon[i];
  }

  Matrix corrected_gradient(Index i) const {
    Matrix L = Matrix::Zero();
    for (int c = 0; c < 3; ++c) L.row(c) = fields_.gradient[static_cast<std::size_t>(c)]->vec(i).transpose();
    Matrix moment = fields_.moment.tensor(i);
    if (dim_ == 2) {
      const Eigen::Matrix2d flat = moment.topLeftCorner<2, 2>();
      if (!(least_eigenvalue(flat) > least_moment)) return L;
      L.topLeftCorner<2, 2>() = (L.topLeftCorner<2, 2>() * flat.inverse()).eval();
      return L;
    }
    return least_eigenvalue(moment) > least_moment ? Matrix(L * moment.inverse()) : L;
  }

  Flow flow_of(const Particles& p, Index i) const {
    Flow flow;
    const Matrix L = corrected_gradient(i);
    flow.S = std::sqrt(0.5) * (L + L.transpose()).norm();
    if (rules_.surface_length > 0)
      flow.open = std::clamp((openness(p, i) - inside) / (at_surface - inside), Real(0), Real(1));
    if (!walls_) return flow;
    const NearestWall wall = walls_->nearest(p.x.vec(i));
    if (wall.segment < 0) return flow;
    flow.y = std::max(wall.distance, least_distance * spacing_);
    const WallFriction& friction = friction_[static_cast<std::size_t>(wall.segment)];
    if (!friction.rubs() || flow.y > last_row * spacing_) return flow;
    const Vec u = p.v.vec(i) - wall.velocity, along = u - u.dot(wall.normal) * wall.normal;
    flow.u_star = friction_velocity(friction, along.norm(), flow.y, mu_[p.part[i]] / p.rho[i]);
    const Real s = std::clamp((last_row - flow.y / spacing_) / (last_row - whole_row), Real(0), Real(1));
    flow.row = s * s * (3 - 2 * s);
    return flow;
  }

  /// h |sum V grad W|: 0 within water and beside supporting walls, 0.7 in the row at a plane surface.
  Real openness(const Particles& p, Index i) const {
    Vec slope = fields_.slope.vec(i);
    if (wall_slope_) slope += wall_slope_->vec(i);
    return p.h[i] * slope.norm();
  }

  Real algebraic(const Particles& p, Index i, const Flow& flow) const {
    if (rules_.model == TurbulenceModel::smagorinsky) {
      const Real width = std::pow(p.m[i] / p.rho[i], Real(1) / dim_);
      const Real l = std::min(rules_.kappa * flow.y, rules_.cs * width);
      return l * l * flow.S;
    }
    Real l = std::min(rules_.kappa * flow.y, rules_.lmax);
    if (rules_.surface > 0) l *= power<3>(std::min(Real(1), rules_.surface / openness(p, i)));
    return rules_.cmu * l * l * flow.S;
  }

  /// Dk/Dt = -epsilon, Deps/Dt = -C2 epsilon^2/k over a time, in closed form.
  void decay(Real& k, Real& epsilon, Real time) const {
    const Real past = 1 + (rules_.c2 - 1) * epsilon / k * time;
    const Real left = std::pow(past, -1 / (rules_.c2 - 1));
    k *= left, epsilon *= left / past;
  }

  /// Where the largest eddies have this length.
  Real epsilon_of(Real k, Real length) const {
    return std::pow(rules_.cmu, 0.75) * std::pow(k, 1.5) / length;
  }

  Real nu_t_of(Real k, Real epsilon, Real S) const {
    const Real nu_t = rules_.cmu * k * k / epsilon;
    return rules_.limits_stress && S > 0 ? std::min(nu_t, std::sqrt(rules_.cmu) * k / S) : nu_t;
  }

  /// k and epsilon over the step that led here. Returns nu_t.
  Real advance(Index i, const Flow& flow, Real dt) {
    Real &k = (*fields_.k)[i], &epsilon = (*fields_.epsilon)[i];
    const Real nu_t = rules_.cmu * k * k / epsilon, per_k = epsilon / k;
    Real P = std::min(nu_t * flow.S * flow.S, std::sqrt(rules_.cmu) * k * flow.S);
    if (flow.row > 0) P += flow.row * (power<3>(flow.u_star) / (rules_.kappa * flow.y) - P);
    Real new_k = k, new_epsilon = epsilon;
    decay(new_k, new_epsilon, 0.5 * dt);
    new_k += dt * (P + (*fields_.k_flow)[i]);
    new_epsilon += dt * (rules_.c1 * per_k * P + (*fields_.epsilon_flow)[i]);
    new_epsilon = std::max(new_epsilon, least_epsilon_);
    if (new_k > least_k_) decay(new_k, new_epsilon, 0.5 * dt);
    if (!(new_k > least_k_)) new_k = least_k_, ++at_floor_[static_cast<std::size_t>(i / block_size)];
    if (flow.row > 0) new_epsilon += flow.row * (epsilon_of(new_k, rules_.kappa * flow.y) - new_epsilon);
    if (rules_.lmax > 0) new_epsilon = std::max(new_epsilon, epsilon_of(new_k, rules_.lmax));
    if (flow.open > 0)
      new_epsilon = std::max(new_epsilon, flow.open * epsilon_of(new_k, rules_.surface_length));
    k = new_k, epsilon = std::max(new_epsilon, least_epsilon_);
    return nu_t_of(k, epsilon, flow.S);
  }

  static constexpr const char* counter = "turbulent_energy_at_its_least";
  static constexpr Real least_moment = 0.15;              ///< 1/2 at a plane surface, 1/4 in a corner
  static constexpr Real inside = 0.1, at_surface = 0.3;   ///< of h |sum V grad W|
  static constexpr Real whole_row = 0.9, last_row = 1.1;  ///< of the first row, in spacings from the wall
  int dim_;
  std::shared_ptr<const Neighbours> neighbours_;
  TurbulenceRules rules_;
  Real spacing_;
  std::vector<Real> mu_;                                      ///< per part
  std::vector<WallFriction> friction_;                        ///< by segment
  std::vector<std::shared_ptr<const StrengthLaw>> strength_;  ///< per part
  TurbulenceFields fields_;
  Field<Real>& viscosity_;
  const Field<Real>* wall_slope_ = nullptr;
  std::optional<WallDistance> walls_;
  Real least_k_ = 0, least_epsilon_ = 0;
  std::vector<Index> at_floor_;  ///< in each block
};

}  // namespace

void add_turbulence(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
                    std::shared_ptr<PairVolumes> volumes) {
  world.passes.add(std::make_shared<TurbulenceSums>(s, world, neighbours, std::move(volumes)));
  world.passes.add(std::make_shared<Turbulence>(s, world, std::move(neighbours)));
}

}  // namespace courant
