#pragma once
#include <array>
#include <string>

#include "base/real.hpp"
#include "contact/friction.hpp"
#include "loads/sensors/sensors.hpp"

namespace courant {

/// One interface as the deck gives it; names as on the card and in *CONTROL_CONTACT.
struct NodeContactLaw : FrictionLaw {
  Id id = 0;
  std::string title;
  Real slsfac = 0.1;
  std::array<Real, 2> sfs{1, 1};  ///< of the nodes of each pass (SFSA, SFSB) [-]
  Real vdc = 0;                   ///< damping, percent of critical
  Real birth = 0, death = 1e20;   ///< [T]
  SensorGate gate{};
  bool sleeps(Real t) const { return t < birth || t > death || !gate.open(); }
  int soft = 0, penopt = 1;
  Real sofscl = 0.1, dtstif = 0;  ///< SOFT 1: scale [-] and step if given [T]
  Real tssfac = 0.9;              ///< what elements leave of their own step
  int enmass = 0;                 ///< whose nodes keep their contact once their elements are deleted
  bool with_edges = false;        ///< edges also touch: each uses half of the step that elements leave
  bool single = false;            ///< one surface with itself: the forces on it are in balance
};

}  // namespace courant
