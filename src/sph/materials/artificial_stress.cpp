// *COURANT_ARTIFICIAL_STRESS: a stress against the clumping of particles in tension; and what cannot stand
// beside strength.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "keyword/registry.hpp"
#include "laws/strength/strength.hpp"
#include "parallel/parallel.hpp"
#include "sph/cards.hpp"
#include "sph/core/fields.hpp"
#include "sph/core/pair_volumes.hpp"
#include "sph/core/view.hpp"
#include "sph/materials/material_cards.hpp"
#include "sph/materials/strength.hpp"
#include "sph/materials/strength_loops.hpp"

namespace courant {

namespace {

using Card = CourantArtificialStress;

const RegisterKeyword<Card> artificial_stress_keyword{courant_artificial_stress_table()};

/// R = -EPS sigma for each principal stress sigma > 0, along its direction: Gray, Monaghan and Swift 2001
/// (Comput. Methods Appl. Mech. Engrg. 190), section 5, there R/rho^2; in 2D of the stresses in the plane.
class ArtificialStress : public PassOf<Phase::reductions> {
 public:
  ArtificialStress(const SphSettings& s, World& world)
      : eps_(s.artificial_stress.eps),
        laws_(s.strength),
        stress_(sph_fields::stress(world.particles)),
        R_(sph_fields::artificial_stress(world.particles)) {}
  std::string name() const override { return "artificial stress"; }
  void declare(const World& world, Accesses& a) const override {
    a.reads(world.particles.p).reads(world.particles.part).reads(stress_).writes(R_);
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    const Particles& p = world.particles;
    for (Index i = begin; i < end; ++i) {
      Matrix R = Matrix::Zero();
      if (laws_[static_cast<std::size_t>(p.part[i])]) {
        const Matrix sigma = stress_.tensor(i) - p.p[i] * Matrix::Identity();
        if (world.dim == 2)
          R.topLeftCorner<2, 2>() = against(Eigen::Matrix<Real, 2, 2>(sigma.topLeftCorner<2, 2>()));
        else
          R = against(sigma);
      }
      R_.set_tensor(i, R);
    }
  }

 private:
  template <class Tensor>
  Tensor against(const Tensor& sigma) const {
    Eigen::SelfAdjointEigenSolver<Tensor> principal;
    principal.computeDirect(sigma);
    const auto tension = principal.eigenvalues().cwiseMax(0.0).eval();
    if (tension.isZero(0)) return Tensor::Zero();
    return -eps_ * principal.eigenvectors() * tension.asDiagonal() * principal.eigenvectors().transpose();
  }
  Real eps_;
  std::vector<std::shared_ptr<const StrengthLaw>> laws_;
  Field<Real>&stress_, &R_;
};

/// Adds (W/W(dx))^n (R_i + R_j) to the stresses of pairs, 1/W(dx) the mean of both particles. What it takes
/// from the motion counts as dissipated; it gives some of it back.
class ArtificialStressForce : public Force, public EnergyTerm {
 public:
  ArtificialStressForce(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
                        std::shared_ptr<PairVolumes> volumes)
      : loop_(artificial_stress_loop(s.kernel, s.dim)),
        R_(sph_fields::artificial_stress(world.particles)),
        force_(sph_fields::artificial_stress_force(world.particles)),
        at_spacing_(sph_fields::kernel_at_spacing(world.particles)),
        neighbours_(with_whole_lists(std::move(neighbours))),
        volumes_(std::move(volumes)) {
    a_.kernel = &any_kernel(s.kernel), a_.n = s.artificial_stress.n;
    const Particles& p = world.particles;
    for (Index i = 0; i < p.size(); ++i)
      at_spacing_[i] =
          kernel_at_spacing(s.kernel, s.spacing_of_part[static_cast<std::size_t>(p.part[i])] / p.h[i]);
  }
  std::string name() const override { return "artificial stress (forces)"; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    a.reads(p.x, Reach::others).reads(p.h, Reach::others).reads(volumes_->now(), Reach::others);
    a.reads(R_, Reach::others).reads(at_spacing_, Reach::others);
    a.writes(force_).updates(p.f);
  }
  void start(World& world, const Clock&) override {
    const Particles& p = world.particles;
    for (int k = 0; k < 3; ++k) a_.x[k] = p.x.data(k), a_.f[k] = force_.data(k);
    for (int k = 0; k < 6; ++k) a_.R[k] = R_.data(k);
    a_.V = volumes_->current(), a_.h = p.h.data(), a_.at_spacing = at_spacing_.data();
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    loop_(a_, lists_of(*neighbours_, begin, end));
    for (int k = 0; k < world.dim; ++k)
      for (Index i = begin; i < end; ++i) world.particles.f.data(k)[i] += a_.f[k][i];
  }

