#include "elements/mass_scaling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/run_error.hpp"
#include "model/cards.hpp"
#include "parallel/parallel.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

constexpr const char* name_in_summary = "added_mass";
const FieldInfo of_elements{.name = "added_mass", .dimension = "M", .output = true};
constexpr const char* name_of_corners = "added_mass_of_corners";

Field<Real>* added_mass_of(const FieldSet& set) {
  return dynamic_cast<Field<Real>*>(set.find(of_elements.name));
}

/// Mass that a part has, and what of it was added.
struct PartMass {
  Real all = 0, added = 0;  ///< [M]
  Index scaled = 0, elements = 0;
  Real percent() const { return all > added ? 100 * added / (all - added) : 0; }
};

PartMass mass_of(const World& world, Index part) {
  PartMass out;
  for (const auto& group : world.groups) {
    if (group->part != part && part >= 0) continue;
    const Field<Real>* added = added_mass_of(group->fields);
    for (Index e = 0; e < group->size(); ++e) {
      out.all += group->mass[e];
      ++out.elements;
      if (!added) continue;
      out.added += (*added)[e];
      out.scaled += (*added)[e] != 0;
    }
  }
  return out;
}

/// Ends the run at ENDMAS.
class AddedMassLimit : public EnergyTerm {
 public:
  AddedMassLimit(Real endmas, const World& world) : endmas_(endmas) {
    const PartMass all = mass_of(world, -1);
    of_material_ = all.all - all.added;
  }
  std::string name() const override { return "added mass"; }
  void record(World& world, const Clock& clock, EnergyLedger&) override {
    const Real percent = 100 * world.maxima[name_in_summary] / of_material_;
    if (percent > endmas_)
      throw RunError(fmt::format("mass scaling has added {:.4g} % of the mass of elements, more than ENDMAS "
                                 "= {:.4g} %, by time {:.6g}, cycle {}",
                                 percent, endmas_, clock.t, clock.cycle),
                     "elements that are pressed or distorted ask for shorter and shorter steps: lower "
                     "|DT2MS| of *CONTROL_TIMESTEP, let elements that collapse be deleted (ERODE, "
                     "*MAT_ADD_EROSION), or raise ENDMAS of *CONTROL_TERMINATION if that much mass does not "
                     "matter");
  }
  void sample(const World&, const Clock&, EnergyLedger&) const override {}

 private:
  Real endmas_;           ///< percent
  Real of_material_ = 0;  ///< [M]
};

void warn_of_rest(const Deck& deck, const ControlTimestepCard& card, const World& world,
                  Diagnostics& diagnostics) {
  const bool scaled = std::any_of(world.groups.begin(), world.groups.end(),
                                  [](const auto& g) { return added_mass_of(g->fields) != nullptr; });
  if (!scaled)
    deck.warning(diagnostics, card, "DT2MS",
                 "has no effect: the deck has no solids, shells or beams that deform", "leave it blank");
  const bool springs = std::any_of(world.groups.begin(), world.groups.end(), [](const auto& g) {
    return g->corners() == 2 && g->pushes && added_mass_of(g->fields) == nullptr;
  });
  for (const auto& [there, what] : {std::pair(world.particles.size() > 0, "particles keep"),
                                    std::pair(springs, "discrete beams, cables and springs keep")})
    if (scaled && there)
      deck.warning(
          diagnostics, card, "DT2MS",
          fmt::format("adds mass to solids, shells and beams alone: {} the step that they need", what), "");
}

}  // namespace

void check_mass_scaling(const Deck& deck, Diagnostics& diagnostics) {
  const auto* card = deck.last<ControlTimestepCard>();
  if (!card || card->dt2ms == 0) return;
  for (const auto& [field, value] : {std::pair("IMSCL", Real(card->imscl)), std::pair("EMSCL", card->emscl)})
    if (value != 0)
      deck.refuse(diagnostics, *card, field, fmt::format("'{:g}' is not supported", value),
                  "leave the field blank or 0");
}

MassScaling mass_scaling_of(const Deck& deck) {
  const auto* card = deck.last<ControlTimestepCard>();
  if (!card) return {};
  return {std::abs(card->dt2ms), card->dt2ms > 0, card->ms1st != 0};
}

ScaledMass::ScaledMass(const MassScaling& rules, const ElementGroup& group, const Field<Real>* corner_inertia,
                       World& world)
    : rules_(rules),
      group_(group),
      corner_inertia_(corner_inertia),
      added_(group.fields.add<Real>(of_elements)),
      of_corners_(
          group.fields.add<Real>({.name = name_of_corners, .dimension = "M", .components = group.corners()})),
      inertial_(group.fields.add<Real>({.name = "inertial_mass", .dimension = "M"})),
      of_nodes_(shared_fields::added_mass.add(world.nodes.fields)) {
  lacks_.resize(static_cast<std::size_t>(block_count(group.size())));
  for (Index e = 0; e < group.size(); ++e) inertial_[e] = group.mass[e];
}

void ScaledMass::declare(const World& world, Accesses& a) const {
  if (rules_.once) return;
  const Nodes& n = world.nodes;
  a.in_finish().updates(added_).updates(of_corners_).updates(inertial_).updates(group_.mass);
  a.updates(of_nodes_).updates(n.m);
  a.reads(n.v, Reach::others).reads(n.follow, Reach::others).reads(group_.node, Reach::others);
  if (!corner_inertia_) return;
  a.reads(*corner_inertia_, Reach::others);
  a.updates(*shared_fields::rotary_inertia.find(n.fields));
  a.reads(*shared_fields::angular_velocity.find(n.fields), Reach::others);
  a.reads(*shared_fields::no_rotation.find(n.fields), Reach::others);
}

