#include "laws/strength/material_axes.hpp"

#include "keyword/registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Eigenvalues>

namespace courant {

bool tells_directions(const std::string& keyword) {
  for (const auto& spec : keyword_registry())
    if (spec->names.front() == keyword)
      for (const CardSpec& card : spec->cards)
        for (const FieldSpec& field : card.fields)
          if (field.name == "AOPT") return true;
  return false;
}

namespace {

constexpr Real along_each_other = 1e-6;  ///< sine of the angle below which a cross product has no direction

}  // namespace

bool direction_in_shell(const MaterialAxes& axes, const Vec& n, const Vec& side, Vec& a) {
  const Vec& given = axes.rule == MaterialAxes::Rule::side ? side : axes.along;
  const Vec found =
      axes.rule == MaterialAxes::Rule::across ? Vec(given.cross(n)) : Vec(given - given.dot(n) * n);
  if (!(found.norm() > along_each_other * given.norm())) return false;
  const Vec e = found.normalized();
  const Real angle = axes.beta * pi / 180;
  a = std::cos(angle) * e + std::sin(angle) * n.cross(e);
  return true;
}

bool directions_in_solid(const MaterialAxes& axes, const std::array<Vec, 8>& corner, Matrix& directions) {
  Vec a = axes.along, beside = axes.beside;
  if (axes.rule == MaterialAxes::Rule::side) {
    a = corner[1] - corner[0], beside = corner[3] - corner[0];
  } else if (axes.rule == MaterialAxes::Rule::across) {
    const auto middle = [&](std::size_t k) { return Vec(0.5 * (corner[k] + corner[k + 4])); };
    const Vec n = (middle(2) - middle(0)).cross(middle(3) - middle(1)).normalized();
    a = axes.along.cross(n), beside = n.cross(a);
    if (!(a.norm() > along_each_other * axes.along.norm())) return false;
  }
  const Vec c = a.cross(beside);
  if (!(c.norm() > along_each_other * a.norm() * beside.norm())) return false;
  directions.col(0) = a.normalized(), directions.col(2) = c.normalized();
  directions.col(1) = directions.col(2).cross(directions.col(0));
  return true;
}

std::array<Real, 6> direction_tensor(const Matrix& directions) {
  const Matrix M = directions * Vec(1, 2, 3).asDiagonal() * directions.transpose();
  return {M(0, 0), M(1, 1), M(2, 2), M(0, 1), M(1, 2), M(2, 0)};
}

Matrix directions_of_tensor(const std::array<Real, 6>& t) {
  Matrix M;
  M << t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2];
  return Eigen::SelfAdjointEigenSolver<Matrix>(M).eigenvectors();  // values rise: a, b, c
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
    out.rule = MaterialAxes::Rule::vector, out.along = Vec(a1, a2, a3), out.beside = Vec(d1, d2, d3);
  } else if (aopt == 3) {
    out.rule = MaterialAxes::Rule::across, out.along = Vec(v1, v2, v3);
  } else if (aopt < 0) {
    const auto system = model.coordinate_systems.find(static_cast<Id>(-aopt));
    out.rule = MaterialAxes::Rule::vector;
    if (system != model.coordinate_systems.end())
      out.along = system->second.axes.col(0), out.beside = system->second.axes.col(1);
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
          "use a fixed system");
    return;
  }
  if (aopt != 0 && aopt != 2 && aopt != 3)
    deck.error(diagnostics, *this, "AOPT",
               fmt::format("'{:g}' is not supported: no direction in elements follows from it", aopt),
               "supported values: 0, 2, 3, and < 0: minus a coordinate system");
  if (aopt == 2 && Vec(a1, a2, a3).norm() == 0)
    deck.error(diagnostics, *this, "A1", "AOPT 2 needs a direction a", "give A1, A2, A3");
  if (aopt == 3 && Vec(v1, v2, v3).norm() == 0)
    deck.error(diagnostics, *this, "V1", "AOPT 3 needs a direction v", "give V1, V2, V3");
}

void DirectionsCard::check_axes_in_solids(const Deck& deck, const Model& model,
                                          Diagnostics& diagnostics) const {
  check_axes(deck, model, diagnostics);
  const Vec a(a1, a2, a3), d(d1, d2, d3);
  if (aopt == 2 && a.norm() > 0 && !(a.cross(d).norm() > along_each_other * a.norm() * d.norm()))
    deck.error(diagnostics, *this, "D1", "AOPT 2 needs a direction d beside a in solids",
               "give D1, D2, D3, not along A1, A2, A3: c is a x d");
}

}  // namespace courant
