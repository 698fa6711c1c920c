#include "rigid/joints/build_joints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "model/definitions/named_curve.hpp"
#include "rigid/joints/joint_cards.hpp"
#include "rigid/joints/place_gears.hpp"

namespace courant {

namespace {

constexpr std::array joint_fields{"N1", "N2", "N3", "N4", "N5", "N6"};

class JointReader {
 public:
  JointReader(const Deck& deck, const Model& model, const std::vector<RigidBody>& bodies, const World& world,
              Diagnostics& diagnostics)
      : deck_(deck), model_(model), bodies_(bodies), world_(world), diagnostics_(diagnostics) {
    if (const auto* control = deck.last<ControlRigid>()) exact_ = control->lmf == 1;
    for (Index n = 0; n < world.nodes.size(); ++n) node_[world.nodes.id[n]] = n;
    for (std::size_t b = 0; b < bodies.size(); ++b)
      for (const Index n : bodies[b].nodes) body_[n] = b;
  }

  bool exact() const { return exact_; }

  bool read(const JointCard& card, Joint& joint) {
    joint.id = card.id, joint.title = card.title, joint.kind = card.kind(), joint.advance = card.parm;
    read_penalty(card, joint);
    if (is_gear(joint.kind) && card.parm == 0) {
      const bool rack = joint.kind == JointKind::rack_and_pinion;
      deck_.error(diagnostics_, card, "PARM",
                  rack ? "a pinion without a radius does not move its rack" : "wheels without a ratio",
                  rack ? "give how far the rack moves for a turn of the pinion by one radian"
                       : "give R2/R1: how many times as fast the first body turns");
      return false;
    }
    if (joint.kind == JointKind::screw && card.parm == 0) {
      deck_.error(diagnostics_, card, "PARM", "a screw without advance does not tie turning to moving",
                  "give how far it moves for a turn by one radian, or take *CONSTRAINED_JOINT_REVOLUTE");
      return false;
    }
    const std::size_t nodes = 2 * pairs_of(joint.kind);
    for (std::size_t k = 0; k < nodes; ++k)
      if (!read_node(card, k)) return false;
    const bool others = is_motor(joint.kind) || is_gear(joint.kind);  // may be given, tell what is known
    for (std::size_t k = nodes; k < joint_fields.size() && !others; ++k)
      if (card.nodes()[k] != 0)
        deck_.warning(diagnostics_, card, joint_fields[k],
                      fmt::format("a {} joint has {} nodes: it does nothing", joint_name(joint.kind), nodes),
                      "leave it out");
    if (!read_bodies(card, joint, nodes)) return false;
    if (is_motor(joint.kind) && !read_drive(card, joint)) return false;
    return others ? read_apart(card, joint) : read_places(card, joint);
  }

 private:
  /// Of the springs that joints become where they do not fit.
  void read_penalty(const JointCard& card, Joint& joint) {
    constexpr Real undamped = 0.01;  // from there on down LS-DYNA has no damping, but for 0
    joint.rps = card.rps == 0 ? 1 : card.rps;
    joint.damp = card.damp == 0 ? 1 : card.damp <= undamped ? 0 : card.damp;
    const char* why = exact_ ? "LMF 1 of *CONTROL_RIGID asks for joints that hold exactly"
                             : "joints of this kind hold exactly, without a penalty";
    if (joint.rps != 1 && (exact_ || !can_yield(joint)))
      deck_.warning(diagnostics_, card, "RPS", fmt::format("{:g} has no effect: {}", card.rps, why),
                    "leave it out");
    if (joint.damp != 1 && (exact_ || !can_yield(joint)))
      deck_.warning(diagnostics_, card, "DAMP", fmt::format("{:g} has no effect: {}", card.damp, why),
                    "leave it out");
  }

  bool error(const JointCard& card, std::size_t k, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, joint_fields[k], std::move(message), std::move(hint));
    return false;
  }

  bool read_node(const JointCard& card, std::size_t k) {
    const Id id = card.nodes()[k];
    if (id == 0)
      return error(
          card, k,
          fmt::format("a {} joint needs {} nodes", joint_name(card.kind()), 2 * pairs_of(card.kind())),
          "give them in pairs, the first of each on one body, the second on the other");
    const auto node = node_.find(id);
    const auto body = node == node_.end() ? body_.end() : body_.find(node->second);
    if (body == body_.end())
      return error(card, k, fmt::format("node {} is on no rigid body", id),
                   "take corners of rigid elements, or add it by *CONSTRAINED_EXTRA_NODES");
    place_[k] = world_.nodes.x.vec(node->second), on_[k] = body->second;
    return true;
  }

