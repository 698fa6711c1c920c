// *TERMINATION_BODY: ends of runs by how far bodies have moved.
#include <fmt/format.h>

#include "extension/additions.hpp"
#include "keyword/registry.hpp"
#include "rigid/bodies/rigid.hpp"
#include "rigid/bodies/rigid_cards.hpp"
#include "state/ending.hpp"

namespace courant {

namespace {

constexpr Real never = 1e21;
constexpr int by_magnitude = 4;

const RegisterKeyword<TerminationBody> termination_body{termination_body_table()};

class EndAtBody : public Ending {
 public:
  /// Refers to `bodies`.
  EndAtBody(const TerminationBody& card, const RigidBodies& bodies, std::size_t body)
      : card_(card), bodies_(bodies), body_(body) {}
  std::string name() const override { return "end at a rigid body"; }
  std::optional<std::string> ended(const World&, const Clock&) const override {
    const RigidBody& b = bodies_.bodies()[body_];
    const Vec way = b.x - b.x0;
    const bool all = card_.stop == by_magnitude;
    const Real moved = all ? way.norm() : way[card_.stop - 1];
    const bool above = moved >= card_.maxc;
    if (!above && (all || moved > card_.minc)) return std::nullopt;
    return fmt::format("{} has moved by {:.6g}{}: {} = {:.6g} of *TERMINATION_BODY", b.name, moved,
                       all ? "" : std::string(" along ") + "xyz"[card_.stop - 1], above ? "MAXC" : "MINC",
                       above ? card_.maxc : card_.minc);
  }

 private:
  TerminationBody card_;
  const RigidBodies& bodies_;
  std::size_t body_;
};

const RegisterAddition end_at_body{
    "*TERMINATION_BODY", [](const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics) {
      const auto all = world.passes.all<const RigidBodies>();
      for (const TerminationBody& card : deck.all<TerminationBody>()) {
        const auto part = model.part_of_id.find(card.pid);
        bool found = false;
        for (const RigidBodies* bodies : all)
          for (std::size_t k = 0; k < bodies->bodies().size(); ++k) {
            const RigidBody& b = bodies->bodies()[k];
            const bool named =
                b.part == card.pid || (part != model.part_of_id.end() && b.has_part(part->second));
            if (!named || b.fixed()) continue;
            found = true;
            world.passes.add(std::make_shared<EndAtBody>(card, *bodies, k));
          }
        if (!found)
          deck.error(diagnostics, card, "PID",
                     fmt::format("part {} is no rigid body that can move", card.pid),
                     "name a part of *MAT_RIGID that is not held in every direction");
        if (card.maxc < 0 || card.minc > 0)
          deck.error(diagnostics, card, card.maxc < 0 ? "MAXC" : "MINC", "the body is there at the start",
                     "give MAXC above 0, MINC below 0, or leave them out");
        if (card.stop == by_magnitude && card.minc != -never)
          deck.warning(diagnostics, card, "MINC", "has no meaning for STOP 4", "leave it out");
        if (card.maxc == never && (card.minc == -never || card.stop == by_magnitude))
          deck.warning(diagnostics, card, "MAXC", "without bounds it does nothing", "give MAXC or MINC");
      }
    }};

}  // namespace

std::string keep_direction(TerminationBody& card, const Affine& motion) {
  const Matrix A = motion.linear();
  if (card.stop == by_magnitude && (A.transpose() * A).isApprox(Matrix::Identity(), 1e-12)) return {};
  if (A.isApprox(Matrix::Identity(), 1e-12)) return {};
  return "displacements along axes do not turn, nor stretch, with a file";
}

}  // namespace courant
