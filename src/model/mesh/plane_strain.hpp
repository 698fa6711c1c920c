#pragma once
#include "model/model.hpp"

namespace courant {

/// In a plane scene all is per unit of depth and nothing moves along z. Holds z, and turns about x and y, of
/// the nodes of solids and shells that are not rigid, so that they deform in plane strain. Parts whose
/// elements are not one unit deep in z are errors: the water's mass and forces are those of one.
void hold_in_plane(Model& model, Diagnostics& diagnostics);

}  // namespace courant
