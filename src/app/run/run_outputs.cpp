#include "app/run/run_outputs.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "extension/additions.hpp"
#include "gauges/gauge.hpp"
#include "model/requests/output_times.hpp"

namespace courant {
namespace {

OutputSchedule schedule(const OutputTimes& times) {
  if (times.rule == OutputTimes::Rule::interval) return {times.interval};
  return {first_output(times), [times](Real due) { return next_output(times, due); }};
}

/// A history that a file adds: its text and numbers come with the sample.
HistoryRequests::Request request_of(const AsciiHistory& added, std::size_t number, const Simulation& s) {
  TextHistory file{.name = added.name, .empty_legend = false, .columns = added.columns};
  file.text = [number](const Sample& sample, Real) { return sample.added[number].text; };
  if (added.numbers)
    file.numbers = [number](const Sample& sample, Real, HistoryNumbers& to) {
      to = sample.added[number].numbers;
    };
  if (added.legend) {
    std::vector<Legend> legend;
    for (const auto& [id, title] : added.legend(s.world())) legend.push_back({id, title});
    file.legend = [legend](const HistoryTitles&) { return legend; };
  }
  return {std::move(file), OutputSchedule(added.interval(s.deck())),
          added.binary ? added.binary(s.deck()) : 1};
}

HistoryTitles titles_of(const Simulation& s) {
  HistoryTitles out;
  for (const HistoryNode& node : s.model().output.history_node)
    if (!node.title.empty()) out.nodes.push_back({node.id, node.title});
  for (const ModelPart& part : s.model().parts) out.parts.push_back({part.id, part.title});
  for (const auto& contact : s.contacts())
    out.contacts.push_back({contact->report().id, contact->report().title});
  for (const auto* nodes : s.world().passes.all<const InterfaceReporter>()) {
    const InterfaceForce one = nodes->report();
    const bool known = std::any_of(out.contacts.begin(), out.contacts.end(),
                                   [&](const Legend& legend) { return legend.id == one.id; });
    if (!known) out.contacts.push_back({one.id, one.title});
  }
  for (const auto* walls : s.world().passes.all<const WallForceReporter>()) {
    const InterfaceForce all = walls->report(s.world());
    out.contacts.push_back({all.id, all.title});
  }
  for (const auto* wall : s.world().passes.all<const RigidWallReporter>()) {
    const RigidWallForce one = wall->report_wall();
    out.rigid_walls.push_back({one.id, one.title});
  }
  return out;
}

}  // namespace

HistoryRequests history_requests(const Simulation& s) {
  HistoryRequests h;
  h.title = s.model().title, h.titles = titles_of(s);
  for (const auto& [name, asked] : s.model().output.histories)
    h.ask(name, schedule(asked.times), asked.binary);
  for (std::size_t k = 0; k < ascii_histories().size(); ++k)
    h.files.push_back(request_of(ascii_histories()[k], k, s));
  for (const Gauges* gauges : s.world().passes.all<const Gauges>())
    for (std::size_t k = 0; k < gauges->all().size(); ++k)
      h.ask_gauge(k, gauges->all()[k]->layout(), gauges->all()[k]->interval());
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
