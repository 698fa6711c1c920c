#pragma once
// *DEFORMABLE_TO_RIGID_AUTOMATIC and *RIGID_DEFORMABLE: parts that become rigid, or deformable again, while a
// run goes on or when it is taken up again.
#include <string>
#include <utility>
#include <vector>

#include "keyword/deck.hpp"
#include "model/model.hpp"

namespace courant {

struct AutomaticSwitch : Entry {
  Id swset = 0, entno = 0, relsw = 0;
  int code = 0, paired = 0, nrbf = 0, ncsf = 0, rwf = 0, d2r = 0, r2d = 0;
  Real time1 = 0, time2 = 1e20, time3 = 0, dtmax = 0, offset = 0;
  std::vector<Id> pid{}, lrb{}, soft_pid{};
  std::vector<std::string> ptype{}, soft_ptype{};
  std::vector<Id> spare_pid{};  ///< of lines beyond D2R and R2D, as some programs write them: all 0
  std::vector<std::string> spare_lrb{}, spare_ptype{};
  std::string at_restart{};  ///< of *RIGID_DEFORMABLE: what its name ends in
  const char *first_field = "SWSET", *d2r_field = "D2R", *r2d_field = "R2D";  ///< for messages
  bool of_wall() const { return code == 1 || code == 3; }
  bool of_contact() const { return code == 2 || code == 4; }
};

/// A part and the one with which it is one rigid body, 0: none. Indices into Model::parts.
struct PartAndLead {
  Index part = 0;
  Id lead = 0;
};
/// What a switch makes rigid, and what deformable; parts and sets that are not there are errors.
std::vector<PartAndLead> parts_to_rigid(const Deck& deck, const Model& model, const AutomaticSwitch& card,
                                        Diagnostics& diagnostics);
std::vector<Index> parts_to_deformable(const Deck& deck, const Model& model, const AutomaticSwitch& card,
                                       Diagnostics& diagnostics);

/// What *RIGID_DEFORMABLE_R2D, _D2R and _CONTROL ask for when a run goes on from a restart file: a switch for
/// each that is there, in this order, so that one may be added at a later restart.
std::vector<AutomaticSwitch> switches_at_restart(const Deck& deck);
/// A run that starts again does nothing of that: a warning.
void warn_of_switch_at_restart(const Deck& deck, Diagnostics& diagnostics);

/// Whether some switch makes a part deformable, so that it has elements that deform.
bool is_released(const Deck& deck, const Model& model, Index part);

}  // namespace courant
