#pragma once
#include <string>

#include "extension/history_interval.hpp"
#include "keyword/card.hpp"

namespace courant {

/// What *DATABASE_CROSS_SECTION_PLANE and _SET share.
struct CrossSectionCard : Entry {
  Id csid = 0;  ///< 0: by its place among all sections
  std::string heading;
  Id system = 0;  ///< ID
  int itype = 0;
};

struct CrossSectionPlaneCard : CrossSectionCard {
  Id psid = 0;
  Real xct = 0, yct = 0, zct = 0, xch = 0, ych = 0, zch = 0, radius = 0;
  Real xhev = 0, yhev = 0, zhev = 0, lenl = 0, lenm = 0;
};

struct CrossSectionSetCard : CrossSectionCard {
  Id nsid = 0, hsid = 0, bsid = 0, ssid = 0;
  int tsid = 0, dsid = 0;  ///< sets that are not there
};

struct DatabaseSecforc : HistoryInterval {};

}  // namespace courant