void ScaledMass::start(const std::vector<Real>& wave_time, World& world) {
  for (Index e = 0; e < group_.size(); ++e) {
    const Real lack = rules_.step / wave_time[static_cast<std::size_t>(e)];
    if (!(lack > 1) && !(rules_.of_all && lack > 0)) continue;
    add(e, (lack * lack - 1) * inertial_[e], false, world);
  }
}

bool ScaledMass::look(Index begin, Index count, const Real* wave_time, Real* step_limit) {
  constexpr Real rounding = 1e-12;
  if (rules_.once) return false;
  std::vector<Lack>& lacks = lacks_[static_cast<std::size_t>(begin / block_size)];
  lacks.clear();
  for (Index i = 0; i < count; ++i) {
    const Real lack = rules_.step / wave_time[i];
    if (!(lack > 1 + rounding) || !std::isfinite(lack)) continue;
    lacks.push_back({begin + i, lack * lack});
    step_limit[i] *= lack;
  }
  return !lacks.empty();
}

const std::vector<Index>& ScaledMass::grow(World& world) {
  grown_.clear();
  if (std::any_of(lacks_.begin(), lacks_.end(), [](const auto& lacks) { return !lacks.empty(); })) {
    const Nodes& nodes = world.nodes;
    const Real all = sum(nodes.size(), [&](Index n) { return nodes.m[n] * nodes.v.vec(n).norm(); });
    Real& most = world.maxima["momentum_of_nodes"];
    most = std::max(most, all);
  }
  for (std::vector<Lack>& lacks : lacks_) {
    for (const Lack& lack : lacks) {
      add(lack.element, (lack.growth - 1) * inertial_[lack.element], true, world);
      grown_.push_back(lack.element);
    }
    lacks.clear();
  }
  return grown_;
}

void ScaledMass::add(Index e, Real mass, bool started, World& world) {
  Nodes& nodes = world.nodes;
  const Real own = of_material(e);
  Field<Real>* inertia = shared_fields::rotary_inertia.find(nodes.fields);
  const Field<Real>* w = shared_fields::angular_velocity.find(nodes.fields);
  const Field<Index>* none = shared_fields::no_rotation.find(nodes.fields);
  Real work = 0, given = 0, momentum = 0;
  for (int c = 0; c < group_.corners(); ++c) {
    const Index n = group_.node.data(c)[e];
    if (started && nodes.follow[n]) continue;
    const Real share = mass * group_.share(e, c);
    nodes.m[n] += share, of_nodes_[n] += share, of_corners_.data(c)[e] += share, given += share;
    work += 0.5 * share * nodes.v.vec(n).squaredNorm(), momentum += share * nodes.v.vec(n).norm();
    if (!corner_inertia_) continue;
    const Real more = (*corner_inertia_)[e] * (mass / own);
    (*inertia)[n] += more;
    if ((*none)[n] == 0) work += 0.5 * more * w->vec(n).squaredNorm();
  }
  inertial_[e] += mass;
  group_.mass[e] += given, added_[e] += given;
  world.maxima[name_in_summary] += given;
  if (!started) return;
  world.energy.external_work += work, world.energy.throughput += std::abs(work);
  world.maxima["momentum_of_added_mass"] += momentum;
}

void take_back_added_mass(const std::vector<Index>& nodes, World& world) {
  Field<Real>* of_nodes = shared_fields::added_mass.find(world.nodes.fields);
  if (!of_nodes || nodes.empty()) return;
  std::vector<char> without(static_cast<std::size_t>(world.nodes.size()), 0);
  for (const Index n : nodes) without[static_cast<std::size_t>(n)] = 1;
  for (const auto& group : world.groups) {
    Field<Real>* added = added_mass_of(group->fields);
    if (!added) continue;
    auto& of_corners = dynamic_cast<Field<Real>&>(*group->fields.find(name_of_corners));
    for (int c = 0; c < group->corners(); ++c)
      for (Index e = 0; e < group->size(); ++e) {
        const Index n = group->node.data(c)[e];
        if (!without[static_cast<std::size_t>(n)]) continue;
        const Real share = std::exchange(of_corners.data(c)[e], 0);
        world.nodes.m[n] -= share, (*of_nodes)[n] -= share;
        group->mass[e] -= share, (*added)[e] -= share;
        world.maxima[name_in_summary] -= share;
      }
  }
}

Real added_mass(const ElementGroup& group) {
  const Field<Real>* added = added_mass_of(group.fields);
  return added ? sum(group.size(), [&](Index e) { return (*added)[e]; }) : 0;
}

void report_mass_scaling(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics) {
  constexpr Real much = 5;  // per cent
  const auto* card = deck.last<ControlTimestepCard>();
  if (!card || card->dt2ms == 0) return;
  warn_of_rest(deck, *card, world, diagnostics);
  for (std::size_t k = 0; k < model.parts.size(); ++k) {
    const PartMass m = mass_of(world, static_cast<Index>(k));
    if (m.scaled == 0 || model.parts[k].has_beam) continue;
    std::string text = fmt::format(
        "mass scaling to the step {:g}: part {} has {:.4g} [M] more in {} of {} elements, {:.3g} % of its "
        "mass",
        std::abs(card->dt2ms), model.parts[k].id, m.added, m.scaled, m.elements, m.percent());
    if (std::abs(m.percent()) > much)
      deck.warning(diagnostics, *card, "DT2MS", std::move(text),
                   "more than some per cent change how the part moves: a smaller |DT2MS| adds less");
    else
      diagnostics.note(deck.where(*card), std::move(text));
  }
  const auto* end = deck.last<ControlTerminationCard>();
  if (end && end->endmas > 0) world.passes.add(std::make_shared<AddedMassLimit>(end->endmas, world));
}

}  // namespace courant
