#pragma once
// *INITIAL_AXIAL_FORCE_BEAM: the axial force of beams until a time.
#include <array>
#include <vector>

#include "base/real.hpp"
#include "keyword/deck.hpp"
#include "model/model.hpp"
#include "state/field.hpp"

namespace courant {

struct BeamPart;
struct BeamMeasures;
struct SectionPoint;

/// When a preload by a curve ends: with its last point, or with the one from which it falls to 0. [T]
Real end_of_preload(const Curve& curve);

/// Of the beams of a part, by element of their group.
class AxialPreload {
 public:
  bool any() const { return !of_beam_.empty(); }
  /// Gives the points of beam e, with the stress `xx` of each, the axial force that it has at a time, and
  /// adds what that changes of the section's axial force and moments about s and t to `sum` (0, 2, 3).
  void hold(Index e, Real t, const std::vector<SectionPoint>& points, const BeamMeasures& m,
            Field<Real>& stress, std::array<Real, 6>& sum) const;
  struct AxialForce {
    Curve curve{};
    Real until = 0;  ///< [T]
    bool keeps_bending = false;
  };
  void add(std::size_t beams, std::size_t e, const AxialForce& force);

 private:
  std::vector<AxialForce> forces_;
  std::vector<Index> of_beam_;  ///< into forces_, -1: none
};

/// Refuses by name: sets that are not there, beams of ELFORM 2 and 6, forces beyond what a material yields
/// at.
void read_preloads(const Deck& deck, const Model& model, std::vector<BeamPart>& parts,
                   Diagnostics& diagnostics);

}  // namespace courant
