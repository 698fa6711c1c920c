// What follows for the world where elements are deleted.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_set>
#include <utility>

#include "base/run_error.hpp"
#include "base/solid_faces.hpp"
#include "elements/erosion.hpp"
#include "state/restartable.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

using shared_fields::deleted, shared_fields::hidden;

/// Faces of solids between elements, by their corners.
class SolidFaces {
 public:
  /// Marks faces of a deleted element, and lays bare what it covered.
  void erode(Segments& g, Field<Index>& eroded, Id element, Index part) {
    if (of_element_.empty()) list(g);
    const auto own = of_element_.find({part, element});
    if (own == of_element_.end()) return;
    for (const Index s : own->second) {
      eroded[s] = deleted;
      for (const Index other : at_.at(key(g, s)))
        if (eroded[other] == hidden) eroded[other] = 0;
    }
  }

 private:
  using Key = std::array<Index, 5>;  ///< part and sorted corners
  static Key key(const Segments& g, Index s) {
    const std::array<Index, 4> n = sorted_corners(g.nodes(s));
    return {g.part[s], n[0], n[1], n[2], n[3]};
  }
  void list(const Segments& g) {
    for (Index s = 0; s < g.size(); ++s) {
      if (!(g.volume[s] > 0)) continue;
      of_element_[{g.part[s], g.id[s]}].push_back(s);
      at_[key(g, s)].push_back(s);
    }
  }
  std::map<std::pair<Index, Id>, std::vector<Index>> of_element_;
  std::map<Key, std::vector<Index>> at_;
};

class DeletedElements : public Reduction, public TimeLimit, public FailureReporter, public Restartable {
 public:
  DeletedElements(std::vector<std::shared_ptr<Erosion>> groups, Real dtmin, const World& world)
      : groups_(std::move(groups)),
        dtmin_(dtmin),
        eroded_(*shared_fields::eroded.find(world.segments.fields)) {}
  std::string name() const override { return "deleted elements"; }
  const FieldSet& over(const World& world) const override { return world.segments.fields; }
  void declare(const World& world, Accesses& a) const override {
    a.in_finish().updates(eroded_);
    for (const auto& group : groups_) group->declare_booking(a);
    const Segments& g = world.segments;
    for (const auto* corner : {&g.node0, &g.node1, &g.node2, &g.node3}) a.reads(*corner, Reach::others);
    a.reads(g.volume, Reach::others).reads(g.id, Reach::others);
    a.reads(world.segments.part, Reach::others);
  }
  void block(World&, const Clock&, Index, Index) override {}
  void finish(World& world, const Clock& clock) override {
    failures_.clear();
    std::unordered_set<Index> torn;  // nodes of what goes now
    for (const auto& group : groups_)
      for (Erosion::Failed& failed : group->take_failed()) {
        for (int c = 0; c < group->group().corners(); ++c)
          torn.insert(group->group().node.data(c)[failed.element]);
        book(*group, failed, world);
      }
    if (!torn.empty()) weaken_beside(torn);
    if (first_step_ == 0 && dtmin_ > 0) find_first_step(world, clock);
  }
  bool rings() const override { return false; }
  /// Where no element is left the step is the longest so far.
  Limit limit(const World& world, const Clock& clock) override {
    constexpr Real none = std::numeric_limits<Real>::infinity();
    longest_ = std::max(longest_, clock.dt_old);
    Index dead = 0, all = 0;
    for (const auto& group : groups_)
      if (group->all_dead()) dead += group->group().size();
    for (const auto& group : world.groups)
      if (group->corners() > 1) all += group->size();  // lumped masses have no step
    if (dead < all) return {none, "the last element, which is deleted"};
    if (!(longest_ > 0)) stop_for_deletion_of_all();
    return {longest_, "the last element, which is deleted"};
  }
  const std::vector<ElementFailure>& failures() const override { return failures_; }

  void keep(Archive& archive) override {
    if (archive.loading() && !archive.has("first_step")) return;  // nothing could fail so far
    archive("first_step", first_step_), archive("longest_step", longest_);
  }
  void loaded(World&) override {
    for (const auto& group : groups_) group->loaded(), group->set_least_step(dtmin_ * first_step_);
  }

 private:
  [[noreturn]] void stop_for_deletion_of_all() const {
    const ElementFailure first = failures_.empty() ? ElementFailure{} : failures_.front();
    throw RunError(
        fmt::format("all elements are deleted before the first step, the first of them {} {} of part "
                    "{} for: {}",
                    first.kind, first.id, first.part, first.why),
        StopCause::element,
        "elements fulfil at the start what deletes them: a step (TDEL), a volume or a strain that "
        "limits them, in the units of the deck");
  }
  void weaken_beside(const std::unordered_set<Index>& torn) const {
    for (const auto& eroding : groups_) {
      if (!eroding->weakens()) continue;
      const ElementGroup& group = eroding->group();
      for (Index e = 0; e < group.size(); ++e)
        for (int c = 0; c < group.corners(); ++c)
          if (torn.contains(group.node.data(c)[e])) {
            eroding->weaken(e);
            break;
          }
    }
  }

  void book(const Erosion& erosion, Erosion::Failed& failed, World& world) {
    const ElementGroup& group = erosion.group();
    const Id id = group.id[failed.element];
    const bool shell = group.segment != nullptr, beam = group.corners() == 2;
    const std::string kind = beam ? "beam" : shell ? "shell" : "solid";
    world.energy.dissipated += erosion.energy_of(failed.element);
    world.energy.throughput += std::abs(erosion.energy_of(failed.element));
    ++world.counters["deleted_" + kind + "s"];
    ++world.counters["deleted_elements"];
    world.maxima["mass_of_deleted_elements"] += group.mass[failed.element];
    if (shell)
      eroded_[(*group.segment)[failed.element]] = deleted;
    else if (!beam)
      faces_.erode(world.segments, eroded_, id, group.part);
    failures_.push_back(
        {id, world.part_ids[static_cast<std::size_t>(group.part)], kind, std::move(failed.why)});
  }

  /// Of elements alone: what they allow at the start.
  void find_first_step(const World& world, const Clock& clock) {
    const ReadsForMessage unchecked;  // limits tell whose they are
    Real least = std::numeric_limits<Real>::infinity();
    for (auto* elements : world.passes.all<PartReporter>())
      if (auto* limit = dynamic_cast<TimeLimit*>(elements))
        least = std::min(least, limit->limit(world, clock).dt);
    if (!std::isfinite(least)) return;
    first_step_ = least;
    for (const auto& group : groups_) group->set_least_step(dtmin_ * first_step_);
  }

  std::vector<std::shared_ptr<Erosion>> groups_;
  Real dtmin_;
  Field<Index>& eroded_;  ///< of segments
  SolidFaces faces_;
  Real first_step_ = 0;  ///< [T]
  Real longest_ = 0;     ///< step so far [T]
  std::vector<ElementFailure> failures_;
};

}  // namespace

void add_erosion(const Model& model, std::vector<std::shared_ptr<Erosion>> groups, World& world) {
  if (groups.empty()) return;
  world.counters.try_emplace("deleted_elements", 0);
  world.passes.add(std::make_shared<DeletedElements>(std::move(groups), model.dtmin, world));
}

}  // namespace courant
