#pragma once
// Cables: discrete beams (ELFORM 6) with *MAT_CABLE_DISCRETE_BEAM, which axial force and do nothing else.
#include <limits>
#include <memory>
#include <vector>

#include "base/straight_pieces.hpp"
#include "elements/erosion.hpp"
#include "model/model.hpp"
#include "state/world.hpp"

namespace courant {

/// F = max(F0 + N, 0) with N = K dL, K = E CA/(L0 - OFFSET), or CA sigma(dL/(L0 - OFFSET)) by a curve, and dL
/// what the cable is longer than without load, L0 - OFFSET. While the preload is held (TSTART, TRAMP,
/// TMAXF0), F is F0 or its ramp, and the length without load follows.
struct CableLaw {
  static constexpr Real never = std::numeric_limits<Real>::infinity();
  Real E = 0;                                    ///< Young's modulus [M/LT2]; 0: by `stiffness` or `curve`
  Real stiffness = 0;                            ///< -E of the card, of each cable [M/T2]
  StraightPieces curve{};                        ///< stress over strain; empty: none
  Real F0 = 0;                                   ///< [ML/T2]
  Real ramp_from = 0, ramp = 0, held_until = 0;  ///< [T]
  Real most_strain = never, most_force = never;  ///< the cable breaks there
  Real ro = 0;

  bool holds(Real t) const { return t < held_until; }
  Real preload(Real t) const;
  /// N of a cable of that area, `rest` long without load, that is longer by `dL`. [ML/T2]
  Real answer(Real area, Real rest, Real dL) const;
  /// The largest dN/dL there is. [M/T2]
  Real steepest(Real area, Real rest) const;
};

/// The cables of a part; vectors by element.
struct CablePart {
  Index part = 0;
  CableLaw law;
  std::vector<const ModelBeam*> beams{};
  std::vector<Real> area{}, rest{}, mass{};  ///< [L2], length without load [L], [M]
  /// Of a rod without Poisson's ratio that is as stiff as the first cable, which has an area. [M/LT2]
  Real bulk_modulus() const { return law.steepest(area[0], rest[0]) * rest[0] / area[0] / 3; }
};

/// Parts of *SECTION_BEAM with ELFORM 6. Refuses other materials, and cables without mass, area or length.
std::vector<CablePart> find_cable_parts(const Deck& deck, const Model& model, Diagnostics& diagnostics);
/// Adds groups, masses and passes. `node_of`: the node of the world of each node of the model.
void build_cables(const Model& model, const std::vector<CablePart>& parts, const std::vector<Index>& node_of,
                  ElementOptions& options, World& world);

}  // namespace courant
