// *CONSTRAINED_JOINT_STIFFNESS_GENERALIZED.
#include <fmt/format.h>

#include <cmath>

#include <optional>

#include "keyword/registry.hpp"
#include "model/definitions/named_curve.hpp"
#include "rigid/bodies/rigid_cards.hpp"
#include "rigid/joints/joint_stiffness_pass.hpp"

namespace courant {

namespace {

using S = JointStiffnessCard;

const RegisterKeyword<S> joint_stiffness_keyword{constrained_joint_stiffness_generalized_table()};

class StiffnessReader {
 public:
  StiffnessReader(const Deck& deck, const Model& model, const std::vector<RigidBody>& bodies,
                  Diagnostics& diagnostics)
      : deck_(deck), model_(model), bodies_(bodies), diagnostics_(diagnostics) {}

  std::optional<JointStiffness> read(const S& card) {
    const auto a = body(card, "PIDA", card.pida), b = body(card, "PIDB", card.pidb);
    const auto axes_a = axes(card, "CIDA", card.cida);
    const auto axes_b = card.cidb == 0 ? axes_a : axes(card, "CIDB", card.cidb);
    if (!a || !b || !axes_a || !axes_b) return std::nullopt;
    if (*a == *b)
      return error(card, "PIDB",
                   card.pida == card.pidb ? fmt::format("the same part {} twice", card.pida)
                                          : fmt::format("parts {} and {} are one body", card.pida, card.pidb),
                   "name the other body of the joint");
    JointStiffness out{.id = card.jsid, .a = *a, .b = *b, .axes_a = *axes_a, .axes_b = *axes_b};
    const bool good = resistance(card, {"LCIDPH", "DLCIDPH", "ESPH"}, card.lcidph, card.dlcidph, card.esph,
                                 card.fmph, card.nsaph, card.psaph, out.about[0]) &&
                      resistance(card, {"LCIDT", "DLCIDT", "EST"}, card.lcidt, card.dlcidt, card.est,
                                 card.fmt, card.nsat, card.psat, out.about[1]) &&
                      resistance(card, {"LCIDPS", "DLCIDPS", "ESPS"}, card.lcidps, card.dlcidps, card.esps,
                                 card.fmps, card.nsaps, card.psaps, out.about[2]);
    if (!good) return std::nullopt;
    const JointAngles start = angles_of(out, bodies_[out.a].q, bodies_[out.b].q);
    for (std::size_t k = 0; k < 3; ++k) out.about[k].angle = start.angle[k];
    return out;
  }

 private:
  std::nullopt_t error(const S& card, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
    return std::nullopt;
  }
  std::optional<std::size_t> body(const S& card, const char* field, Id part) {
    const auto index = model_.part_of_id.find(part);
    for (std::size_t k = 0; k < bodies_.size() && index != model_.part_of_id.end(); ++k)
      if (bodies_[k].has_part(index->second)) return k;
    return error(card, field, fmt::format("part {} is no rigid body", part),
                 "its material must be a *MAT_RIGID");
  }
  std::optional<Matrix> axes(const S& card, const char* field, Id id) {
    if (id == 0) return Matrix::Identity();
    const auto system = model_.coordinate_systems.find(id);
    if (system == model_.coordinate_systems.end())
      return error(card, field, fmt::format("coordinate system {} does not exist", id),
                   "define it with *DEFINE_COORDINATE_SYSTEM");
    return system->second.axes;
  }
  bool curve(const S& card, const char* field, Id id, Curve& out) {
    if (id == 0) return true;
    const Curve* found = curve_named(deck_, model_, card, field, id, diagnostics_);
    if (found) out = *found;
    return found != nullptr;
  }
  bool resistance(const S& card, const std::array<const char*, 3>& fields, Id lcid, Id dlcid, Real es,
                  Real fm, Real low, Real high, AngleResistance& out) {
    if (!curve(card, fields[0], lcid, out.stiffness) || !curve(card, fields[1], dlcid, out.damping))
      return false;
    out.low = low * pi / 180, out.high = high * pi / 180;
    const bool stops = low < 0 || high > 0;
    if ((fm > 0 || stops) && !(es > 0)) {
      error(card, fields[2], "friction and stops need a stiffness", "give it a value above 0");
      return false;
    }
    out.friction = fm;
    out.elastic = fm > 0 || stops ? es : 0;
    return true;
  }

  const Deck& deck_;
  const Model& model_;
  const std::vector<RigidBody>& bodies_;
  Diagnostics& diagnostics_;
};

}  // namespace

/// Angles are about axes that go with the file only where a system gives them, and change their signs in a
/// mirror.
std::string turn_stiffness(JointStiffnessCard& card, const Affine& motion) {
  constexpr Real round_off = 1e-9;
  const Matrix A = motion.linear();
  if (A.determinant() < 0) return "its angles would change their sign in a mirror";
  const Matrix stretch = A.transpose() * A;
  const bool turned = (A / std::cbrt(A.determinant()) - Matrix::Identity()).norm() > round_off;
  if (turned &&
      (card.cida == 0 || (stretch - stretch(0, 0) * Matrix::Identity()).norm() > round_off * stretch(0, 0)))
    return "its angles are about the global axes (CIDA 0), which do not turn with the file: give it a "
           "coordinate system";
  return {};
}

bool add_joint_stiffness(const Deck& deck, const Model& model, std::shared_ptr<RigidBodies> bodies,
                         World& world, Diagnostics& diagnostics) {
  const auto& cards = deck.all<JointStiffnessCard>();
  if (cards.empty()) return false;
  const std::vector<RigidBody> none;
  StiffnessReader reader(deck, model, bodies ? bodies->bodies() : none, diagnostics);
  std::vector<JointStiffness> all;
  for (const JointStiffnessCard& card : cards)
    if (const auto one = reader.read(card)) all.push_back(*one);
  if (all.size() == cards.size())
    world.passes.add(std::make_shared<JointStiffnesses>(std::move(all), bodies));
  return true;
}

}  // namespace courant
