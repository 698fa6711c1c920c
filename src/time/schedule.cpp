#include "time/schedule.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "time/access_check.hpp"
#include "time/inner_schedule.hpp"

namespace courant {

namespace {

using When = Access::When;

bool of_others(const Access& a, const FieldSet& over) {
  return a.reach == Reach::others || a.what->set() != over.name();
}

enum class Need { nothing, wait, stage };

/// What the access `now` of a pass needs behind the access `before` of an earlier pass of the open stage.
/// `waited`: threads have waited for each other in between.
Need need_of(const Access& before, const FieldSet& over_before, const Access& now, const FieldSet& over_now,
             bool waited) {
  if (before.what != now.what || !(before.changes() || now.changes())) return Need::nothing;
  if (before.when == When::finish) return now.when == When::finish ? Need::nothing : Need::stage;
  if (now.when == When::finish) return Need::nothing;
  if (now.when == When::start) return before.when == When::start ? Need::nothing : Need::stage;
  if (before.when == When::start || waited) return Need::nothing;
  const bool foreign =
      (before.changes() && of_others(now, over_now)) || (now.changes() && of_others(before, over_before));
  return foreign ? Need::wait : Need::nothing;
}

void stop_for_foreign_change(const StagePlan::Entry& e) {
  for (const Access& a : e.accesses.all())
    if (a.changes() && a.when == When::block && a.what->field() && a.what->set() != e.over->name())
      throw std::logic_error(fmt::format("pass '{}' works on {} and changes {} of {}", e.pass->name(),
                                         e.over->name(), a.what->name(), a.what->set()));
}

class Planner {
 public:
  Planner(const World& world, bool has_ghosts, bool inner)
      : world_(world), subcycle_(Subcycle::of(world)), has_ghosts_(has_ghosts), inner_(inner) {}

  std::vector<StagePlan> plan(const std::vector<Phase>& phases) {
    std::vector<StagePlan> stages(1);
    std::size_t part = 0;  // first entry behind the last wait
    for (const Phase phase : phases)
      for (BlockPass* pass : world_.passes.in_phase(phase, world_)) {
        const bool slow = subcycle_ && subcycle_->is_slow(*pass);
        if (slow && inner_) continue;
        StagePlan::Entry entry{
            slow ? subcycle_->in_stead_of(*pass) : pass, &pass->over(world_), {}, false, {}};
        pass->declare(world_, entry.accesses);
        if (pass->name() == left_out_declaration().first) entry.accesses.drop(left_out_declaration().second);
        stop_for_foreign_change(entry);
        add(std::move(entry), stages, part);
      }
    if (stages.back().entries.empty()) stages.pop_back();
    return stages;
  }

 private:
  void add(StagePlan::Entry entry, std::vector<StagePlan>& stages, std::size_t& part) {
    Need need = Need::nothing;
    const StagePlan& open = stages.back();
    for (std::size_t k = 0; k < open.entries.size(); ++k)
      for (const Access& before : open.entries[k].accesses.all())
        for (const Access& now : entry.accesses.all()) {
          const Need one = need_of(before, *open.entries[k].over, now, *entry.over, k < part);
          if (static_cast<int>(one) <= static_cast<int>(need)) continue;
          need = one;
          entry.why = fmt::format("{} of {}", now.what->name(), open.entries[k].pass->name());
        }
    const std::vector<const Resource*> stale = take_stale(entry);
    for (const Resource* r : stale)  // what changed before the stage is exchanged before it
      if (need != Need::stage && changes(open, *r)) need = Need::stage, entry.why = "ghost particles";
    if (need == Need::stage) stages.emplace_back(), part = 0;
    StagePlan& stage = stages.back();
    if (need == Need::wait) entry.waits = true, part = stage.entries.size();
    stage.exchange.insert(stage.exchange.end(), stale.begin(), stale.end());
    for (const Access& a : entry.accesses.all())
      if (a.changes()) stale_.insert(a.what);
    stage.entries.push_back(std::move(entry));
  }

  static bool changes(const StagePlan& stage, const Resource& resource) {
    for (const StagePlan::Entry& entry : stage.entries)
      for (const Access& a : entry.accesses.all())
        if (a.changes() && a.what == &resource) return true;
    return false;
  }

  /// What the pass reads of others and ghosts do not have yet.
  std::vector<const Resource*> take_stale(const StagePlan::Entry& entry) {
    std::vector<const Resource*> out;
    if (!has_ghosts_) return out;
    for (const Access& a : entry.accesses.all())
      if (!a.changes() && a.reach == Reach::others && a.what->field() && a.what->field()->info().exchange &&
          stale_.erase(a.what) > 0)
        out.push_back(a.what);
    return out;
  }

  const World& world_;
  const Subcycle* subcycle_;
  bool has_ghosts_, inner_;
  std::set<const Resource*> stale_;  ///< changed since their ghosts were
};

}  // namespace

namespace {

Schedule make(const World& world, bool inner) {
  Planner planner(world, !world.passes.all<Exchanger>().empty(), inner);
  const std::vector<Phase> before{Phase::rates, Phase::laws, Phase::reductions, Phase::forces,
                                  Phase::constraints};
  const std::vector<Phase> after{Phase::drive, Phase::motion, Phase::relocation, Phase::preparation};
  planner.plan(before), planner.plan(after);  // a step before states what is stale at the start of one
  Schedule out;
  out.forces = planner.plan(before);
  out.motion = planner.plan(after);
  return out;
}

}  // namespace

Schedule make_schedule(const World& world) {
  return make(world, false);
}

std::vector<StagePlan> make_inner_forces(const World& world) {
  return make(world, true).forces;
}

std::string conflict_with_slow(const World& world, const Subcycle& subcycle) {
  std::set<const Resource*> left;
  std::vector<std::pair<const BlockPass*, Accesses>> of_each_step;
  for (const BlockPass* pass : world.passes.all<BlockPass>()) {
    Accesses accesses;
    pass->declare(world, accesses);
    if (!subcycle.is_slow(*pass)) {
      of_each_step.emplace_back(pass, std::move(accesses));
      continue;
    }
    for (const Access& a : accesses.all())
      if (a.changes()) left.insert(a.what);
  }
  for (const auto& [pass, accesses] : of_each_step)  // what each step begins with
    for (const Access& a : accesses.all())
      if (a.mode == Access::Mode::writes) left.erase(a.what);
  for (const auto& [pass, accesses] : of_each_step)
    for (const Access& a : accesses.all())
      if (a.changes() && left.contains(a.what))
        return fmt::format("{} changes {} in each step", pass->name(), a.what->name());
  return {};
}

std::string text_of(const Schedule& schedule) {
  std::string text;
  int number = 0;
  const auto list = [&](const std::vector<StagePlan>& stages) {
    for (const StagePlan& stage : stages) {
      std::string names;
      for (const Resource* r : stage.exchange) names += (names.empty() ? "" : ", ") + r->name();
      text += fmt::format("  stage {}{}\n", ++number,
                          names.empty() ? "" : fmt::format(" (ghost particles get {})", names));
      for (const StagePlan::Entry& e : stage.entries) {
        if (e.waits) text += fmt::format("    -- threads wait: {}\n", e.why);
        text += fmt::format("    {:<13}{:<28}{}\n", name_of(e.pass->phase()), e.pass->name(), e.over->name());
      }
    }
  };
  list(schedule.forces);
  text += "  time step, outputs, energy balance\n";
  list(schedule.motion);
  return text;
}

}  // namespace courant
