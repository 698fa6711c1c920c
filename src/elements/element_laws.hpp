#pragma once
#include <memory>
#include <vector>

#include "base/real.hpp"
#include "laws/strength/strength.hpp"
#include "state/field.hpp"

namespace courant {

/// Of solids, of shells that deform and of beams, by part of the model.
struct ElementLaws {
  std::vector<std::shared_ptr<StrengthLaw>> of_part{};  ///< null: the part has neither
  std::vector<Real> sound_speed{};                      ///< of compression waves at the start [L/T]

  /// 0: such a part has no law. [L/T]
  Real speed(Index part) const {
    const auto k = static_cast<std::size_t>(part);
    return k < sound_speed.size() ? sound_speed[k] : 0;  // springs and masses may belong to no part
  }
};

/// Fills a number that a law keeps with the size of each element, size(e) [L], where it is that. False: it is
/// another one.
template <class Size>
bool lay_size(Field<Real>& number, Index elements, const Size& size) {
  if (number.info().name.rfind(element_size, 0) != 0) return false;  // of shells and beams: for each point
  for (Index e = 0; e < elements; ++e) number[e] = size(e);
  return true;
}

}  // namespace courant
