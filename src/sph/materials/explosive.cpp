// *MAT_HIGH_EXPLOSIVE_BURN of particles: the pressure of the products times the share that has burnt.
#include "sph/materials/explosive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "keyword/registry.hpp"

namespace courant {

namespace {

const RegisterKeyword<MatHighExplosive> mat_high_explosive{mat_high_explosive_burn_table()};
const RegisterKeyword<InitialDetonation> initial_detonation{initial_detonation_table()};

/// F = max(F1, F2), at most 1 and never falling: F1 = 2 (t - t_l) D/(3 L) behind the time t_l at which the
/// detonation comes to the particle, which is L wide at the start; F2 = (1 - V)/(1 - V_CJ). Source: J. O.
/// Hallquist, LS-DYNA theory manual, material 8 (after E. Giroux, HEMP user's manual, UCRL-51079, 1973).
class Burn : public Material {
 public:
  /// `materials`: of each part of the model; null: it is no explosive.
  Burn(std::vector<const MatHighExplosive*> materials, Field<Real>& share, Field<Real>& lit, World& world)
      : share_(share),
        lit_(lit),
        width_(world.particles.fields.add<Real>({.name = "explosive_width", .dimension = "L"})) {
    for (const MatHighExplosive* m : materials) materials_.push_back(m ? std::optional(*m) : std::nullopt);
    const Particles& p = world.particles;
    for (Index i = 0; i < p.size(); ++i) {
      const Real V = p.m[i] / p.rho[i];
      width_[i] = world.dim == 2 ? std::sqrt(V) : std::cbrt(V);
    }
  }
  std::string name() const override { return "burn of explosives"; }
  void declare(const World& world, Accesses& a) const override {
    a.reads_before(world.particles.rho).reads(world.particles.part).reads(lit_).reads(width_).updates(share_);
  }
  void block(World& world, const Clock& clock, Index begin, Index end) override {
    const Particles& p = world.particles;
    for (Index i = begin; i < end; ++i) {
      const auto& m = materials_[static_cast<std::size_t>(p.part[i])];
      if (!m) continue;
      Real F = 0;
      if (m->beta != 1) F = 2 * (clock.t - lit_[i]) * m->d / (3 * width_[i]);
      if (m->beta != 2) F = std::max(F, (1 - m->ro / p.rho[i]) / (1 - m->cj()));
      share_[i] = std::clamp(F, share_[i], Real(1));
    }
  }

 private:
  std::vector<std::optional<MatHighExplosive>> materials_;
  Field<Real>&share_, &lit_, &width_;
};

/// When the detonation comes to x, along straight lines from the points of the part; without any at once. [T]
Real lit_at(const Deck& deck, Id part, const Vec& x, Real speed) {
  Real first = std::numeric_limits<Real>::infinity();
  for (const InitialDetonation& point : deck.all<InitialDetonation>())
    if (point.pid == 0 || point.pid == part)
      first = std::min(first, point.lt + (x - Vec(point.x, point.y, point.z)).norm() / speed);
  return std::isfinite(first) ? first : 0;
}

}  // namespace

void MatHighExplosive::check(const Deck& deck, Diagnostics& diagnostics) const {
  if (!(cj() > 0))
    deck.error(diagnostics, *this, "PCJ",
               fmt::format("expected less than RO D^2 = {:g}, got '{:g}'", ro * d * d, pcj),
               "it is about a quarter of RO D^2: check the units");
  if (beta != 0 && beta != 1 && beta != 2)
    deck.error(diagnostics, *this, "BETA", fmt::format("expected 0, 1 or 2, got '{:g}'", beta),
               "0 burns by compression and by points, 1 by compression, 2 by points");
  if (beta == 2 && (k != 0 || g != 0 || sigy != 0))
    deck.error(diagnostics, *this, "K", "an explosive that resists before it is lit is not supported",
               "leave K, G and SIGY blank");
}

void add_burn(World& world, const Deck& deck, const Model& model, Diagnostics& diagnostics) {
  std::vector<const MatHighExplosive*> of_part(model.parts.size(), nullptr);
  bool any = false;
  for (std::size_t k = 0; k < of_part.size(); ++k)
    for (const MatHighExplosive& m : deck.all<MatHighExplosive>())
      if (model.parts[k].has_sph && m.mid == model.parts[k].mid) of_part[k] = &m, any = true;
  for (const InitialDetonation& point : deck.all<InitialDetonation>()) {
    const auto part = model.part_of_id.find(point.pid);
    if (point.pid == 0 ? any
                       : part != model.part_of_id.end() && of_part[static_cast<std::size_t>(part->second)])
      continue;
    deck.error(diagnostics, point, "PID",
               point.pid == 0 ? std::string("the deck has no explosive that burns")
                              : fmt::format("part {} is no explosive of particles", point.pid),
               "name a part with *MAT_HIGH_EXPLOSIVE_BURN, or 0 for all of them");
  }
  if (!any) return;
  Particles& p = world.particles;
  Field<Real>& share = burn_fraction.add(p.fields);
  Field<Real>& lit = p.fields.add<Real>({.name = "lighting_time", .dimension = "T"});
  for (Index i = 0; i < p.size(); ++i) {
    const auto k = static_cast<std::size_t>(p.part[i]);
    share[i] = of_part[k] ? 0 : 1;
    lit[i] = of_part[k] ? lit_at(deck, model.parts[k].id, p.x.vec(i), of_part[k]->d) : 0;
  }
  world.passes.add(std::make_shared<Burn>(of_part, share, lit, world));
}

}  // namespace courant
