#pragma once
#include <memory>

#include "keyword/deck.hpp"
#include "laws/strength/strength.hpp"

namespace courant {

/// *MAT_NULL (*MAT_009): a fluid; pressure from its EOS, tau = 2 MU D'.
struct MatNull : Entry {
  Id mid = 0;
  Real ro = 0, pc = 0, mu = 0, terod = 0, cerod = 0, ym = 0, pr = 0;
  std::string title;
  /// For elements; particles find the viscous stress by sums over pairs. Its
  /// pressure does not fall below PC.
  std::shared_ptr<StrengthLaw> law() const;
};

}  // namespace courant