  bool read_bodies(const JointCard& card, Joint& joint, std::size_t nodes) {
    joint.a = on_[0], joint.b = on_[1];
    if (joint.a == joint.b)
      return error(card, 1,
                   fmt::format("nodes {} and {} are on the same rigid body, part {}", card.n1, card.n2,
                               bodies_[joint.a].part),
                   "a joint is between two bodies");
    for (std::size_t k = 2; k < nodes; ++k)
      if (on_[k] != on_[k % 2])
        return error(card, k,
                     fmt::format("node {} is on part {}, and {} on part {}", card.nodes()[k],
                                 bodies_[on_[k]].part, joint_fields[k % 2], bodies_[on_[k % 2]].part),
                     "N1, N3 and N5 belong to the first body, N2, N4 and N6 to the second");
    if (bodies_[joint.a].fixed() && bodies_[joint.b].fixed())
      deck_.warning(diagnostics_, card, "N1",
                    fmt::format("neither part {} nor part {} can move: the joint does nothing",
                                bodies_[joint.a].part, bodies_[joint.b].part),
                    "free one of them, or leave the joint out");
    return true;
  }

  /// Of the smaller body that can move, with its arm: how far away the other one stands does not count. [L]
  Real own_size(const Joint& joint) const {
    Real own = 0;
    bool moves = false;
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
      const RigidBody& b = bodies_[k == 0 ? joint.a : joint.b];
      const Real size = (place_[k] - b.x).norm() + std::sqrt(b.J0.trace() / b.m);
      if (own == 0 || (moves ? !b.fixed() && size < own : !b.fixed())) own = size;
      moves = moves || !b.fixed();
    }
    return own;
  }

  /// Nodes of a pair are at one position but for the rounding of the deck: the middle counts for both, also
  /// where they are a little apart.
  bool meet(const JointCard& card, std::size_t pair, Real size, Vec& middle) {
    constexpr Real rounding = 1e-4, digits = 1e-6,
                   misfit = 0.02;  // of the joint, of coordinates, of the joint
    const Vec &a = place_[2 * pair], &b = place_[2 * pair + 1];
    middle = 0.5 * (a + b);
    const Real gap = (a - b).norm();
    if (gap <= std::max(rounding * size, digits * middle.norm())) return true;
    const std::string message = fmt::format("nodes {} and {} are {:.4g} apart", card.nodes()[2 * pair],
                                            card.nodes()[2 * pair + 1], gap);
    if (gap <= misfit * size && !exact_) {
      deck_.warning(
          diagnostics_, card, joint_fields[2 * pair + 1],
          message + fmt::format(", {:.2g} % of the joint: each body is held in the middle between them",
                                100 * gap / size),
          "give both the same position");
      return true;
    }
    return error(card, 2 * pair + 1, message,
                 "the nodes of a pair must be at the same position at the start");
  }

  /// What slides along its axis may have its nodes anywhere on that. True: they are not at one position, and
  /// all is well; nothing: they are.
  std::optional<bool> read_line(const JointCard& card, const Joint& joint, Real size) {
    constexpr Real rounding = 1e-4, digits = 1e-6;  // as above
    if (joint.kind != JointKind::screw && joint.kind != JointKind::cylindrical) return std::nullopt;
    const Real most = std::max(rounding * size, digits * place_[0].norm());
    const std::size_t pairs = pairs_of(joint.kind);
    bool apart = false;
    for (std::size_t k = 0; k < pairs; ++k)
      apart = apart || (place_[2 * k + 1] - place_[2 * k]).norm() > most;
    if (!apart) return std::nullopt;
    const Vec axis = (place_[2] - place_[0]).normalized();
    const auto across = [&](const Vec& d) { return Vec(d - d.dot(axis) * axis); };
    for (std::size_t k = 1; k < 2 * pairs; k += 2) {
      const Vec& foot = k == 5 ? place_[4] : place_[0];
      if (const Real beside = across(place_[k] - foot).norm(); !(beside <= most))
        return error(
            card, k,
            fmt::format("node {} is {:.4g} beside {}", card.nodes()[k], beside,
                        k == 5 ? fmt::format("the line through {} along the axis", card.n5)
                               : fmt::format("the axis from {} to {}", card.n1, card.n3)),
            "nodes of a pair are at one position at the start, or one behind the other along the axis");
    }
    if ((place_[3] - place_[1]).dot(axis) > 0) return true;
    return error(card, 3,
                 fmt::format("the axis from {} to {} does not point as that from {} to {}", card.n2, card.n4,
                             card.n1, card.n3),
                 "exchange the two");
  }

