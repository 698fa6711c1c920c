// *COURANT_EDDY_VISCOSITY: the mixing length model of turbulence.
#include <cmath>

#include "keyword/registry.hpp"
#include "sph/cards.hpp"
#include "sph/core/fields.hpp"
#include "sph/sph.hpp"

namespace courant {

namespace {

const RegisterKeyword<CourantEddyViscosity> eddy_viscosity_keyword{courant_eddy_viscosity_table()};

/// mu_i = MU + rho_i CMU l_i^2 |S|_i, l_i = min(KAPPA y_i, LMAX), |S| = sqrt(2 D:D), D the symmetric velocity
/// gradient, y_i the distance from the wall (De Padova et al. 2017, with rho in it and without the factor
/// that the paper's length has at surfaces).
class EddyViscosity : public Material {
 public:
  EddyViscosity(const SphSettings& s, World& world)
      : rules_(s.mixing_length),
        mu_(s.mu),
        strength_(s.strength),
        rate_(sph_fields::strain_rate(world.particles)),
        viscosity_(sph_fields::viscosity(world.particles)) {
    for (Index i = 0; i < world.particles.size(); ++i) viscosity_[i] = mu_[world.particles.part[i]];
  }
  std::string name() const override { return "eddy viscosity"; }
  void declare(const World& world, Accesses& a) const override {
    const Particles& p = world.particles;
    a.reads(rate_).reads(p.x).reads(p.part).reads(p.rho).writes(viscosity_);
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    const Particles& p = world.particles;
    for (Index i = begin; i < end; ++i) {
      Real square = 0;  // 2 D:D
      for (int k = 0; k < 6; ++k) square += (k < 3 ? 2 : 4) * rate_.data(k)[i] * rate_.data(k)[i];
      const bool liquid = strength_.empty() || !strength_[p.part[i]];
      const Real l = liquid ? rules_.length(p.x.vec(i)) : 0;
      viscosity_[i] = mu_[p.part[i]] + p.rho[i] * rules_.cmu * l * l * std::sqrt(square);
    }
  }

 private:
  MixingLength rules_;
  std::vector<Real> mu_;
  std::vector<std::shared_ptr<const StrengthLaw>> strength_;  ///< per part
  Field<Real>&rate_, &viscosity_;
};

}  // namespace

/// LMAX has no direction to be stretched in.
std::string keep_mixing_length(CourantEddyViscosity&, const Affine& motion) {
  const Matrix turn = motion.linear();
  return (turn.transpose() * turn).isIdentity(1e-9)
             ? ""
             : "a mixing length can be turned and shifted, but not stretched";
}

void read_eddy_viscosity(const Deck& deck, const Model& model, const Particles& p, SphSettings& s,
                         Diagnostics& diagnostics) {
  const auto* c = deck.last<CourantEddyViscosity>();
  if (c == nullptr || c->lmax == 0) return;
  const Vec tail(c->vtx, c->vty, c->vtz), n = Vec(c->vhx, c->vhy, c->vhz) - tail;
  if (s.dim == 2 && std::abs(n[2]) > 1e-6 * n.norm())
    return deck.error(
        diagnostics, *c, "VHZ",
        "in 2D the wall must be normal to the plane of the particles: the vector points out of it",
        "give tail and head the same z");
  s.mixing_length = {.most = c->lmax, .cmu = c->cmu, .kappa = c->kappa, .wall = tail};
  if (n.norm() > 0) {
    s.mixing_length.normal = n.normalized();
    Index before = 0;
    while (before < p.size() && !(s.mixing_length.length(p.x.vec(before)) > 0)) ++before;
    if (before == p.size() && before > 0)
      deck.error(diagnostics, *c, "VHX", "all particles are behind the wall, where the mixing length is 0",
                 "the vector points from the wall into the water");
  }
  if (s.mu.empty()) s.mu.assign(model.parts.size(), 0);
}

std::shared_ptr<Material> make_eddy_viscosity(const SphSettings& s, World& world) {
  return std::make_shared<EddyViscosity>(s, world);
}

}  // namespace courant
