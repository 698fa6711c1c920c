#include "app/run_outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <string_view>

#include "extension/additions.hpp"
#include "model/requests/output_times.hpp"
#include "model/requests/request_cards.hpp"

namespace courant {
namespace {

OutputSchedule schedule(const OutputTimes& times) {
  if (times.rule == OutputTimes::Rule::interval) return {times.interval};
  return {first_output(times), [times](Real due) { return next_output(times, due); }};
}

}  // namespace

namespace {

HistoryRequests::Added added_history(const AsciiHistory& added, const Simulation& s) {
  HistoryRequests::Added out{added.name, OutputSchedule(added.interval(s.deck()))};
  out.columns = added.columns;
  if (added.legend)
    for (const auto& [id, title] : added.legend(s.world())) out.legend.push_back({id, title});
  return out;
}

}  // namespace

namespace {

/// BINARY of each card, by the name of its history.
std::map<std::string, int> kinds_of_files(const Deck& deck) {
  constexpr std::string_view front = "*DATABASE_";
  std::map<std::string, int> out;
  for (const DatabaseAsciiCard& card : deck.all<DatabaseAsciiCard>()) {
    std::string name = deck.keyword(card).substr(front.size());
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    out[name] = card.binary;
  }
  return out;
}

}  // namespace

HistoryRequests history_requests(const Simulation& s) {
  const OutputRequests& wanted = s.model().output;
  HistoryRequests h;
  h.glstat = schedule(wanted.glstat), h.matsum = schedule(wanted.matsum), h.rcforc = schedule(wanted.rcforc);
  h.sleout = schedule(wanted.sleout), h.sphout = schedule(wanted.sphout), h.nodout = schedule(wanted.nodout);
  h.rbdout = schedule(wanted.rbdout), h.bndout = schedule(wanted.bndout);
  h.spcforc = schedule(wanted.spcforc), h.rwforc = schedule(wanted.rwforc);
  for (const HistoryNode& node : wanted.history_node)
    if (!node.title.empty()) h.nodes.push_back({node.id, node.title});
  h.title = s.model().title;
  for (const ModelPart& part : s.model().parts) h.parts.push_back({part.id, part.title});
  for (const auto& contact : s.contacts())
    h.contacts.push_back({contact->report().id, contact->report().title});
  for (const auto* nodes : s.world().passes.all<const InterfaceReporter>()) {
    const InterfaceForce one = nodes->report();
    const bool known = std::any_of(h.contacts.begin(), h.contacts.end(),
                                   [&](const Legend& legend) { return legend.id == one.id; });
    if (!known) h.contacts.push_back({one.id, one.title});
  }
  for (const auto* walls : s.world().passes.all<const WallForceReporter>()) {
    const InterfaceForce all = walls->report(s.world());
    h.contacts.push_back({all.id, all.title});
  }
  for (const auto* wall : s.world().passes.all<const RigidWallReporter>()) {
    const RigidWallForce one = wall->report_wall();
    h.rigid_walls.push_back({one.id, one.title});
  }
  h.binary = kinds_of_files(s.deck());
  for (const AsciiHistory& added : ascii_histories()) h.added.push_back(added_history(added, s));
  return h;
}

OutputSchedule field_schedule(const Simulation& s, Real end) {
  const OutputRequests& wanted = s.model().output;
  return wanted.d3plot_count > 0 ? OutputSchedule(end / wanted.d3plot_count) : schedule(wanted.d3plot);
}

void tell_first_step(const World& world, const Clock& clock, const std::string& who, Messag& messag) {
  messag.line(fmt::format(" initial kinetic energy = {:.8E}", world.energy.kinetic));
  messag.line(" initialization completed");
  messag.line(fmt::format("first step {:.4E} [T], set by {}", clock.dt, who));
}

void tell_failures(const World& world, const Clock& clock, Messag& messag) {
  constexpr std::int64_t most_shown = 20;
  for (const auto* reporter : world.passes.all<const FailureReporter>())
    for (const ElementFailure& one : reporter->failures()) {
      const std::string text = fmt::format(" {} element {:8} of part {} failed at time {:.4E}: {}", one.kind,
                                           one.id, one.part, clock.t, one.why);
      if (world.counters.at("deleted_elements") <= most_shown)
        messag.line(text);
      else
        messag.keep(text);
    }
}

}  // namespace courant
