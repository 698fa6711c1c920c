#pragma once
#include <memory>
#include <vector>

#include "elements/shape_watch.hpp"
#include "elements/shell/shells.hpp"

namespace courant {

/// Notes parts whose quadrilaterals of one point, without BWC 1, meet at angles: nothing in them has a
/// stiffness about the normal, so a curved surface or an open section bends and twists too easily. The
/// largest angle goes into the summary. [degrees]
void note_facets(const Model& model, const std::vector<ShellPart>& parts, World& world,
                 Diagnostics& diagnostics);

/// Examines whether shells of one point, without BWC 1, bend without moments: the
/// curvature of the surface that their nodes span, less that of the start, has an energy by Koiter's theory,
/// which moments should hold. `maxima` of the world get `unresisted_curvature`: what is missing of it, over
/// the energy (internal and of hourglass control) of the shells, both summed over all looks; 0 where it is
/// negligible in the scene. Shells that yielded, or end the surface, miss nothing; parts whose law is neither
/// linear nor plastic are not looked at. Null: there are no such shells. [-]
std::shared_ptr<ShapeWatch> make_curvature_watch(const std::vector<ShellPart>& parts, World& world);

}  // namespace courant
