#pragma once
#include <map>
#include <set>
#include <string>
#include <utility>

#include "elements/shell/shell_loops.hpp"
#include "keyword/deck.hpp"
#include "model/conditions/condition_cards.hpp"
#include "model/model.hpp"

namespace courant {

/// Hourglass control and bulk viscosity of the shells of a part: *HOURGLASS where it names one, else
/// *CONTROL_HOURGLASS. With one point in the plane IHQ 1 to 3 are viscous, 4 and 5 a stiffness, without
/// either viscous with 0.1; with 2 x 2 points 8, or none of these keywords, gives warped ones a stiffness
/// against drilling, other IHQ none; so do those of one point with warp, whatever IHQ. Bulk
/// viscosity acts on shells only where TYPE of *CONTROL_BULK_VISCOSITY asks for it.
class ShellHourglassReader {
 public:
  explicit ShellHourglassReader(const Deck& deck);
  /// Other kinds, and coefficients below 0, are errors.
  void read(const ModelPart& part, bool full, ShellControl& out, Diagnostics& diagnostics);

 private:
  void take_kind(const Entry& card, int ihq, const ModelPart& part, bool full, ShellControl& out,
                 Diagnostics& diagnostics);
  void check(const Entry& card, const char* field, Real value, Diagnostics& diagnostics);

  const Deck& deck_;
  const ControlHourglass* control_;
  const ControlBulkViscosity* bulk_;
  std::map<Id, const Hourglass*> cards_;
  std::set<std::pair<const Entry*, std::string>> told_;  ///< card and field
};

}  // namespace courant
