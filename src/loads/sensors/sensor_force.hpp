#pragma once
// *SENSOR_DEFINE_FORCE, and along which direction sensors measure.
#include <optional>
#include <string>

#include "keyword/deck.hpp"
#include "loads/load_cards.hpp"
#include "loads/sensors/sensors.hpp"
#include "model/model.hpp"

namespace courant {

/// Force of all contacts with a number on their SURFA at t^n; nothing: there is none. [ML/T2]
std::optional<Vec> force_of_contact(const World& world, Id id);
/// On a rigid wall, in the step before; nothing: there is no such wall. [ML/T2]
std::optional<Vec> force_on_wall(const World& world, Id id);

/// Whether a sensor needs forces of *BOUNDARY_SPC.
bool measures_supports(const Deck& deck);

/// Of a force and a moment one component, or the magnitude of one.
struct SensorAxis {
  Vec along = Vec::Zero();  ///< 0: the magnitude
  bool moment = false;
  Real of(const Vec& force, const Vec& moment_there = Vec::Zero()) const {
    const Vec& one = moment ? moment_there : force;
    return along.squaredNorm() > 0 ? one.dot(along) : one.norm();
  }
};

/// VID: X, Y, Z or a vector; zero, which is the magnitude, where it is blank or 0. Errors are reported.
Vec sensor_direction(const Deck& deck, const Model& model, const Entry& card, const std::string& vid,
                     Diagnostics& diagnostics);
/// VID of a force: also M; with `moments` XMOMENT, YMOMENT, ZMOMENT, MMOMENT.
SensorAxis sensor_axis(const Deck& deck, const Model& model, const SensorDefineForce& card, bool moments,
                       Diagnostics& diagnostics);

}  // namespace courant
