#pragma once
#include <string>
#include <vector>

#include "keyword/card.hpp"

namespace courant {

/// *SECTION_SHELL; thickness at the corners [L]
struct SectionShell : Entry {
  std::string title;
  Id secid = 0;
  int elform = 2, nip = 2, irid = 0, icomp = 0, setyp = 1, edgset = 0;
  Real shrf = 1, propt = 1;
  std::vector<std::string> user{};  ///< cards of what is not supported
  bool user_defined() const { return elform >= 101 && elform <= 105; }
  Real t1 = 0, t2 = 0, t3 = 0, t4 = 0, nloc = 0, marea = 0, idof = 0;
};

}  // namespace courant
