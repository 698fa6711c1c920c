#include "laws/strength/material_axes.hpp"

#include "keyword/registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace courant {

bool tells_directions(const std::string& keyword) {
  for (const auto& spec : keyword_registry())
    if (spec->names.front() == keyword)
      for (const CardSpec& card : spec->cards)
        for (const FieldSpec& field : card.fields)
          if (field.name == "AOPT") return true;
  return false;
}

bool direction_in_shell(const MaterialAxes& axes, const Vec& n, const Vec& side, Vec& a) {
  constexpr Real along_normal = 1e-6;  // sine of the angle to it
  const Vec& given = axes.rule == MaterialAxes::Rule::side ? side : axes.along;
  const Vec found =
      axes.rule == MaterialAxes::Rule::across ? Vec(given.cross(n)) : Vec(given - given.dot(n) * n);
  if (!(found.norm() > along_normal * given.norm())) return false;
  const Vec e = found.normalized();
  const Real angle = axes.beta * pi / 180;
  a = std::cos(angle) * e + std::sin(angle) * n.cross(e);
  return true;
}

SheetStiffness::SheetStiffness(Real EA, Real EB, Real PRBA) {
  const Real f = 1 / (1 - PRBA * PRBA * EA / EB);  // 1 - nu_ab nu_ba
  aa = f * EA, bb = f * EB, ab = f * PRBA * EA;
}

Real SheetStiffness::largest(Real G) const {
  return std::max({aa, bb, (aa + bb + 2 * ab) / 4 + G});  // along a, along b, between them
}

MaterialAxes DirectionsCard::axes(const Model& model, Real angle) const {
  MaterialAxes out;
  out.beta = angle;
  if (aopt == 2) {
    out.rule = MaterialAxes::Rule::vector, out.along = Vec(a1, a2, a3);
  } else if (aopt == 3) {
    out.rule = MaterialAxes::Rule::across, out.along = Vec(v1, v2, v3);
  } else if (aopt < 0) {
    const auto system = model.coordinate_systems.find(static_cast<Id>(-aopt));
    out.rule = MaterialAxes::Rule::vector;
    if (system != model.coordinate_systems.end()) out.along = system->second.axes.col(0);
  }
  return out;
}

void DirectionsCard::check_axes(const Deck& deck, const Model& model, Diagnostics& diagnostics) const {
  if (aopt < 0) {
    const auto system = model.coordinate_systems.find(static_cast<Id>(-aopt));
    if (aopt != std::floor(aopt) || system == model.coordinate_systems.end())
      deck.error(diagnostics, *this, "AOPT", fmt::format("coordinate system {:g} does not exist", -aopt),
                 "define it with *DEFINE_COORDINATE_SYSTEM, _VECTOR or _NODES");
    else if (system->second.moves)
      deck.error(
          diagnostics, *this, "AOPT",
          fmt::format("coordinate system {:g} moves with nodes, and directions of a material turn with "
                      "their element",
                      -aopt),
          "use a system that stands still");
    return;
  }
  if (aopt != 0 && aopt != 2 && aopt != 3)
    deck.error(diagnostics, *this, "AOPT",
               fmt::format("'{:g}' is not supported: no direction in shells follows from it", aopt),
               "supported values: 0, 2, 3, and < 0: minus a coordinate system");
  if (aopt == 2 && Vec(a1, a2, a3).norm() == 0)
    deck.error(diagnostics, *this, "A1", "AOPT 2 needs a direction a", "give A1, A2, A3");
  if (aopt == 3 && Vec(v1, v2, v3).norm() == 0)
    deck.error(diagnostics, *this, "V1", "AOPT 3 needs a direction v", "give V1, V2, V3");
}

}  // namespace courant
