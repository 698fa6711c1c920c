// *BOUNDARY_PRESCRIBED_ORIENTATION_RIGID
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "extension/builders.hpp"
#include "extension/part_values.hpp"
#include "keyword/registry.hpp"
#include "model/definitions/named_curve.hpp"
#include "rigid/bodies/mat_rigid.hpp"
#include "rigid/bodies/rigid.hpp"

namespace courant {

namespace {

using PO = PrescribedOrientation;
using Quaternion = Eigen::Quaterniond;

const RegisterKeyword<PO> by_cosines{boundary_prescribed_orientation_rigid_dircos_table()};
const RegisterKeyword<PO> by_angles{boundary_prescribed_orientation_rigid_angles_table()};
const RegisterKeyword<PO> by_parameters{boundary_prescribed_orientation_rigid_eulerp_table()};

/// Curves of a card, and the orientation that they give: of the axes of the body against the global ones.
struct Orientation {
  enum class By { cosines, angles, parameters } by = By::cosines;
  std::vector<Curve> curves{};
  std::array<int, 3> sequence{0, 1, 2};  ///< axes of the rotations
  bool about_body = false;
  Real offset = 0;                   ///< time at which the curves begin [T]
  Matrix axes = Matrix::Identity();  ///< of the body at the start, as columns

  /// From the orientation of the body at the start.
  Quaternion at(Real t) const { return Quaternion(Matrix(against_global(t - offset) * axes.transpose())); }
  bool silent() const {
    return std::any_of(curves.begin(), curves.end(), [](const Curve& c) { return c.silent; });
  }

 private:
  Matrix against_global(Real t) const {
    if (by == By::angles) {
      Matrix out = Matrix::Identity();
      for (std::size_t k = 0; k < 3; ++k) {
        const Matrix turn = Eigen::AngleAxisd(curves[k](t), Vec::Unit(sequence[k])).toRotationMatrix();
        out = about_body ? Matrix(out * turn) : Matrix(turn * out);
      }
      return out;
    }
    if (by == By::parameters)
      return Quaternion(curves[3](t), curves[0](t), curves[1](t), curves[2](t))
          .normalized()
          .toRotationMatrix();
    Matrix C;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) C(i, j) = curves[static_cast<std::size_t>(3 * i + j)](t);
    // between points of the curves the cosines are no rotation: the nearest one, by Newton's iteration
    constexpr int most = 20;
    for (int k = 0; k < most; ++k) C = 0.5 * (C + C.inverse().transpose());
    return C;
  }
};

/// The angular velocity that brings a body to its orientation at the end of the coming step.
class OrientedBody : public Impact, public MotionSource {
 public:
  OrientedBody(Orientation orientation, std::shared_ptr<const RigidBodies> bodies, std::size_t body)
      : orientation_(std::move(orientation)), bodies_(std::move(bodies)), body_(body) {}
  std::string name() const override {
    return fmt::format("orientation of {}", bodies_->bodies()[body_].name);
  }
  void strike(World&, const Clock& clock) override {
    Quaternion turn = orientation_.at(clock.t + clock.dt) * bodies_->bodies()[body_].q.conjugate();
    if (turn.w() < 0) turn.coeffs() = -turn.coeffs();  // the shorter path
    const Real sine = turn.vec().norm();
    const Real angle = 2 * std::atan2(sine, turn.w());
    omega_ = sine > 0 && clock.dt > 0 ? Vec(angle / (sine * clock.dt) * turn.vec()) : Vec(Vec::Zero());
  }
  Real velocity(int component) const override { return component < 3 ? 0 : omega_[component - 3]; }

 private:
  Orientation orientation_;
  std::shared_ptr<const RigidBodies> bodies_;
  std::size_t body_;
  Vec omega_ = Vec::Zero();
};

class OrientationBuilder {
 public:
  OrientationBuilder(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                     std::shared_ptr<RigidBodies>& bodies)
      : deck_(deck), model_(model), world_(world), diagnostics_(diagnostics), bodies_(bodies) {}

