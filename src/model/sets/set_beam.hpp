#pragma once
#include <string>
#include <vector>

#include "keyword/card.hpp"

namespace courant {

/// *SET_BEAM: ids of beams.
struct SetBeam : Entry {
  std::string title;
  Id sid = 0;
  std::vector<Id> eids;
};

}  // namespace courant
