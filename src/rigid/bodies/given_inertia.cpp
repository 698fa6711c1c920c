#include "rigid/bodies/given_inertia.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace courant {

namespace {

/// No eigenvalue is below 0 by more than `slack`.
bool is_positive(const Matrix& a, Real slack) {
  const Matrix b = a + slack * Matrix::Identity();
  return b(0, 0) > 0 && b(0, 0) * b(1, 1) - b(0, 1) * b(1, 0) > 0 && b.determinant() > 0;
}

}  // namespace

bool take_given_inertia(const Deck& deck, const Model& model, const World& world, const PartInertiaCard& card,
                        const InertiaBody& of, RigidBody& b, Diagnostics& diagnostics) {
  const auto error = [&](const char* field, std::string what, const char* hint) {
    deck.error(diagnostics, card, field, std::move(what), hint);
    return false;
  };
  b.m = card.tm, b.x = Vec(card.xc, card.yc, card.zc);
  if (card.nodeid != 0) {
    const auto node = std::find_if(model.nodes.begin(), model.nodes.end(),
                                   [&](const ModelNode& n) { return n.id == card.nodeid; });
    if (node == model.nodes.end())
      return error("NODEID", fmt::format("node {} does not exist", card.nodeid), "define it with *NODE");
    b.x = node->x;
  }
  Matrix axes = Matrix::Identity();
  if (card.ircs == 1 && card.cid != 0) {
    const auto system = model.coordinate_systems.find(card.cid);
    if (system == model.coordinate_systems.end())
      return error("CID", fmt::format("coordinate system {} does not exist", card.cid),
                   "define it with *DEFINE_COORDINATE_SYSTEM");
    axes = system->second.axes;
  } else if (card.ircs == 1) {
    const Vec x(card.xl, card.yl, card.zl), in_plane(card.xlip, card.ylip, card.zlip);
    const Vec z = x.cross(in_plane);
    if (!(z.norm() > 0))
      return error("XL", "the vectors of the local axes are parallel, or none",
                   "XL is along the local x axis, XLIP another one in the local xy plane");
    axes.col(0) = x.normalized(), axes.col(2) = z.normalized();
    axes.col(1) = axes.col(2).cross(axes.col(0));
  }
  b.J0 = axes * card.inertia() * axes.transpose();
  const Matrix second = 0.5 * b.J0.trace() * Matrix::Identity() - b.J0;  // of x x^T dm
  if (!is_positive(b.J0, -1e-9 * b.J0.trace()))
    return error("IXX", "no body has such an inertia", "principal moments are above 0");
  if (!is_positive(second, 1e-9 * b.J0.trace()))
    deck.warning(
        diagnostics, card, "IXX",
        "no body has such an inertia: of its principal moments one is larger than the sum of the others; it "
        "turns by it all the same",
        "look at the signs and the axes of the tensor");
  const BodyStart own{Vec(card.vtx, card.vty, card.vtz), Vec(card.vrx, card.vry, card.vrz)};
  const BodyStart start = replaced_start(deck, model, world, of, b.x).value_or(own);
  b.v = start.v, b.L = b.J0 * start.omega;
  return true;
}

}  // namespace courant