  void record(World& world, const Clock& clock, EnergyLedger& ledger) override {
    const Particles& p = world.particles;
    const Real dt = clock.dt_mean();
    const Real work = dt * sum(p.active, [&](Index i) {
                        return force_.vec(i).dot(p.v.vec(i) + 0.5 * dt / p.m[i] * p.f.vec(i));
                      });
    ledger.dissipated -= work;
    ledger.throughput += std::abs(work);
  }
  void sample(const World&, const Clock&, EnergyLedger&) const override {}

 private:
  StrengthLoop loop_;
  Field<Real>&R_, &force_, &at_spacing_;
  std::shared_ptr<Neighbours> neighbours_;
  std::shared_ptr<PairVolumes> volumes_;
  StrengthArrays a_{};
};

void read_artificial_stress(const Deck& deck, SphSettings& s, Diagnostics& diagnostics) {
  const auto* c = deck.last<Card>();
  if (c == nullptr) return;
  if (s.strength.empty())
    return deck.warning(diagnostics, *c, "EPS", "does nothing: no particles are of a material with strength",
                        "leave the keyword out");
  s.artificial_stress = {c->eps, c->n};
  if (c->eps > 1)
    deck.error(diagnostics, *c, "EPS", fmt::format("expected at most 1, got '{:g}'", c->eps), "0.3 is usual");
}

}  // namespace

void read_strength(const Deck& deck, const Model& model, SphSettings& s, Diagnostics& diagnostics) {
  read_artificial_stress(deck, s, diagnostics);
  if (s.strength.empty()) return;
  const auto first = std::find_if(s.strength.begin(), s.strength.end(), [](const auto& law) { return law; });
  const ModelPart& part = model.parts[static_cast<std::size_t>(first - s.strength.begin())];
  const auto refuse = [&](bool asked, const char* keyword, const char* why) {
    if (!asked) return;
    deck.error(diagnostics, part.card, "MID",
               fmt::format("part {} has a material with strength, beside which {} is not supported: {}",
                           part.id, keyword, why),
               "leave one of the two out");
  };
  refuse(std::holds_alternative<RiemannFlux>(s.viscosity), "*COURANT_RIEMANN",
         "its flux is that of a liquid");
  refuse(s.density_diffusion > 0, "*COURANT_DENSITY_DIFFUSION",
         "it changes densities that stress knows nothing of");
  refuse(s.volume_tau > 0, "*COURANT_VOLUME_CONTROL", "it changes densities that stress knows nothing of");
  refuse(s.reinitialisation.every > 0, "*COURANT_DENSITY_REINITIALISATION",
         "it changes densities that stress knows nothing of");
  refuse(s.shift.strength > 0, "ISHIFT of *CONTROL_SPH", "stresses belong to material points");
  refuse(s.reverse_correction, "REVERSE of *COURANT_RENORMALISATION",
         "it is a correction of pressures alone");
  refuse(s.xsph > 0, "*COURANT_XSPH", "stresses follow the velocities, not the smoothed ones");
  refuse(s.velocity_smoothing > 0, "VEL 1 of *COURANT_XSPH", "it is a viscosity of liquids");
}

void add_artificial_stress(const SphSettings& s, World& world, std::shared_ptr<Neighbours> neighbours,
                           std::shared_ptr<PairVolumes> volumes) {
  world.passes.add(std::make_shared<ArtificialStress>(s, world));
  world.passes.add(
      std::make_shared<ArtificialStressForce>(s, world, std::move(neighbours), std::move(volumes)));
}

}  // namespace courant
