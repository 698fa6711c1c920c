#pragma once
// Directions of materials in solids.
#include "elements/solid/full_points.hpp"
#include "laws/strength/material_axes.hpp"

namespace courant {

/// That they are there in each element of the part.
void check_directions(const Deck& deck, const Model& model, Index part, const MaterialAxes& axes,
                      Diagnostics& diagnostics);

/// As elements lie now, into the first tensor of the law's history: of the elements, and of their points
/// where they have several.
void lay_directions(const MaterialAxes& axes, const ElementGroup& group, const SolidMesh& mesh,
                    Field<Real>& tensor, FullPoints* points);

}  // namespace courant
