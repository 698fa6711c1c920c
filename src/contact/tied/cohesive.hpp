#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "contact/cards.hpp"
#include "contact/tied/ties.hpp"

namespace courant {

/// A joint that softens by what opens and shears it together, until it has taken its energy: linear up to a
/// peak, a straight fall behind it, and back to zero on a straight line. Source: P. P. Camanho, C. G. Davila,
/// M. F. de Moura, Journal of Composite Materials 37 (2003) 1415-1438.
struct CohesiveLaw {
  Real normal = 0, shear = 0;                      ///< peaks of the stress [M/LT2]; 0: another law holds
  Real normal_energy = 0, shear_energy = 0;        ///< by area, of opening and of shear alone [M/T2]
  Real normal_stiffness = 0, shear_stiffness = 0;  ///< stress over displacement [M/L2T2]
  /// > 0: (G_I/normal_energy)^x + (G_II/shear_energy)^x = 1 at the end; < 0: of Benzeggagh and Kenane, -x.
  /// [-]
  Real exponent = 1;

  bool holds() const { return normal > 0; }
  /// Damage from 0 to 1 of a displacement that opens by `open` (pressed together, it opens by 0) and shears
  /// by `across`, > 0. [L]
  Real damage(Real open, Real across) const {
    const Real one = std::max(open, Real(0)), size = std::hypot(one, across);
    if (!(size > 0)) return 0;
    const Real first = onset(one, across), last = end(one, across, first);
    if (size <= first) return 0;
    return size >= last ? 1 : last * (size - first) / (size * (last - first));
  }

  /// Where damage begins in this direction. [L]
  Real onset(Real open, Real across) const {
    const Real size = std::hypot(open, across);
    const Real by_normal = open / size * normal_stiffness / normal,
               by_shear = across / size * shear_stiffness / shear;
    return 1 / std::hypot(by_normal, by_shear);
  }
  /// Where nothing holds any more. [L]
  Real end(Real open, Real across, Real first) const {
    const Real c2 = open * open / (open * open + across * across), s2 = 1 - c2;
    const Real stiffness =
        c2 * normal_stiffness + s2 * shear_stiffness;  // first * stiffness/2 * end: the energy
    if (exponent > 0) {
      const Real by_energy = std::pow(c2 * normal_stiffness / normal_energy, exponent) +
                             std::pow(s2 * shear_stiffness / shear_energy, exponent);
      return 2 / first * std::pow(by_energy, -1 / exponent);
    }
    const Real energy = normal_energy + (shear_energy - normal_energy) *
                                            std::pow(s2 * shear_stiffness / stiffness, -exponent);
    return 2 * energy / (first * stiffness);
  }
};

/// OPTION 9, and 11, which is 9 with faces apart: that makes no difference here.
inline bool is_cohesive(const ContactCard& card) {
  return kind_of(card).tiebreak == Tiebreak::by_option && (card.option == 9 || card.option == 11);
}
/// Warns of energies and stiffnesses that another OPTION does not use.
void warn_of_cohesive_fields(const ContactCard& card, const Deck& deck, Diagnostics& diagnostics);
/// The law of such a card; ties get its stiffness, for the step. False with errors: energies
/// that are missing or less than the joint takes up to its peak, nodes without an area.
bool read_cohesive(const ContactCard& card, Real slsfac, std::vector<Tie>& ties, CohesiveLaw& law,
                   const std::function<void(const char* field, std::string what, const char* hint)>& error);

}  // namespace courant
