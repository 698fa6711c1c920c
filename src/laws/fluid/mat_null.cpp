#include "laws/fluid/mat_null.hpp"

#include <limits>

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

const RegisterKeyword<MatNull> mat_null{
    {.names = {"MAT_NULL", "MAT_009"},
     .purpose = "fluid: density, tensile cut-off and viscosity; pressure comes "
                "from the part's EOS",
     .id_space = IdSpace::material,
     .title_option = true,
     .title = &MatNull::title,
     .cards = {
         {.fields = {
              {"MID",
               &MatNull::mid,
               "-",
               "id that *PART refers to",
               {.required = true, .check = Check::positive}},
              {"RO", &MatNull::ro, "M/L3", "reference density", {.required = true, .check = Check::positive}},
              {"PC",
               &MatNull::pc,
               "M/LT2",
               "tensile pressure cut-off; 0 allows no tension",
               {.check = Check::not_positive}},
              {"MU", &MatNull::mu, "M/LT", "dynamic viscosity", {.check = Check::not_negative}},
              {"TEROD",
               &MatNull::terod,
               "-",
               "V/V0 above which elements are deleted; 0: none",
               {.check = Check::not_negative}},
              {"CEROD",
               &MatNull::cerod,
               "-",
               "V/V0 below which elements are deleted; 0: none",
               {.check = Check::not_negative}},
              {"YM", &MatNull::ym, "M/LT2", "Young's modulus of null shells and beams", no_effect},
              {"PR", &MatNull::pr, "-", "Poisson ratio of null shells and beams", no_effect}}}}}};

}  // namespace

std::shared_ptr<StrengthLaw> MatNull::law() const {
  return std::make_shared<NewtonianFluid>(*this);
}

}  // namespace courant
