// *BOUNDARY_PRESCRIBED_MOTION_NODE, _SET and _RIGID: their table, and what they mean.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <type_traits>
#include <unordered_map>

#include "keyword/registry.hpp"
#include "model/conditions/condition_cards.hpp"
#include "model/conditions/motion_ids.hpp"
#include "model/conditions/prescribed_motion.hpp"
#include "model/transforms/transformation.hpp"

namespace courant {

namespace {

struct MotionOfNode : MotionCard {
  static constexpr const char* field = "NID";
};
struct MotionOfSet : MotionCard {
  static constexpr const char* field = "NSID";
};
struct MotionOfRigid : MotionCard {
  static constexpr const char* field = "PID";
};
struct MotionOfRigidLocal : MotionCard {
  static constexpr const char* field = "PID";
};

constexpr int along_vector = 4, first_rotation = 5, first_around = 9;

const RegisterKeyword<MotionOfNode> of_node{boundary_prescribed_motion_node_table()};
const RegisterKeyword<MotionOfSet> of_set{boundary_prescribed_motion_set_table()};
const RegisterKeyword<MotionOfRigid> of_rigid{boundary_prescribed_motion_rigid_table()};
const RegisterKeyword<MotionOfRigidLocal> of_rigid_local{boundary_prescribed_motion_rigid_local_table()};

class Reader {
 public:
  Reader(const Deck& deck, const Model& model, Diagnostics& diagnostics)
      : deck_(deck), model_(model), diagnostics_(diagnostics) {}

  std::vector<PrescribedMotion> read() {
    for (const auto& card : deck_.all<MotionOfNode>())
      if (const Index n = node(card); n >= 0) add(card, {n}, -1);
    for (const auto& card : deck_.all<MotionOfSet>()) {
      const auto found = model_.node_sets.find(card.moved);
      if (found == model_.node_sets.end())
        missing(card, MotionOfSet::field, "node set", card.moved, "*SET_NODE");
      else
        add(card, found->second, -1);
    }
    for (const auto& card : deck_.all<MotionOfRigid>()) add_of_body(card, false);
    for (const auto& card : deck_.all<MotionOfRigidLocal>()) add_of_body(card, true);
    return std::move(motions_);
  }

 private:
  void missing(const Entry& card, const char* field, const char* what, Id id, const char* keyword) {
    deck_.error(diagnostics_, card, field, fmt::format("{} {} does not exist", what, id),
                fmt::format("define it with {}", keyword));
  }

  Index node(const MotionOfNode& card) {
    if (node_of_id_.empty())
      for (std::size_t n = 0; n < model_.nodes.size(); ++n)
        node_of_id_.emplace(model_.nodes[n].id, static_cast<Index>(n));
    const auto found = node_of_id_.find(card.moved);
    if (found != node_of_id_.end()) return found->second;
    missing(card, MotionOfNode::field, "node", card.moved, "*NODE");
    return -1;
  }

  bool supported(const MotionCard& card, bool of_body) {
    const int most = of_body || model_.turns() ? first_rotation + 2 : along_vector;
    const bool around = !of_body && card.dof >= first_around && card.dof < first_around + 3;
    const bool direction = around || (card.dof >= 1 && card.dof <= most),
               kind = card.vad >= 0 && card.vad <= 2 && !(around && card.vad == 1);
    if (!direction)
      deck_.error(diagnostics_, card, "DOF", fmt::format("'{}' is not supported", card.dof),
                  fmt::format("supported: 1 to {}{}", most, of_body ? "" : ", 9 to 11"));
    if (!kind && around)
      deck_.error(diagnostics_, card, "VAD",
                  fmt::format("'{}' is not supported with DOF {}", card.vad, card.dof),
                  "supported: 0 (angular velocity) and 2 (angle)");
    else if (!kind)
      deck_.error(diagnostics_, card, "VAD", fmt::format("'{}' is not supported", card.vad),
                  "supported: 0 to 2; curves of time, in the global system");
    return direction && kind;
  }

  void add_of_body(const MotionCard& card, bool local) {
    if (local && card.dof == along_vector)
      return deck_.error(diagnostics_, card, "DOF", fmt::format("'{}' is not supported", card.dof),
                         "supported: 1 to 3 and 5 to 7, along and about the axes of the body");
    const auto found = model_.part_of_id.find(card.moved);  // else a body of nodes, or who moves bodies tells
    const std::size_t before = motions_.size();
    add(card, {}, found == model_.part_of_id.end() ? -1 : found->second, card.moved);
    if (motions_.size() > before) motions_.back().local = local;
  }

