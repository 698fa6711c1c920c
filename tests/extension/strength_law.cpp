// *MAT_EXAMPLE_MAXWELL: elastic in volume; in shear a spring and a dashpot in line, so that a stress that is
// held fades away.
#include <cmath>

#include "extension/compiled_against.hpp"
#include "laws/strength/strength.hpp"

namespace {

using namespace courant;

/// ds/dt = 2 G dev(D) - s/TAU, turned with the body; solved exactly for a D that is constant over the step.
class Maxwell : public StrengthLaw {
 public:
  Maxwell(Real density, Real E, Real nu, Real tau)
      : bulk_(E / (3 * (1 - 2 * nu))), shear_(E / (2 * (1 + nu))), tau_(tau) {
    ro = density;
  }
  Real bulk_modulus() const override { return bulk_; }
  Real shear_modulus() const override { return shear_; }

  void update(const PointBlock& block) const override {
    const Real kept = std::exp(-block.dt / tau_);
    const Real made = 2 * shear_ * tau_ * -std::expm1(-block.dt / tau_);
    for (Index i = 0; i < block.count; ++i) {
      const Real volume_rate = block.rate[0][i] + block.rate[1][i] + block.rate[2][i];
      const Real mean = (block.stress[0][i] + block.stress[1][i] + block.stress[2][i]) / 3;
      const Real new_mean = mean + bulk_ * volume_rate * block.dt;
      for (int k = 0; k < 3; ++k)
        block.stress[k][i] =
            new_mean + kept * (block.stress[k][i] - mean) + made * (block.rate[k][i] - volume_rate / 3);
      for (int k = 3; k < 6; ++k) block.stress[k][i] = kept * block.stress[k][i] + made * block.rate[k][i];
    }
    const Real c0 = sound_speed();
    for (Index i = 0; i < block.count; ++i)
      block.sound_speed[i] = block.compression ? c0 / std::sqrt(1 + block.compression[i]) : c0;
  }

 private:
  Real bulk_, shear_, tau_;
};

struct Card : Entry {
  std::string title;
  Id mid = 0;
  Real ro = 0, E = 0, pr = 0, tau = 0;
  std::shared_ptr<StrengthLaw> law() const { return std::make_shared<Maxwell>(ro, E, pr, tau); }
  void check(const Deck& deck, Diagnostics& diagnostics) const {
    if (!(pr < 0.5)) deck.error(diagnostics, *this, "PR", "expected a number < 0.5");
  }
};

const FieldRules required_positive{.required = true, .check = Check::positive};

const RegisterStrength<Card> registered{
    "ds/dt = 2 G dev(D) - s/TAU, dp/dt = -K tr(D)",
    "Maxwell 1867",
    {},
    {.names = {"MAT_EXAMPLE_MAXWELL"},
     .purpose = "elastic body whose shear stress relaxes",
     .id_space = IdSpace::material,
     .title_option = true,
     .title = &Card::title,
     .cards = {{.fields = {{"MID", &Card::mid, "-", "id that *PART refers to", required_positive},
                           {"RO", &Card::ro, "M/L3", "density", required_positive},
                           {"E", &Card::E, "M/LT2", "Young's modulus of fast strains", required_positive},
                           {"PR", &Card::pr, "-", "Poisson ratio, below 0.5", {.check = Check::not_negative}},
                           {"TAU", &Card::tau, "T", "relaxation time", required_positive}}}}}};

}  // namespace
