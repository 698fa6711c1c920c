#include "contact/particle_springs.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace courant {

namespace {

class ParticleSprings : public Springs {
 public:
  ParticleSprings(const ContactLaw& law, int number, Real unit)
      : number_(number),
        unit_(unit),
        soft_(law.soft == 1 ? std::sqrt(2 / law.sofscl) : 0),
        dtstif_(law.dtstif) {}
  std::string name() const override { return fmt::format("springs of contact {}", number_); }
  /// SOFT 1 takes the longest step so far, so that of now is on the safe side.
  Real between_kicks(const World&, const Clock& clock) const override {
    constexpr Real of_half_period = 0.7;
    const Real soft = soft_ * (dtstif_ > 0 ? dtstif_ : clock.dt);
    return of_half_period * pi * (soft > 0 ? std::min(unit_, soft) : unit_);
  }

 private:
  int number_;
  Real unit_;    ///< least sqrt(m/k) of the penalty [T]
  Real soft_;    ///< sqrt(m/k) of SOFT 1, in steps; 0: not it
  Real dtstif_;  ///< step that it takes; 0: that of the run [T]
};

}  // namespace

// The softer side of a touch gives its stiffness, unless PENOPT asks for that of faces, of which nothing is
// known here.
std::shared_ptr<Springs> make_particle_springs(const ContactLaw& law, int number,
                                               const std::vector<bool>& tracked, const World& world) {
  const Particles& p = world.particles;
  const auto* k =
      dynamic_cast<const Field<Real>*>(p.fields.find(fmt::format("contact_{}_stiffness", number)));
  Real unit = law.penopt == 2 ? 0 : std::numeric_limits<Real>::infinity();
  for (Index i = 0; i < p.size() && k; ++i)
    if (tracked[static_cast<std::size_t>(i)]) unit = std::min(unit, std::sqrt(p.m[i] / (*k)[i]));
  return std::make_shared<ParticleSprings>(law, number, unit);
}

}  // namespace courant