  bool read_drive(const JointCard& card, Joint& joint) {
    const Curve* curve = curve_named(deck_, model_, card, "LCID", card.lcid, diagnostics_);
    if (!curve) return false;
    joint.drive.kind = static_cast<PrescribedMotion::Kind>(card.type);
    joint.drive.curve = *curve;
    joint.drive.sense = joint.kind == JointKind::rotational_motor ? card.sense : 1;
    const auto& x = curve->abscissa;
    bool jump = false;
    for (std::size_t k = 1; k < x.size(); ++k)
      jump = jump || (x[k] == x[k - 1] && curve->ordinate[k] != curve->ordinate[k - 1]);
    if (!jump || joint.drive.kind != PrescribedMotion::Kind::displacement) return true;
    deck_.error(
        diagnostics_, card, "LCID",
        fmt::format("curve {} jumps, so that displacements would need an infinite velocity", card.lcid),
        "give the jump some time");
    return false;
  }

  /// Gears and motors, whose nodes are at positions of their own.
  bool read_apart(const JointCard& card, Joint& joint) {
    JointPlaces places;
    places.sixth = joint.kind == JointKind::rack_and_pinion && card.n6 != 0;
    if (places.sixth && !read_node(card, 5)) return false;
    places.x = place_, places.size = own_size(joint);
    joint.at_a = place_[0] - bodies_[joint.a].x, joint.at_b = place_[1] - bodies_[joint.b].x;
    const auto fault =
        is_motor(joint.kind) ? place_motor(card, places, joint) : place_gears(card, places, joint);
    return fault ? error(card, fault->node, fault->message, fault->hint) : true;
  }

  bool read_places(const JointCard& card, Joint& joint) {
    const RigidBody &a = bodies_[joint.a], &b = bodies_[joint.b];
    Real size = own_size(joint);
    for (std::size_t k = 2; k < 2 * pairs_of(joint.kind); ++k)
      size = std::max(size, (place_[k] - place_[k % 2]).norm());
    Vec at = place_[0], on_axis = place_[2], beside = Vec::Zero();
    const auto apart = read_line(card, joint, size);
    if (apart && !*apart) return false;
    if (!apart && !meet(card, 0, size, at)) return false;
    joint.at_a = at - a.x, joint.at_b = at - b.x;
    if (pairs_of(joint.kind) == 1) return true;
    if (joint.kind == JointKind::universal) return read_cross(card, joint, size);
    if (!apart && !meet(card, 1, size, on_axis)) return false;
    constexpr Real least = 1e-3;
    const Vec axis = on_axis - at;
    if (!(axis.norm() > least * size))
      return error(
          card, 2,
          fmt::format("nodes {} and {} are at the same position: the joint has no axis", card.n1, card.n3),
          "N1 to N3 is the axis");
    joint.axes_a.col(2) = axis.normalized();
    joint.axes_a.col(0) = Vec(joint.axes_a.col(2)).unitOrthogonal();
    if (pairs_of(joint.kind) == 3) {
      beside = place_[4];
      if (!apart && !meet(card, 2, size, beside)) return false;
      const Vec arm = beside - at, across = arm - arm.dot(Vec(joint.axes_a.col(2))) * joint.axes_a.col(2);
      if (!(across.norm() > least * size))
        return error(card, 4, fmt::format("node {} is on the axis from {} to {}", card.n5, card.n1, card.n3),
                     "N5 and N6 are beside it, and give the rotation of the bodies about it");
      joint.axes_a.col(0) = across.normalized();
    }
    joint.axes_a.col(1) = Vec(joint.axes_a.col(2)).cross(Vec(joint.axes_a.col(0)));
    joint.axes_b = joint.axes_a;
    return true;
  }

