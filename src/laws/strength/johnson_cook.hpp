#pragma once
// Flow stress and failure of Johnson and Cook (1983, 1985), for cards with an equation of state and without.
#include <array>
#include <limits>

#include "laws/failure/spall.hpp"
#include "laws/strength/strength.hpp"

namespace courant {

/// sigma_y = min(min(A + B e^n + Voce, most) R, saturates) (1 - T*^M), T* = min((T - TR)/(TM - TR), 1), with
/// R of the rate of strain. Plastic work alone heats.
struct JohnsonCookData {
  enum class Rate {
    log_linear,      ///< R = 1 + C ln x, x = max(rate/EPSO, 1): Johnson & Cook 1983
    log_quadratic,   ///< R = 1 + C ln x + C2 (ln x)^2: Huh & Kang 2002
    power,           ///< R = x^C: Allen, Rule & Jones 1997
    cowper_symonds,  ///< R = 1 + (rate/C)^(1/P)
    above_1,         ///< R = (1 + rate/EPSO)^C: Camacho & Ortiz 1997
  };
  /// Q (1 - e^(-C e)) beside A + B e^n: Voce 1948.
  struct Voce {
    Real Q = 0, C = 0;  ///< [M/LT2], [-]
  };
  static constexpr Real never = std::numeric_limits<Real>::infinity();
  Real G = 0, K = 0;  ///< [M/LT2]; K = 0: the law gives the deviator only
  Real A = 0, B = 0, n = 0, C = 0;
  Real M = 0, melting = 0;  ///< exponent; TM - TR
  Real heat = 0;            ///< rise of temperature per plastic work, 1/(RO CP); 0: temperature stays
  Real warm = 0;            ///< T - TR at the start
  Real expands = 0;         ///< stress that a rise of temperature by 1 makes, held: 3 K ALPHA
  std::array<Voce, 2> voce{};
  Real rate0 = 1, second = 0;  ///< EPSO [1/T]; C2 or P
  Rate rate = Rate::log_linear;
  bool of_plastic_rate = false;  ///< VP 1: the rate is that of plastic strain, else that of all strain
  Real most = never, saturates = never;  ///< SIGMAX, SIGSAT [M/LT2]
  /// D1 to D5: strain at fracture (D1 + D2 exp(D3 sigma_m/sigma_eq)) (1 + D4 ln x) (1 + D5 T*), at least
  /// EFMIN.
  std::array<Real, 5> d{};
  Real least_fracture = 1e-6;
  /// Cockcroft & Latham 1968: D = integral of max(s1, 0) de over this work; 0: by D1 to D5 instead. [M/LT2]
  Real critical_work = 0;
  Real threshold = 0;  ///< plastic strain from which on D grows, to `critical` at the strain at fracture [-]
  Real critical = 1;   ///< D at fracture [-]
  Real coupling = 0;   ///< stress is 1 - coupling D of that without damage [-]
  Real hottest = never;         ///< rise of temperature at which a point fails
  Real most_shear = never;      ///< and largest shear stress [M/LT2]
  bool keeps_elements = false;  ///< EROD: damaged points have no deviator, but are not deleted
  Real fails_at = never;        ///< PSFAIL [-]
  Spall spall{};
  bool damages() const { return critical_work > 0 || d != std::array<Real, 5>{}; }
  /// Fails by more than damage.
  bool has_limits() const { return hottest < never || most_shear < never; }
};

std::shared_ptr<StrengthLaw> make_johnson_cook(Real density, const JohnsonCookData& data);

}  // namespace courant
