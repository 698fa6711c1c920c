#pragma once
// Formulations of solid elements: one file each, with its loops and a registration by ELFORM. Erosion, mass
// scaling, damping, frequencies, pressure, histories, reports, contact and output know none of them by name.
#include <vector>

#include "elements/solid/solid_loops.hpp"

namespace courant {

/// A value of ELFORM.
struct Elform {
  int number = 0;            ///< 0: none
  int nodes = 0;             ///< different nodes of its elements; 0: any number up to 8
  const char* shape = "";    ///< what elements of so many nodes are called
  const char* offer = "";    ///< of messages that list what there is; empty: another entry names it
  const char* warning = "";  ///< what LS-DYNA has and is not here; {0} becomes the part's id, {1} the number
  const char* hint = "";
};

struct SolidFormulation {
  Elform elforms[4]{};  ///< 0 behind the last
  /// Of a group: 8 in LS-DYNA's order, of which nodes may repeat; 4 of tetrahedra, 6 of pentahedra (N1 to N4,
  /// N5, N7); 10 and 20 of tetrahedra and hexahedra with nodes on their edges.
  int corners = 8;
  int points = 1;  ///< at most PointLoops::most_points
  /// Of the two the one that goes with `points`, for the machine the program runs on.
  OnePointLoops (*one_point)() = nullptr;
  PointLoops (*several)() = nullptr;
  bool has_modes = false;       ///< motions without a strain at the points, for hourglass control
  bool nodal_pressure = false;  ///< of tetrahedra: pressures are means over nodes (nodal_pressure.hpp)
  Real mass_shares[SolidMesh::most_corners]{};  ///< of corners [-]; 0: equal for different nodes
  Real resolved_length = 1;                     ///< of bulk viscosity, over the cube root of the volume [-]
  /// How many points must fail by their law (FS) to delete an element; 0: all. Few, where the others leave
  /// motions without stiffness.
  int failing_points = 0;
  bool linear_dilatation = false;  ///< SolidControl::dilatation counts
};

/// In the order of their first ELFORM, independent of the order of linking.
std::vector<SolidFormulation>& solid_formulations();

/// Nothing of it is inlined: files of loops are compiled with flags of their own.
struct RegisterSolidFormulation {
  explicit RegisterSolidFormulation(const SolidFormulation& formulation);
};

}  // namespace courant
