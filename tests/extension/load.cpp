// *LOAD_EXAMPLE_WIND: drag on a part towards the velocity of a wind, in proportion to the mass.
#include <cmath>
#include <limits>

#include "extension/additions.hpp"
#include "extension/compiled_against.hpp"
#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"
#include "loads/loads.hpp"
#include "loads/middle_velocity.hpp"

namespace {

using namespace courant;

struct Card : Entry {
  Id pid = 0;
  Real coeff = 0, vx = 0, vy = 0, vz = 0;
};

const RegisterKeyword<Card> keyword{
    {.names = {"LOAD_EXAMPLE_WIND"},
     .purpose = "force m COEFF (V - v) on what belongs to a part",
     .cards = {
         {.fields = {
              {"PID", &Card::pid, "-", "part id", rules::required_id_of(IdSpace::part)},
              {"COEFF", &Card::coeff, "1/T", "drag per mass", {.required = true, .check = Check::positive}},
              {"VX", &Card::vx, "L/T", "wind", rules::direction},
              {"VY", &Card::vy, "L/T", "wind"},
              {"VZ", &Card::vz, "L/T", "wind"}}}}}};

class Wind : public Force, public TimeLimit, public EnergyTerm {
 public:
  Wind(Points points, Index part, Real coeff, const Vec& velocity)
      : points_(points), part_(part), coeff_(coeff), velocity_(velocity) {}
  std::string name() const override { return "wind on " + points_.fields().name(); }
  const FieldSet& over(const World&) const override { return points_.fields(); }
  void declare(const World&, Accesses& a) const override {
    a.reads(*points_.v).reads(*points_.m).reads(*points_.part).updates(*points_.f);
  }
  void block(World&, const Clock&, Index begin, Index end) override {
    for (Index i = begin; i < end; ++i)
      if ((*points_.part)[i] == part_) points_.f->add(i, force(i));
  }

  // A longer step would overshoot the wind.
  Limit limit(const World&, const Clock&) override { return {1 / coeff_, name()}; }

  void record(World& world, const Clock& clock, EnergyLedger& ledger) override {
    const MiddleVelocity v(points_, clock);
    const auto work_on = [&](Index i) {
      return (*points_.part)[i] == part_ ? force(i).dot(v(i)) * clock.dt_mean() : 0;
    };
    const Index n = loaded_points(points_, world);
    ledger.external_work += sum(n, work_on);
    ledger.throughput += sum(n, [&](Index i) { return std::abs(work_on(i)); });
  }
  void sample(const World&, const Clock&, EnergyLedger&) const override {}

 private:
  /// [ML/T2]
  Vec force(Index i) const { return (*points_.m)[i] * coeff_ * (velocity_ - points_.v->vec(i)); }
  Points points_;
  Index part_;
  Real coeff_;
  Vec velocity_;
};

const RegisterAddition added{
    "wind", [](const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics) {
      for (const Card& card : deck.all<Card>()) {
        const auto part = model.part_of_id.find(card.pid);
        if (part == model.part_of_id.end() || model.parts[static_cast<std::size_t>(part->second)].has_shell) {
          deck.error(diagnostics, card, "PID", "expected a part of particles or solids");
          continue;
        }
        const bool particles = model.parts[static_cast<std::size_t>(part->second)].has_sph;
        world.passes.add(std::make_shared<Wind>(
            particles ? points_of(world.particles) : points_of(world.nodes), part->second, card.coeff,
            Vec(card.vx, card.vy, world.dim == 3 ? card.vz : 0)));
      }
    }};

}  // namespace
