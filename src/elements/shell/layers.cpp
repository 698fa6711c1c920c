#include "elements/shell/layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>
#include <tuple>

namespace courant {

bool ShellPart::has_axes() const {
  for (std::size_t k = 0; k < zeta.size(); ++k)
    if (law_of(k).axes()) return true;
  return false;
}

Real ShellPart::density() const {
  if (laws.empty()) return law->ro;
  Real sum = 0;
  for (std::size_t k = 0; k < laws.size(); ++k) sum += share[k] * laws[k]->ro;
  return sum;
}

LayerReader::LayerReader(const Deck& deck, const Model& model, Diagnostics& diagnostics)
    : deck_(deck), model_(model), diagnostics_(diagnostics) {
  for (const StrengthEntry& kind : strength_registry())
    for (const auto& [id, law] : kind.all(deck, model)) laws_.emplace(id, law);
  for (const IntegrationShell& rule : deck.all<IntegrationShell>()) {
    const auto [first, is_new] = rules_.emplace(rule.irid, &rule);
    if (!is_new)
      error(rule, "IRID",
            fmt::format("rule {} is defined twice, first at {}", rule.irid, deck.place(*first->second)),
            "give it another number");
  }
}

const ShellPart& ShellPart::of(Index group_layup) const {
  for (const ShellPart& own : layups)
    if (own.layup == group_layup) return own;
  return *this;
}

bool LayerReader::read(const ModelPart& part, const SectionShell& section, bool lobatto, ShellPart& out) {
  std::vector<Id> mids;
  if (part.plies.empty())
    return find_points(part, section, lobatto, out, mids) && find_laws(part, {part.card, "MID"}, mids, out);
  const Owner owner{part.card, "MID1"};
  return take_plies(part.plies, owner, out, mids) && find_laws(part, owner, mids, out);
}

bool LayerReader::read(const ModelPart& part, const ModelLayup& layup, ShellPart& out) {
  std::vector<Id> mids;
  const Owner owner{layup.card, "MID1"};
  if (!take_plies(layup.plies, owner, out, mids) || !find_laws(part, owner, mids, out)) return false;
  // criteria of the part's material are not those of other layers
  if (out.laws.empty() && mids.front() != part.mid) refuse_erosion(part, owner, mids.front());
  if (std::find(mids.begin(), mids.end(), part.mid) == mids.end()) refuse_erosion(part, owner, part.mid);
  return true;
}

std::shared_ptr<StrengthLaw> LayerReader::law_of(Id mid) const {
  const auto found = laws_.find(mid);
  return found == laws_.end() || found->second->deviator_only() ? nullptr : found->second;
}

bool LayerReader::take_plies(const std::vector<ModelPly>& plies, const Owner& owner, ShellPart& out,
                             std::vector<Id>& mids) {
  if (plies.empty()) return false;  // the model has said so
  if (plies.size() > static_cast<std::size_t>(ShellState::most_points))
    return error(owner.card, owner.field, fmt::format("{} layers are not supported", plies.size()),
                 fmt::format("up to {}", ShellState::most_points));
  Real all = 0, below = 0;
  for (const ModelPly& ply : plies) all += ply.thickness;
  for (const ModelPly& ply : plies) {
    out.zeta.push_back(2 * (below + 0.5 * ply.thickness) / all - 1), out.share.push_back(ply.thickness / all);
    out.angle.push_back(ply.angle), mids.push_back(ply.mid);
    below += ply.thickness;
  }
  return true;
}

bool LayerReader::find_points(const ModelPart& part, const SectionShell& s, bool lobatto, ShellPart& out,
                              std::vector<Id>& mids) {
  if (s.irid != 0) {
    if (!follow_rule(part, s, out, mids)) return false;
  } else {
    constexpr int most_gauss = 10;
    const int count = s.layers();
    if (s.nip < 0 || count > most_gauss)
      return error(s, "NIP", fmt::format("'{}' is not supported", s.nip),
                   "1 to 10 points; 2 are exact for elastic shells, plastic ones need 3 to 5; more by "
                   "*INTEGRATION_SHELL");
    (lobatto && count > 2 ? lobatto_points : gauss_points)(count, out.zeta, out.share);
  }
  mids.resize(out.zeta.size(), part.mid);
  if (s.icomp == 1)
    for (std::size_t k = 0; k < out.zeta.size(); ++k) out.angle.push_back(s.angle(static_cast<int>(k)));
  return true;
}

bool LayerReader::follow_rule(const ModelPart& part, const SectionShell& s, ShellPart& out,
                              std::vector<Id>& mids) {
  const auto found = rules_.find(-s.irid);
  if (found == rules_.end())
    return error(s, "QR/IRID",
                 s.irid > 0 ? fmt::format("'{}' is not supported", s.irid)
                            : fmt::format("rule {} does not exist", -s.irid),
                 "0: points of Gauss, or of Lobatto by INTGRD of *CONTROL_SHELL; minus the IRID of an "
                 "*INTEGRATION_SHELL");
  const IntegrationShell& rule = *found->second;
  out.fails_with_all = rule.failopt == 1;
  if (rule.nip > ShellState::most_points)
    return error(rule, "NIP", fmt::format("'{}' is not supported", rule.nip),
                 fmt::format("up to {} points", ShellState::most_points));
  if (s.icomp == 1 && s.layers() != rule.nip)
    return error(s, "NIP",
                 fmt::format("rule {} has {} points, and NIP = {} is the number of angles given", rule.irid,
                             rule.nip, s.layers()),
                 "give both the same number");
  if (rule.esop == 0) return take_points(rule, part, out, mids);
  for (int k = 0; k < rule.nip; ++k)
    out.zeta.push_back((2 * k + 1 - rule.nip) / static_cast<Real>(rule.nip)),
        out.share.push_back(1.0 / rule.nip);
  return true;
}

bool LayerReader::take_points(const IntegrationShell& rule, const ModelPart& part, ShellPart& out,
                              std::vector<Id>& mids) {
  if (static_cast<int>(rule.s.size()) != rule.nip)
    return error(rule, "NIP", fmt::format("{} points are given, not {}", rule.s.size(), rule.nip),
                 "give each point a card");
  const Real sum = std::accumulate(rule.wf.begin(), rule.wf.end(), Real(0));
  constexpr Real close = 1e-3;  // weights are written with few digits
  if (!(std::abs(sum - 1) < close))
    return error(rule, "WF", fmt::format("the weights sum up to {:g}, not 1", sum),
                 "each is the share of the thickness");
  for (std::size_t k = 0; k < rule.s.size(); ++k) {
    if (!(std::abs(rule.s[k]) <= 1))
      return error(rule, "S", fmt::format("point {} lies outside the shell: {:g}", k + 1, rule.s[k]),
                   "-1 is the lower face, 1 the upper");
    out.zeta.push_back(rule.s[k]), out.share.push_back(rule.wf[k] / sum);
    const auto other = model_.part_of_id.find(rule.pid[k]);
    if (rule.pid[k] != 0 && other == model_.part_of_id.end())
      return error(rule, "PID", fmt::format("part {} does not exist", rule.pid[k]), "define it with *PART");
    mids.push_back(rule.pid[k] == 0 ? part.mid : model_.parts[static_cast<std::size_t>(other->second)].mid);
  }
  return true;
}

bool LayerReader::find_laws(const ModelPart& part, const Owner& owner, const std::vector<Id>& mids,
                            ShellPart& out) {
  const bool layered = std::any_of(mids.begin(), mids.end(), [&](Id mid) { return mid != mids.front(); });
  std::vector<std::shared_ptr<StrengthLaw>> laws;
  for (const Id mid : mids) {
    const auto law = laws_.find(mid);
    if (law == laws_.end()) {
      if (mid == part.mid || mid == 0) return false;  // reported with the segments, or the layers
      return error(owner.card, owner.field,
                   fmt::format("a layer of part {} needs a material with strength, with id {}; {}", part.id,
                               mid, deck_.found_instead(IdSpace::material, mid)),
                   "layers are elastic, plastic or plies");
    }
    if (law->second->deviator_only())
      return error(
          owner.card, owner.field,
          fmt::format("the material of part {} takes its pressure from an equation of state, which shells "
                      "cannot have: their stress is plane",
                      part.id),
          "use a material that gives all of the stress");
    if (!law->second->in_sheets())
      return error(owner.card, owner.field,
                   fmt::format("the material of part {} is one of solids, which shells cannot have", part.id),
                   "make the part of solids");
    if (const int needed = law->second->failing_layers; needed > 0) {
      if (layered || needed > static_cast<int>(out.zeta.size()))
        return error(owner.card, owner.field,
                     fmt::format("NUMINT {} of material {} {} in part {}", needed, mid,
                                 layered ? "is not supported beside layers of other materials"
                                         : fmt::format("is never reached by the {} points", out.zeta.size()),
                                 part.id),
                     "leave NUMINT blank: all points must fail");
    }
    laws.push_back(law->second);
  }
  const auto fails = std::find_if(laws.begin(), laws.end(), [](const std::shared_ptr<StrengthLaw>& law) {
    return std::isfinite(law->failure_limit());
  });
  out.law = fails == laws.end() ? laws.front() : *fails;
  if (!layered) return true;
  for (const Id mid : mids)
    if (refuse_erosion(part, owner, mid)) break;
  out.laws = std::move(laws);
  return true;
}

bool LayerReader::refuse_erosion(const ModelPart& part, const Owner& owner, Id mid) {
  if (!has_erosion_card(deck_, mid)) return false;
  error(
      owner.card, owner.field == std::string_view("MID") ? "SECID" : owner.field,
      fmt::format("*MAT_ADD_EROSION of material {} is not supported in part {}, whose layers are of several "
                  "materials",
                  mid, part.id),
      "layers fail by what their own materials say");
  return true;
}

bool LayerReader::error(const Entry& card, const char* field, std::string message, std::string hint) {
  deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
  return false;
}

FailureRules rules_of_layers(const ShellPart& part, FailureRules rules) {
  for (std::size_t k = 0; k < part.zeta.size(); ++k) {
    const StrengthLaw::LeastStep least = part.law_of(k).least_step();
    rules.least_step.step = std::max(rules.least_step.step, least.step);
    rules.least_step.ratio = std::max(rules.least_step.ratio, least.ratio);
  }
  if (part.layup < 0) return rules;
  // the rules of the part know another law
  rules.law_limit = part.law->failure_limit(), rules.law_variable = part.law->failure_variable();
  rules.law_time = part.law->failure_time();
  std::tie(rules.least_volume, rules.most_volume) = part.law->volume_range();
  return rules;
}

}  // namespace courant