  /// `body`: 0 of nodes.
  void add(const MotionCard& card, std::vector<Index> nodes, Index part, Id body = 0) {
    if (!supported(card, body != 0)) return;
    const auto curve = model_.curves.find(card.lcid);
    if (curve == model_.curves.end()) return missing(card, "LCID", "curve", card.lcid, "*DEFINE_CURVE");
    PrescribedMotion motion;
    motion.kind = static_cast<PrescribedMotion::Kind>(card.vad);
    const bool around = card.dof >= first_around;
    motion.turns = card.dof >= first_rotation && !around;
    motion.curve = curve->second;
    motion.sf = card.sf;
    motion.birth = card.birth;
    motion.death = card.death;
    motion.nodes = std::move(nodes);
    motion.part = part, motion.body = body, motion.id = card.id;
    motion.card = card;
    if (card.dof == along_vector) {
      if (!set_vector(card, motion)) return;
    } else {
      if (!around) motion.direction[motion.turns ? card.dof - first_rotation : card.dof - 1] = 1;
      if (card.vid != 0)
        return deck_.error(
            diagnostics_, card, "VID",
            fmt::format("'{}' is not supported with DOF {}: the direction is an axis", card.vid, card.dof),
            "leave VID blank, or use DOF 4");
    }
    if (motion.kind == PrescribedMotion::Kind::displacement && jumps(motion.curve))
      return deck_.error(
          diagnostics_, card, "LCID",
          fmt::format("curve {} jumps, so that displacements would need an infinite velocity", card.lcid),
          "give the jump some time");
    if (motion.kind == PrescribedMotion::Kind::displacement) motion.jump = motion.curve(0);
    if (around) return add_around(card, std::move(motion));
    motions_.push_back(std::move(motion));
  }
  /// Two of them, along the axes of the plane.
  void add_around(const MotionCard& card, PrescribedMotion motion) {
    const int axis = card.dof - first_around, first = (axis + 1) % 3, second = (axis + 2) % 3;
    motion.around = axis;
    motion.centre[first] = card.offset1, motion.centre[second] = card.offset2;
    for (const int k : {first, second}) {
      motion.direction = Vec::Unit(k);
      motions_.push_back(motion);
    }
  }

  bool set_vector(const MotionCard& card, PrescribedMotion& motion) {
    const auto vector = model_.vectors.find(card.vid);
    if (vector == model_.vectors.end()) {
      missing(card, "VID", "vector", card.vid, "*DEFINE_VECTOR");
      return false;
    }
    const Vec along = vector->second.head - vector->second.tail;
    const bool usable = !vector->second.moves && along.norm() > 0;
    if (!usable)
      deck_.error(
          diagnostics_, card, "VID",
          fmt::format("vector {} {}", card.vid,
                      vector->second.moves ? "turns with nodes, which is not supported" : "has no direction"),
          "give it by two points that differ");
    else
      motion.direction = along.normalized();
    return usable;
  }

  static bool jumps(const Curve& curve) {
    for (std::size_t k = 1; k < curve.abscissa.size(); ++k)
      if (curve.abscissa[k] == curve.abscissa[k - 1] && curve.ordinate[k] != curve.ordinate[k - 1])
        return true;
    return false;
  }

  const Deck& deck_;
  const Model& model_;
  Diagnostics& diagnostics_;
  std::unordered_map<Id, Index> node_of_id_;
  std::vector<PrescribedMotion> motions_;
};

/// Warns of displacements that are not 0 at BIRTH.
void warn_of_jumps(const Deck& deck, const std::vector<PrescribedMotion>& motions, Diagnostics& diagnostics) {
  constexpr Real round_off = 1e-9;
  const Entry* told = nullptr;
  for (const PrescribedMotion& motion : motions) {
    Real most = 0;
    for (const Real y : motion.curve.ordinate) most = std::max(most, std::abs(y));
    const bool again = told && told->line == motion.card.line && told->file == motion.card.file;
    if (motion.curve.silent || again || !(std::abs(motion.jump) > round_off * most)) continue;
    told = &motion.card;
    deck.warning(diagnostics, motion.card, "LCID",
                 fmt::format("the displacement begins with {:g} at BIRTH: it jumps there in one step",
                             motion.sf * motion.jump),
                 "let the curve begin at 0, and rise in the time that it should take");
  }
}

}  // namespace

/// Directions are axes: they stay where a file is only shifted. Vectors move with their file.
std::string keep_axes(MotionCard& card, const Affine& motion) {
  if (card.dof == along_vector) return refuse_stretch(motion, "motions");
  if (motion.linear() == Matrix::Identity()) {
    if (card.dof >= first_around && card.dof < first_around + 3) {
      const int axis = card.dof - first_around;
      card.offset1 += motion.translation()[(axis + 1) % 3],
          card.offset2 += motion.translation()[(axis + 2) % 3];
    }
    return {};
  }
  return "its direction is an axis, which a transformation that turns or stretches the file would change";
}

bool has_offsets(const MotionCard& card) {
  return std::abs(card.dof) >= first_around || card.vad == 4;
}

CurveOf curve_of_drive(int vad, bool turns) {
  constexpr const char* values[3][2] = {{"L/T", "1/T"}, {"L/T2", "1/T2"}, {"L", "-"}};
  return {"T", vad >= 0 && vad <= 2 ? values[vad][turns] : "-"};
}

CurveOf curve_of_motion(const MotionCard& card) {
  return curve_of_drive(card.vad, card.dof >= first_rotation);
}

bool has_motion_of_nodes(const Deck& deck, Id id) {
  const auto among = [&](const auto& cards) {
    return std::any_of(cards.begin(), cards.end(), [&](const MotionCard& one) { return one.id == id; });
  };
  return among(deck.all<MotionOfNode>()) || among(deck.all<MotionOfSet>());
}

std::vector<PrescribedMotion> prescribed_motions(const Deck& deck, const Model& model,
                                                 Diagnostics& diagnostics, bool relaxed) {
  std::vector<PrescribedMotion> out = Reader(deck, model, diagnostics).read();
  if (relaxed && model.phase == RunPhase::transient)
    for (PrescribedMotion& motion : out)
      if (motion.curve.sidr == 2 && motion.birth <= 0) motion.jump = 0;  // made in the relaxation
  warn_of_jumps(deck, out, diagnostics);
  return out;
}

}  // namespace courant
