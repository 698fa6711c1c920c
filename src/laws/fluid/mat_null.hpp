#pragma once
#include "keyword/deck.hpp"

namespace courant {

/// *MAT_NULL (*MAT_009): a fluid; pressure from its EOS, tau = 2 MU D'.
struct MatNull : Entry {
  Id mid = 0;
  Real ro = 0, pc = 0, mu = 0, terod = 0, cerod = 0, ym = 0, pr = 0;
  std::string title;
};

}  // namespace courant
