#include "app/run/momentum_watch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "elements/discrete/cards_discrete.hpp"
#include "elements/mass_scaling.hpp"
#include "extension/builders.hpp"
#include "extension/part_values.hpp"
#include "rigid/bodies/rigid.hpp"

namespace courant {

namespace {

/// Begins of the names of keywords that push nothing from outside.
constexpr std::array inside{"KEYWORD",
                            "TITLE",
                            "NODE",
                            "ELEMENT_",
                            "PART",
                            "SECTION_",
                            "MAT_",
                            "EOS_",
                            "HOURGLASS",
                            "INITIAL_",
                            "CONTACT_",
                            "DEFINE_",
                            "SET_",
                            "DATABASE_",
                            "CONTROL_",
                            "INCLUDE",
                            "PARAMETER",
                            "COMMENT",
                            "CONSTRAINED_",
                            "DAMPING_PART_STIFFNESS",
                            "DEFORMABLE_TO_RIGID",
                            "END",
                            "COURANT_OUTPUT",
                            "COURANT_SUBCYCLE",
                            "COURANT_VERDICT",
                            "INTEGRATION_"};
/// Those of the same beginnings that do.
constexpr std::array outside{"CONSTRAINED_GLOBAL", "CONTROL_DYNAMIC_RELAXATION", "DEFINE_SPH_"};

constexpr std::array weights{"LOAD_BODY_X", "LOAD_BODY_Y", "LOAD_BODY_Z", "LOAD_BODY_PARTS", "LOAD_GRAVITY"};

template <std::size_t n>
bool begins_with_one_of(std::string_view name, const std::array<const char*, n>& begins) {
  return std::any_of(begins.begin(), begins.end(), [&](const char* one) { return name.starts_with(one); });
}

bool held(const std::array<bool, 3>& axes) {
  return axes[0] || axes[1] || axes[2];
}

/// Whether nothing outside acts on what moves: the deck has only keywords that describe bodies, their
/// materials, contacts and constraints among them, and outputs; nothing is held or driven.
/// `weight`: its own may act.
bool is_free_system(const Deck& deck, const Model& model, const RigidBodies* bodies, bool weight) {
  if (model.phase == RunPhase::relaxation) return false;
  for (const auto& [name, use] : deck.keywords) {
    const bool weighs = weight && begins_with_one_of(name, weights);
    if (!weighs && (!begins_with_one_of(name, inside) || begins_with_one_of(name, outside))) return false;
  }
  for (const ModelNode& node : model.nodes)
    if (held(node.fixed)) return false;
  if (bodies)
    for (const RigidBody& b : bodies->bodies())
      if (held(b.held) || held(b.no_turn) || !b.motions.empty()) return false;
  for (const ElementDiscreteCard& spring : deck.all<ElementDiscreteCard>())
    if (spring.n2 == 0) return false;
  const MassScaling scaling = mass_scaling_of(deck);
  return scaling.step == 0 || scaling.once;
}

void watch_momentum(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                    const BodyPasses&, const std::shared_ptr<RigidBodies>& bodies) {
  const bool free = is_free_system(deck, model, bodies.get(), false);
  world.passes.add(std::make_shared<MomentumWatch>(free));
  const bool touches = std::any_of(deck.keywords.begin(), deck.keywords.end(),
                                   [](const auto& one) { return one.first.starts_with("CONTACT_"); });
  if (!model.body_loads.empty() && !free && !touches && is_free_system(deck, model, bodies.get(), true))
    diagnostics.note(deck.location(0, 1, 1),
                     "body loads act, and nothing holds what they move: all of it falls freely",
                     "hold it by *BOUNDARY_SPC, *MAT_RIGID or a wall, unless it should fall");
}

const RegisterBuilder watch(BuildPhase::body_passes, "momentum", watch_momentum, Errors::go_on);

}  // namespace

// Momenta are of v^{n-1/2}: what acts among parts changes no sum, whatever the step.
void MomentumWatch::look(const Sample& s, World& world) {
  if (!free_ || world.particles.active != world.particles.size()) return;
  const Vec now = s.mass * s.velocity;
  if (!began_) began_ = true, mass_ = s.mass, first_ = now;
  constexpr Real same = 1e-9;
  if (!(std::abs(s.mass - mass_) <= same * mass_)) return;  // some has gone: it took its momentum along
  Real of_parts = 0;
  for (const PartSample& part : s.parts) of_parts += part.momentum.norm();
  most_ = std::max(most_, of_parts);
  change_ = std::max(change_, (now - first_).norm());
  constexpr Real tiny = 1e-6;
  const bool round_off = change_ <= tiny * std::sqrt(2 * mass_ * s.energy.scale());
  world.maxima["momentum_change_share"] = round_off || !(most_ > 0) ? 0 : change_ / most_;
}

void MomentumWatch::keep(Archive& archive) {
  archive("began", began_);
  archive("mass", mass_);
  archive("most", most_);
  archive("change", change_);
  archive("first", first_);
}

}  // namespace courant
