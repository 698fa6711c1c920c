#pragma once
// What laws know of the solid that they are in: directions and size.
#include "elements/solid/full_points.hpp"
#include "laws/strength/material_axes.hpp"

namespace courant {

/// That they are there in each element of the part.
void check_directions(const Deck& deck, const Model& model, Index part, const MaterialAxes& axes,
                      Diagnostics& diagnostics);

/// At the start: directions as elements lie now into the first tensor of the law's history, and sizes into
/// the number of that name, where the law has them. `history`: of the elements; their points where they have
/// several get the same.
void lay_directions_and_sizes(const StrengthLaw& law, const ElementGroup& group, const SolidMesh& mesh,
                              const std::vector<Field<Real>*>& history, FullPoints* points);

}  // namespace courant
