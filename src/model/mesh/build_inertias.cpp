// *ELEMENT_INERTIA: masses on nodes that have an inertia of their own.
#include <fmt/format.h>

#include <unordered_map>

#include <Eigen/Eigenvalues>

#include "keyword/registry.hpp"
#include "model/mesh/cards_inertia.hpp"
#include "model/mesh/mesh_cards.hpp"
#include "model/model_builder.hpp"
#include "model/transforms/transformation.hpp"

namespace courant {

namespace {

using NodeMass = ElementInertiaCard;
const RegisterKeyword<NodeMass> element_inertia{element_inertia_table()};

}  // namespace

bool has_offset(const ElementInertiaCardFields& card) {
  return card.name == 1;
}

/// The tensor turns with the file, unless it is in axes of its own, which turn.
std::string move_inertia(ElementInertiaCardFields& fields, const Affine& motion) {
  auto& card = static_cast<ElementInertiaCard&>(fields);
  if (card.csid != 0) return {};
  if (!keeps_lengths(motion)) return refuse_stretch(motion, "inertia");
  const Matrix turned = motion.linear() * card.inertia() * motion.linear().transpose();
  card.ixx = turned(0, 0), card.iyy = turned(1, 1), card.izz = turned(2, 2);
  card.ixy = turned(0, 1), card.ixz = turned(0, 2), card.iyz = turned(1, 2);
  return {};
}

void ModelBuilder::build_inertias() {
  std::unordered_map<Id, const NodeMass*> known;
  for (const NodeMass& card : deck_.all<NodeMass>()) {
    const auto [it, is_new] = known.try_emplace(card.eid, &card);
    if (!is_new) duplicate(card, "EID", "inertia", card.eid, deck_.where(*it->second));
    ModelInertia one{.id = card.eid, .mass = card.mass, .J = card.inertia(), .card = card};
    one.node = node(card, "NID", card.nid);
    one.offset = Vec(card.x_off, card.y_off, card.z_off);
    if (card.csid != 0) {
      const CoordinateSystem* system = coordinate_system(card, "CSID", card.csid);
      if (card.ixy != 0 || card.ixz != 0 || card.iyz != 0)
        error(card, "IXY", "IXY, IXZ and IYZ are given with CSID, whose axes are the principal ones",
              "leave them 0, or CSID");
      if (one.offset.norm() > 0)
        error(card, "CSID", "an offset beside CSID is not supported: its axes are not documented",
              "give the tensor along global axes, with CSID 0");
      if (system) one.J = system->axes * one.J * system->axes.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Matrix> own(one.J);
    const Vec principal = own.eigenvalues();
    constexpr Real round_off = 1e-9;
    if (principal[0] < -round_off * principal[2])
      error(card, "IXX", fmt::format("the tensor has a principal moment below 0, {:.4g}", principal[0]),
            "IXY, IXZ and IYZ are the elements of the tensor, minus the integrals of x y, x z and y z");
    if (one.node >= 0) model_.inertias.push_back(std::move(one));
  }
}

}  // namespace courant
