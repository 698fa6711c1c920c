#pragma once
#include <vector>

#include "elements/shell/shells.hpp"

namespace courant {

/// Notes parts whose quadrilaterals of one point, without BWC 1, meet at angles: nothing in them has a
/// stiffness about the normal, so a curved surface or an open section bends and twists too easily. The
/// largest angle goes into the summary. [degrees]
void note_facets(const Model& model, const std::vector<ShellPart>& parts, World& world,
                 Diagnostics& diagnostics);

}  // namespace courant
