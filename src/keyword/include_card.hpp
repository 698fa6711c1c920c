#pragma once
#include <string>

#include "keyword/card.hpp"

namespace courant {

/// *INCLUDE_TRANSFORM; field names as in the table in include_keywords.cpp.
struct IncludeTransformCard : Entry {
  std::string filename;
  Id idnoff, ideoff, idpoff, idmoff, idsoff, idfoff, iddoff, idroff;
  std::string prefix, suffix;
  Real fctmas, fcttim, fctlen;
  std::string fcttem;
  int incout1;
  Real fctchg;
  Id tranid;

  Conversion conversion() const;
};

}  // namespace courant
