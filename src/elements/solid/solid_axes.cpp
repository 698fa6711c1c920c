#include "elements/solid/solid_axes.hpp"

#include <fmt/format.h>

#include <cmath>

#include "elements/element_laws.hpp"

namespace courant {

void check_directions(const Deck& deck, const Model& model, Index part, const MaterialAxes& axes,
                      Diagnostics& diagnostics) {
  for (const ModelSolid& solid : model.solids) {
    if (solid.part != part) continue;
    std::array<Vec, 8> corner;
    const std::array<Index, 8> nodes = solid.corners();
    for (std::size_t c = 0; c < 8; ++c) corner[c] = model.nodes[static_cast<std::size_t>(nodes[c])].x;
    Matrix directions;
    if (directions_in_solid(axes, corner, directions)) continue;
    return deck.error(
        diagnostics, model.parts[static_cast<std::size_t>(part)].card, "MID",
        fmt::format("the material of part {} has no directions in solid {}: two that define them "
                    "lie along each other",
                    model.parts[static_cast<std::size_t>(part)].id, solid.id),
        "choose another AOPT, or other directions");
  }
}

namespace {

void lay_directions(const MaterialAxes& axes, const ElementGroup& group, const SolidMesh& mesh,
                    Field<Real>& tensor, FullPoints* points) {
  for (Index e = 0; e < group.size(); ++e) {
    std::array<Vec, 8> corner;
    const std::array<int, 8> corners = group.hexahedron();
    for (std::size_t c = 0; c < 8; ++c)
      for (std::size_t k = 0; k < 3; ++k)
        corner[c][static_cast<int>(k)] = mesh.x[k][mesh.corner[corners[c]][e]];
    Matrix directions = Matrix::Identity();
    directions_in_solid(axes, corner, directions);  // check_directions has looked
    const std::array<Real, 6> laid = direction_tensor(directions);
    for (int k = 0; k < 6; ++k) tensor.data(k)[e] = laid[static_cast<std::size_t>(k)];
    if (points) points->set_tensor(0, e, laid);
  }
}

void lay_sizes(const ElementGroup& group, const std::vector<Field<Real>*>& history, FullPoints* points) {
  for (std::size_t h = 0; h < history.size(); ++h) {
    const auto side = [&](Index e) { return std::cbrt(group.V0[e]); };
    if (lay_size(*history[h], group.size(), side) && points) points->set_number(h, *history[h]);
  }
}

}  // namespace

void lay_directions_and_sizes(const StrengthLaw& law, const ElementGroup& group, const SolidMesh& mesh,
                              const std::vector<Field<Real>*>& history, FullPoints* points) {
  if (law.axes()) lay_directions(*law.axes(), group, mesh, *history.front(), points);
  lay_sizes(group, history, points);
}

}  // namespace courant
