// What is written, when, and of whom.
#include <fmt/format.h>
#include <algorithm>
#include <string_view>
#include <unordered_set>

#include "base/expression_functions.hpp"
#include "model/model_builder.hpp"

namespace courant {

/// A curve of the interval replaces DT.
void ModelBuilder::build_output_curve(const Entry& card, std::string_view field, Id id, int ioopt,
                                      OutputTimes& out) {
  if (id == 0) return;
  const Curve* found = curve(card, field, id);
  if (!found) return;
  const auto rule = static_cast<OutputTimes::Rule>(ioopt);
  const auto& f = found->ordinate;
  if (rule != OutputTimes::Rule::abscissae && (f.empty() || *std::min_element(f.begin(), f.end()) <= 0))
    return error(card, field, fmt::format("curve {} gives an output interval that is not above 0", id),
                 "its ordinates are intervals of time");
  if (rule != OutputTimes::Rule::abscissae) check_curve(card, field, *found);
  out = {.interval = 0, .rule = rule, .curve = *found};
}

/// Its intervals, piece by piece.
void ModelBuilder::check_curve(const Entry& card, std::string_view field, const Curve& curve) {
  constexpr Real most = 1e7;
  const auto& t = curve.abscissa;
  const auto& f = curve.ordinate;
  Real count = 0;
  for (std::size_t k = 0; k + 1 < t.size(); ++k)
    count += std::max<Real>(0, std::min(t[k + 1], model_.endtim) - std::max<Real>(t[k], 0)) /
             std::min(f[k], f[k + 1]);
  if (!t.empty()) count += std::max<Real>(0, model_.endtim - t.back()) / f.back();
  if (model_.endcyc == 0 && count > most)
    error(card, field,
          fmt::format("what the curve asks for is due {:.2g} times until ENDTIM {:g}", count, model_.endtim),
          fmt::format("at most {:g} are counted; one state in each step is the most that is written", most));
}

/// Times that cannot be distinguished, or too many to look at each.
void ModelBuilder::check_interval(const Entry& card, std::string_view field, Real interval, Real most) {
  if (interval > 0 && model_.endcyc == 0 && model_.endtim > most * interval)
    error(card, field,
          fmt::format("an interval of {:g} is due {:.2g} times until ENDTIM {:g}", interval,
                      model_.endtim / interval, model_.endtim),
          fmt::format("at most {:g} are counted; one state in each step is the most that is written", most));
}

void ModelBuilder::build_histories() {
  OutputRequests& out = model_.output;
  build_history_sph();
  build_history_node();
  for (const DatabaseAsciiCard& card : deck_.all<DatabaseAsciiCard>()) {
    const std::string name = lower_case(deck_.keyword(card).substr(std::string_view("*DATABASE_").size()));
    OutputTimes& one = out.histories[name].times;
    one.interval = card.dt, out.histories[name].binary = card.binary;
    build_output_curve(card, "LCUR", card.lcur, card.ioopt, one);
    if (one.interval < 0 && name == "bndout")
      deck_.warning(diagnostics_, card, "DT", "an interval in cycles is not supported: bndout is not written",
                    "give an interval of time");
    else if (one.interval < 0)
      error(card, "DT", fmt::format("the interval is {:g}", one.interval), "it must not be negative");
    one.interval = std::max<Real>(one.interval, 0);
    check_interval(card, "DT", one.interval, most_due);
    if (one.asked() && name == "nodout" && out.history_node.empty())
      deck_.warning(diagnostics_, card, "DT", "no node is named: nodout holds no values",
                    "name nodes by *DATABASE_HISTORY_NODE");
    if (one.asked() && name == "sphout" && out.history_sph.empty())
      deck_.warning(diagnostics_, card, "DT", "no particle is named: sphout holds no values",
                    "name particles by *DATABASE_HISTORY_SPH");
  }
}

/// The members of a list of nodes, or of node sets, each named once.
std::vector<Index> ModelBuilder::listed_nodes(const Entry& card, const std::vector<Id>& ids, bool sets,
                                              std::unordered_set<Id>& sets_seen) {
  std::vector<Index> nodes;
  for (const Id id : ids) {
    if (!sets) {
      if (const Index n = node(card, "ID", id); n >= 0) nodes.push_back(n);
    } else if (sets_seen.insert(id).second) {  // a set may be named often: its members must not add up
      if (const auto* members = node_set(card, "ID", id))
        nodes.insert(nodes.end(), members->begin(), members->end());
    }
  }
  return nodes;
}

void ModelBuilder::build_history_sph() {
  if (deck_.all<DatabaseHistorySphCard>().empty()) return;
  std::vector<bool> is_particle(model_.nodes.size(), false);
  for (const ModelSph& sph : model_.sph) is_particle[static_cast<std::size_t>(sph.node)] = true;
  std::vector<Id>& history = model_.output.history_sph;
  std::unordered_set<Id> sets_seen;
  for (const DatabaseHistorySphCard& card : deck_.all<DatabaseHistorySphCard>()) {
    for (const Index n : listed_nodes(card, card.ids, card.name == 1, sets_seen)) {
      const Id nid = model_.nodes[static_cast<std::size_t>(n)].id;
      if (is_particle[static_cast<std::size_t>(n)])
        history.push_back(nid);
      else
        error(card, "ID", fmt::format("node {} is no particle", nid), "define one with *ELEMENT_SPH");
    }
  }
  std::sort(history.begin(), history.end());
  history.erase(std::unique(history.begin(), history.end()), history.end());
}

void ModelBuilder::build_history_node() {
  std::vector<HistoryNode>& history = model_.output.history_node;
  const auto add = [&](Index n, const std::string& title) {
    const ModelNode& one = model_.nodes[static_cast<std::size_t>(n)];
    history.push_back({one.id, one.x, title});
  };
  std::unordered_set<Id> sets_seen;
  for (const DatabaseHistoryNodeCard& card : deck_.all<DatabaseHistoryNodeCard>())
    for (const Index n : listed_nodes(card, card.ids, card.name == 1, sets_seen)) add(n, "");
  for (const DatabaseHistoryNodeIdCard& card : deck_.all<DatabaseHistoryNodeIdCard>())
    for (std::size_t k = 0; k < card.ids.size(); ++k)
      if (const Index n = card.ids[k] == 0 ? -1 : node(card, "ID", card.ids[k]); n >= 0)
        add(n, k < card.headings.size() ? card.headings[k] : "");
  // a heading wins over a mention without one
  std::stable_sort(history.begin(), history.end(), [](const HistoryNode& a, const HistoryNode& b) {
    return a.id != b.id ? a.id < b.id : a.title.empty() < b.title.empty();
  });
  const auto same = [](const HistoryNode& a, const HistoryNode& b) { return a.id == b.id; };
  history.erase(std::unique(history.begin(), history.end(), same), history.end());
  build_accelerometers();
}

/// Those whose node is in nodout give it their axes.
void ModelBuilder::build_accelerometers() {
  for (const SeatbeltAccelerometer& card : deck_.all<SeatbeltAccelerometer>()) {
    const std::array<Index, 3> n{node(card, "NID1", card.nid1), node(card, "NID2", card.nid2),
                                 node(card, "NID3", card.nid3)};
    if (n[0] < 0 || n[1] < 0 || n[2] < 0) continue;
    const auto x = [&](std::size_t k) { return model_.nodes[static_cast<std::size_t>(n[k])].x; };
    const Vec a = x(1) - x(0), b = x(2) - x(0);
    constexpr Real least_sine = 1e-6;
    if (!(a.cross(b).norm() > least_sine * a.norm() * b.norm())) {
      error(card, "NID3", "the three nodes of the accelerometer lie on a line", "name nodes of a triangle");
      continue;
    }
    for (HistoryNode& one : model_.output.history_node)
      if (one.id == card.nid1) one.axes = {card.nid2, card.nid3};
    if (card.igrav != 0)
      deck_.warning(diagnostics_, card, "IGRAV", "accelerations in nodout hold what gravity does",
                    "leave it 0, and take gravity out of them afterwards");
  }
}

}  // namespace courant
