#pragma once
// *LOAD_BLAST_ENHANCED: charges, and the faces that their waves push.
#include <optional>
#include <vector>

#include "keyword/deck.hpp"
#include "loads/blast/blast_wave.hpp"
#include "loads/load_cards.hpp"
#include "model/model.hpp"

namespace courant {

/// A charge, in the units of the deck; and what one of these is in those of the fits.
struct BlastSource {
  Id id = 0;
  BlastKind kind = BlastKind::air;
  Real mass = 0;            ///< of TNT [M]
  Vec place = Vec::Zero();  ///< [L]
  Real start = 0, death = 1e20;
  Real pounds = 1, feet = 1, milliseconds = 1, psi = 1;
  bool positive_only = false;
  Entry card{};
  bool refused = false;  ///< its card is wrong

  /// At a face as far away as `distance` [L]; nothing where the fits do not hold.
  std::optional<BlastWave> wave_at(Real distance) const;
  Real scaled(Real distance) const;  ///< distance over the cube root of the mass [ft/lb^(1/3)]
  /// On a face, the mean from t - half to t + half, so that steps add up to the impulse however long they
  /// are; `cosine`: between its normal and the direction to the charge. [M/LT2]
  Real pressure(const BlastWave& wave, Real t, Real half, Real cosine) const;
};

/// Refuses by name: moving charges, reflections from the ground, units without factors, nodes that are not
/// there.
std::vector<BlastSource> blast_sources(const Deck& deck, const Model& model, Diagnostics& diagnostics);

}  // namespace courant