  /// The axes of a universal joint, which are at right angles.
  bool read_cross(const JointCard& card, Joint& joint, Real size) {
    constexpr Real least = 1e-3;
    const Vec u = place_[2] - place_[0], w = place_[3] - place_[1];
    for (const auto& [k, axis] : {std::pair(std::size_t{2}, u), std::pair(std::size_t{3}, w)})
      if (!(axis.norm() > least * size))
        return error(card, k,
                     fmt::format("nodes {} and {} are at the same position: the joint has no axis",
                                 card.nodes()[k - 2], card.nodes()[k]),
                     "N1 to N3 is the axis in the first body, N2 to N4 in the second");
    const Real cosine = u.normalized().dot(w.normalized());
    if (std::abs(cosine) > least)
      return error(
          card, 3,
          fmt::format("the axes N1 to N3 and N2 to N4 are not at right angles: cosine {:.4g}", cosine),
          "the arms of the cross of a universal joint are at right angles");
    joint.axes_a.col(2) = u.normalized();
    joint.axes_b.col(2) = (w - w.dot(u.normalized()) * u.normalized()).normalized();
    return true;
  }

  const Deck& deck_;
  const Model& model_;
  const std::vector<RigidBody>& bodies_;
  const World& world_;
  Diagnostics& diagnostics_;
  bool exact_ = false;  ///< LMF 1
  std::map<Id, Index> node_;
  std::map<Index, std::size_t> body_;
  std::array<Vec, 6> place_;
  std::array<std::size_t, 6> on_{};
};

}  // namespace

bool add_joints(const Deck& deck, const Model& model, std::shared_ptr<RigidBodies> bodies, World& world,
                Diagnostics& diagnostics) {
  const auto& cards = deck.all<JointCard>();
  if (cards.empty()) return false;
  const std::vector<RigidBody> none;
  JointReader reader(deck, model, bodies ? bodies->bodies() : none, world, diagnostics);
  std::vector<Joint> joints;
  std::set<Id> taken;
  for (const JointCard& card : cards) taken.insert(card.id);
  Id number = 0;
  bool good = true;
  for (const JointCard& card : cards) {
    Joint joint;
    ++number;
    if (!reader.read(card, joint)) {
      good = false;
      continue;
    }
    // without an id: its number in the deck, unless another joint has that
    for (Id id = number; joint.id == 0; ++id)
      if (taken.insert(id).second) joint.id = id;
    joints.push_back(joint);
  }
  if (!good || !diagnostics.ok()) return true;
  const auto pass = std::make_shared<Joints>(std::move(joints), bodies, reader.exact(), model.tssfac);
  const auto [before, after, worst, misfits] = pass->make_start_consistent(world);
  if (!misfits.empty())
    deck.warning(
        diagnostics, cards[misfits.front()], "",
        "joints of a closed loop, or what holds its bodies, almost say the same twice, and contradict "
        "each other a little: the joints of this mechanism are penalty springs, which open a little",
        "make axes parallel and positions equal to all digits; take spherical and cylindrical joints "
        "where revolute ones say the same twice; or ask for exact joints by LMF 1 of *CONTROL_RIGID");
  constexpr Real rounding = 1e-6, of_rest_energy = 1e-20;  // below: no motion that anybody gave
  const bool fits = std::abs(before - after) <=
                    std::max(rounding * std::max(before, after), of_rest_energy * bodies->rest_energy());
  const bool motors = std::any_of(pass->all().begin(), pass->all().end(),
                                  [](const Joint& joint) { return is_motor(joint.kind); });
  if (motors && !fits)
    deck.warning(
        diagnostics, cards[worst], "",
        fmt::format("velocities at the start do not fit the joints and motors: kinetic energy [ML2/T2] "
                    "changes from {:.4g} to {:.4g} at once",
                    before, after),
        "give the bodies velocities that fit, or let the curve of the motor begin with what they have");
  else if (!fits)
    deck.warning(
        diagnostics, cards[worst], "",
        before > after
            ? fmt::format("velocities at the start do not fit the joints: {:.4g} of {:.4g} of kinetic "
                          "energy [ML2/T2] is lost, as in a plastic impact",
                          before - after, before)
            : fmt::format("velocities at the start do not fit the joints: prescribed motions give "
                          "{:.4g} of kinetic energy [ML2/T2] at once, to {:.4g} at the start",
                          after - before, before),
        "give the bodies velocities with which the nodes of joints move together");
  bodies->tie(pass.get());
  world.passes.add(pass);
  return true;
}

}  // namespace courant
