#pragma once
// Laws with directions: their definition in a deck, and the fields of the cards.
#include <array>
#include <string>
#include <vector>

#include "base/real.hpp"
#include "keyword/card.hpp"
#include "keyword/deck.hpp"
#include "model/model.hpp"

namespace courant {

/// Where a lies in a shell before it is turned about the normal n by BETA; where a, b, c lie in a solid.
struct MaterialAxes {
  enum class Rule {
    side,    ///< AOPT 0: along side 1-2; b in a solid towards node 4
    vector,  ///< AOPT 2, and < 0: along `along`, projected on the shell; b in a solid towards `beside`
    across,  ///< AOPT 3: along `along` x n; c in a solid is n, the normal of the middle between its faces
  } rule = Rule::side;
  Vec along = Vec::Zero();   ///< [-]
  Real beta = 0;             ///< [degrees]
  Vec beside = Vec::Zero();  ///< [-]
};

/// Whether cards of a keyword define directions.
bool tells_directions(const std::string& keyword);

/// In the plane of a shell. Nothing where the rule names no direction there.
/// `n`: its unit normal; `side`: from node 1 to 2.
bool direction_in_shell(const MaterialAxes& axes, const Vec& n, const Vec& side, Vec& a);

/// In a hexahedron with these corners: unit vectors a, b, c as columns. Nothing where the rule names none.
bool directions_in_solid(const MaterialAxes& axes, const std::array<Vec, 8>& corner, Matrix& directions);

/// What laws of solids keep first of their directions, since a tensor turns with the body: a a + 2 b b + 3 c
/// c. Solids lay it at the start.
inline constexpr const char* material_directions = "material_directions";
/// xx yy zz xy yz zx. [-]
std::array<Real, 6> direction_tensor(const Matrix& directions);
/// Back from it, up to signs; of a tensor that is 0 x, y, z.
Matrix directions_of_tensor(const std::array<Real, 6>& tensor);

/// Stiffnesses of a sheet in plane stress by its own directions. [M/LT2]
struct SheetStiffness {
  Real aa = 0, bb = 0, ab = 0;
  /// EA, EB, and Poisson's ratio of a stress along b for the strain along a.
  SheetStiffness(Real EA, Real EB, Real PRBA);
  /// Largest stiffness under one strain, in any direction: the bound of the step. `G`: in the plane.
  Real largest(Real G) const;
};

/// What cards of such laws have alike. Directions d (AOPT 2) serve solids only.
struct DirectionsCard : Entry {
  Real aopt = 0, xp = 0, yp = 0, zp = 0, a1 = 0, a2 = 0, a3 = 0;
  Real v1 = 0, v2 = 0, v3 = 0, d1 = 0, d2 = 0, d3 = 0;
  /// From valid cards. `angle`: their BETA [degrees].
  MaterialAxes axes(const Model& model, Real angle) const;
  /// Reports rules that are not there, and directions that are missing.
  void check_axes(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;
  /// The same for solids.
  void check_axes_in_solids(const Deck& deck, const Model& model, Diagnostics& diagnostics) const;
};

/// XP YP ZP A1 A2 A3, and V1 V2 V3 D1 D2 D3; a card adds its own last fields.
template <class C>
std::vector<FieldOf<C>> fields_of_a() {
  return {{"XP", &C::xp, "L", "point of AOPT 1 and 4, which shells do not have", no_effect},
          {"YP", &C::yp, "L", "its y", no_effect},
          {"ZP", &C::zp, "L", "its z", no_effect},
          {"A1", &C::a1, "-", "direction a of AOPT 2, x", {.spatial = Spatial::direction}},
          {"A2", &C::a2, "-", "direction a, y"},
          {"A3", &C::a3, "-", "direction a, z"}};
}
template <class C>
std::vector<FieldOf<C>> fields_of_v() {
  return {{"V1", &C::v1, "-", "direction v of AOPT 3, x", {.spatial = Spatial::direction}},
          {"V2", &C::v2, "-", "direction v, y"},
          {"V3", &C::v3, "-", "direction v, z"},
          {"D1", &C::d1, "-", "direction d of AOPT 2, of solids", no_effect},
          {"D2", &C::d2, "-", "direction d, y", no_effect},
          {"D3", &C::d3, "-", "direction d, z", no_effect}};
}
template <class C>
std::vector<FieldOf<C>> with_fields(std::vector<FieldOf<C>> first, std::vector<FieldOf<C>> more) {
  for (FieldOf<C>& field : more) first.push_back(std::move(field));
  return first;
}
inline constexpr const char* aopt_meaning =
    "direction a of shells: 0 along side 1-2, 2 along A, 3 along V x normal, < 0: x axis of system -AOPT";

}  // namespace courant