  void add(const PO& card) {
    const int errors = diagnostics_.errors();
    const std::optional<std::size_t> body = body_of(card);
    Orientation orientation = read(card);
    if (diagnostics_.errors() > errors || !body || orientation.silent()) return;
    const RigidBody& b = bodies_->bodies()[*body];
    if (const MatRigid* m = mat_rigid_of(deck_, model_.parts[static_cast<std::size_t>(b.part_index)].mid))
      if (const auto axes = axes_of_material(*m, model_)) orientation.axes = *axes;
    constexpr Real same = 1e-3;
    const Real jump = orientation.at(card.birth).angularDistance(b.q);
    if (card.birth == 0 && jump > same)
      return error(
          card, "PIDB", fmt::format("the orientation at the start is {:.4g} rad from that of the body", jump),
          "let the curves begin with the axes of the body: LCO of its *MAT_RIGID, else the global ones");
    auto pass = std::make_shared<OrientedBody>(std::move(orientation), bodies_, *body);
    bodies_->turn(*body, *pass, card.birth, card.death, card);
    world_.passes.add(pass);
  }

 private:
  void error(const PO& card, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
  }
  std::optional<std::size_t> body_of(const PO& card) {
    for (std::size_t k = 0; bodies_ && k < bodies_->bodies().size(); ++k) {
      const RigidBody& b = bodies_->bodies()[k];
      if (b.part != card.pidb || b.part_index < 0) continue;
      const bool held = b.no_turn != std::array<bool, 3>{};
      const bool driven = std::any_of(b.motions.begin(), b.motions.end(), [&](const PrescribedMotion& m) {
        return m.turns && m.birth < card.death && card.birth < m.death;
      });
      if (held || driven)
        error(card, "PIDB",
              fmt::format("{} {}", b.name,
                          held ? "cannot turn, as CON2 of its *MAT_RIGID, or the "
                                 "plane of a 2D scene, holds it"
                               : "is turned by another prescribed motion, too"),
              held ? "free its rotations" : "leave out one of the two");
      return k;
    }
    error(card, "PIDB", fmt::format("part {} is no rigid body", card.pidb),
          "it needs elements and a *MAT_RIGID");
    return std::nullopt;
  }

  Orientation read(const PO& card) {
    Orientation out;
    const std::string name = deck_.keyword(card);
    const auto take = [&](const char* field, Id id) {
      if (const Curve* curve = curve_named(deck_, model_, card, field, id, diagnostics_))
        out.curves.push_back(*curve);
    };
    if (name.find("ANGLES") != name.npos) {
      out.by = Orientation::By::angles;
      take("LCIDQ1", card.lcidq1), take("LCIDQ2", card.lcidq2), take("LCIDQ3", card.lcidq3);
      out.about_body = card.body == 1;
      const int axis[] = {card.iseq / 100, card.iseq / 10 % 10, card.iseq % 10};
      const bool three = std::all_of(axis, axis + 3, [](int k) { return k >= 1 && k <= 3; });
      if (!three || axis[0] == axis[1] || axis[1] == axis[2])
        error(card, "ISEQ", fmt::format("'{}' is not supported", card.iseq),
              "three of 1, 2, 3, as 123 or 313");
      else
        for (std::size_t k = 0; k < 3; ++k) out.sequence[k] = axis[k] - 1;
    } else if (name.find("EULERP") != name.npos) {
      out.by = Orientation::By::parameters;
      take("LCIDE1", card.lcide1), take("LCIDE2", card.lcide2), take("LCIDE3", card.lcide3);
      take("LCIDE4", card.lcide4);
    } else {
      take("LCIDC11", card.lcidc11), take("LCIDC12", card.lcidc12), take("LCIDC13", card.lcidc13);
      take("LCIDC21", card.lcidc21), take("LCIDC22", card.lcidc22), take("LCIDC23", card.lcidc23);
      take("LCIDC31", card.lcidc31), take("LCIDC32", card.lcidc32), take("LCIDC33", card.lcidc33);
    }
    out.offset = card.toffset == 1 ? card.birth : 0;
    return out;
  }

  const Deck& deck_;
  const Model& model_;
  World& world_;
  Diagnostics& diagnostics_;
  std::shared_ptr<RigidBodies>& bodies_;
};

void orient_bodies(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                   std::shared_ptr<RigidBodies>& bodies) {
  const auto& cards = deck.all<PO>();
  if (cards.empty()) return;
  OrientationBuilder builder(deck, model, world, diagnostics, bodies);
  for (const PO& card : cards) builder.add(card);
}

const RegisterBuilder orientations(BuildPhase::body_passes, "orientation of bodies", orient_bodies);

}  // namespace

std::string keep_orientation(PrescribedOrientation&, const Affine& motion) {
  if (motion.linear() == Matrix::Identity()) return {};
  return "its orientation is against the global axes, which a transformation that turns the file would "
         "change";
}

}  // namespace courant
