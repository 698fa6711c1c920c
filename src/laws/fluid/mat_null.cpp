#include "laws/fluid/mat_null.hpp"
#include "laws/fluid/fluid_cards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "keyword/registry.hpp"

namespace courant {

namespace {

/// A fluid in elements.
class NewtonianFluid : public StrengthLaw {
 public:
  explicit NewtonianFluid(const MatNull& m)
      : viscosity_(m.mu), cutoff_(m.pc), least_(m.cerod), most_(m.terod > 0 ? m.terod : infinite) {
    ro = m.ro;
  }
  bool deviator_only() const override { return true; }
  Real bulk_modulus() const override { return 0; }
  Real shear_modulus() const override { return 0; }
  Real viscosity() const override { return viscosity_; }
  Real pressure_cutoff() const override { return cutoff_; }
  std::pair<Real, Real> volume_range() const override { return {least_, most_}; }

  void update(const PointBlock& block) const override {
    const Real twice = 2 * viscosity_;
    for (Index i = 0; i < block.count; ++i) {
      const Real mean = (block.rate[0][i] + block.rate[1][i] + block.rate[2][i]) / 3;
      for (std::size_t k = 0; k < 6; ++k)
        block.stress[k][i] = twice * (block.rate[k][i] - (k < 3 ? mean : 0));
      block.sound_speed[i] = 0;
    }
  }

 private:
  static constexpr Real infinite = std::numeric_limits<Real>::infinity();
  Real viscosity_, cutoff_, least_, most_;
};

/// What shells and beams without a stress are made of.
class Coat : public StrengthLaw {
 public:
  explicit Coat(const MatNull& m) : bulk_(m.ym / (3 * (1 - 2 * m.pr))), shear_(m.ym / (2 * (1 + m.pr))) {
    ro = m.ro;
  }
  Real bulk_modulus() const override { return bulk_; }
  Real shear_modulus() const override { return shear_; }
  void update(const PointBlock& block) const override {
    for (Index i = 0; i < block.count; ++i) {
      for (std::size_t k = 0; k < 6; ++k) block.stress[k][i] = 0;
      block.sound_speed[i] = 0;
    }
  }

 private:
  Real bulk_, shear_;
};

const RegisterKeyword<MatNull> mat_null{mat_null_table()};

}  // namespace

std::shared_ptr<StrengthLaw> MatNull::law() const {
  return std::make_shared<NewtonianFluid>(*this);
}

std::shared_ptr<StrengthLaw> MatNull::coat() const {
  return std::make_shared<Coat>(*this);
}

const MatNull* mat_null_of(const Deck& deck, Id mid) {
  for (const MatNull& m : deck.all<MatNull>())
    if (m.mid == mid) return &m;
  return nullptr;
}

bool is_null(const Deck& deck, const Model& model, const ModelPart& part) {
  if ((!part.has_shell && !part.has_beam) || part.has_sph || part.has_solid || part.rigid) return false;
  const bool layered = !part.plies.empty() ||
                       std::any_of(model.layups.begin(), model.layups.end(), [&](const ModelLayup& layup) {
                         return model.parts[static_cast<std::size_t>(layup.part)].id == part.id;
                       });
  return !layered && mat_null_of(deck, part.mid);
}

namespace {

/// Of a fluid it is a tension; shells and beams have none.
void check_cutoff(const Deck& deck, const Model& model, const MatNull& m, Diagnostics& diagnostics) {
  if (!(m.pc > 0)) return;
  const bool unused = std::none_of(model.parts.begin(), model.parts.end(),
                                   [&](const ModelPart& part) { return part.mid == m.mid && !part.null; });
  if (unused)
    deck.warning(diagnostics, m, "PC", "has no effect on shells and beams", "leave it blank");
  else
    deck.error(diagnostics, m, "PC", fmt::format("expected a number <= 0, got '{:g}'", m.pc),
               "a tension is a negative pressure");
}

}  // namespace

void check_null_parts(const Deck& deck, const Model& model, Diagnostics& diagnostics) {
  for (const MatNull& m : deck.all<MatNull>()) check_cutoff(deck, model, m, diagnostics);
  std::set<Id> told;
  for (const ModelPart& part : model.parts) {
    const MatNull* const m =
        part.null && told.insert(part.mid).second ? mat_null_of(deck, part.mid) : nullptr;
    if (!m) continue;
    if (!(m->pr < 0.5))
      deck.error(diagnostics, *m, "PR", fmt::format("expected a number < 0.5, got '{:g}'", m->pr),
                 "the contact stiffness is YM / (3 (1 - 2 PR)); 0.3 is steel");
    for (const auto& [field, value] : {std::pair{"TEROD", m->terod}, std::pair{"CEROD", m->cerod}})
      if (value != 0)
        deck.warning(
            diagnostics, *m, field,
            fmt::format("has no effect on part {}: shells and beams of *MAT_NULL are never deleted", part.id),
            "leave it blank");
  }
}

}  // namespace courant
