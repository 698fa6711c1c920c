#include "rigid/bodies/held_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace courant {

namespace {

using BodyMotion6 = Eigen::Matrix<Real, 6, 1>;

std::array<bool, 3> held_rotations(const Model& model, const ModelNode& node) {
  const auto turns = model.held_rotations.find(static_cast<Index>(&node - model.nodes.data()));
  return turns == model.held_rotations.end() ? std::array<bool, 3>{} : turns->second;
}

/// Motions that are forbidden, orthonormal.
class Forbidden {
 public:
  void add(const BodyMotion6& motion) {
    const BodyMotion6 rest = rest_of(motion.normalized());
    if (rest.norm() > small) all_.push_back(rest.normalized());
  }
  bool has(const BodyMotion6& motion) const { return rest_of(motion).norm() < small; }
  std::size_t count() const { return all_.size(); }

 private:
  static constexpr Real small = 1e-6;
  BodyMotion6 rest_of(BodyMotion6 motion) const {
    for (const BodyMotion6& one : all_) motion -= one.dot(motion) * one;
    return motion;
  }
  std::vector<BodyMotion6> all_;
};

/// `held`: none where the body cannot be held so.
void tell_spc(const std::vector<const ModelNode*>& constrained, const BodyText& body,
              const std::array<bool, 6>& held, Diagnostics& diagnostics) {
  const ModelNode& node = *constrained.front();
  const bool moves = node.fixed[0] || node.fixed[1] || node.fixed[2];
  const auto text =
      fmt::format("*BOUNDARY_SPC or {} on node {} of {}", moves ? "TC" : "RC", node.id, body.name);
  std::string axes;
  constexpr const char* names[] = {"x", "y", "z", "turns about x", "turns about y", "turns about z"};
  for (std::size_t k = 0; k < held.size(); ++k)
    if (held[k]) axes += (axes.empty() ? "" : ", ") + std::string(names[k]);
  if (axes.empty()) return diagnostics.error(body.where, text + " is not supported", body.instead);
  diagnostics.warning(
      body.where, fmt::format("{}: {} such nodes hold the whole body: {}", text, constrained.size(), axes),
      body.instead + ", which says the same without this warning");
}

}  // namespace

bool is_constrained(const Model& model, const ModelNode& node) {
  const std::array<bool, 3> turns = held_rotations(model, node);
  for (std::size_t k = 0; k < 3; ++k)
    if (node.fixed[k] || turns[k]) return true;
  return false;
}

void hold_by_nodes(const Model& model, const std::vector<const ModelNode*>& constrained, const World& world,
                   const BodyText& text, RigidBody& b, Diagnostics& diagnostics) {
  if (b.fixed() || constrained.empty()) return;
  Forbidden forbidden;
  for (int k = 0; k < 3; ++k) {  // what the material holds
    if (b.held[static_cast<std::size_t>(k)]) forbidden.add(BodyMotion6::Unit(k));
    if (b.no_turn[static_cast<std::size_t>(k)]) forbidden.add(BodyMotion6::Unit(3 + k));
  }
  Real size = 0;
  for (const Index n : b.nodes) size = std::max(size, (world.nodes.x.vec(n) - b.x).norm());
  if (!(size > 0)) size = 1;  // all nodes at the centre
  for (const ModelNode* node : constrained) {
    const std::array<bool, 3> turns = held_rotations(model, *node);
    for (int k = 0; k < 3; ++k) {
      BodyMotion6 motion = BodyMotion6::Zero();
      motion.head<3>() = Vec::Unit(k), motion.tail<3>() = ((node->x - b.x) / size).cross(Vec::Unit(k));
      if (node->fixed[static_cast<std::size_t>(k)]) forbidden.add(motion);
      if (turns[static_cast<std::size_t>(k)]) forbidden.add(BodyMotion6::Unit(3 + k));
    }
  }
  std::array<bool, 6> held{};
  std::size_t count = 0;
  for (int k = 0; k < 6; ++k)
    count += held[static_cast<std::size_t>(k)] = forbidden.has(BodyMotion6::Unit(k));
  tell_spc(constrained, text, count == forbidden.count() ? held : std::array<bool, 6>{}, diagnostics);
  if (count != forbidden.count()) return;
  for (std::size_t k = 0; k < 3; ++k)
    b.held[k] = b.held[k] || held[k], b.no_turn[k] = b.no_turn[k] || held[3 + k];
}

}  // namespace courant
