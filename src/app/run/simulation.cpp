#include "app/run/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "app/check/scene_warnings.hpp"
#include "extension/part_values.hpp"
#include "keyword/source.hpp"
#include "model/build_model.hpp"
#include "model/transforms/included_entries.hpp"
#include "output/ascii/text_history.hpp"
#include "sph/inlets/injection.hpp"
#include "state/ranges.hpp"

namespace courant {

namespace {

/// Whether nodes stand where distances can be computed; the rest of the set-up would take for ever. Those
/// that motions bring there are told here, others by the model.
bool holds_places(const std::string& deck_path, const Model& model, Diagnostics& diagnostics) {
  for (const ModelNode& node : model.nodes) {
    if (node.x.cwiseAbs().maxCoeff() < largest_coordinate) continue;
    if (diagnostics.ok())
      diagnostics.error({deck_path, 0, 0},
                        fmt::format("node {} is moved to ({:g}, {:g}, {:g}), which is too large", node.id,
                                    node.x[0], node.x[1], node.x[2]));
    return false;
  }
  return true;
}

}  // namespace

std::unique_ptr<Simulation> Simulation::build(const std::string& deck_path, const ReadOptions& options,
                                              Diagnostics& diagnostics, const DeckRecord* before,
                                              RunPhase phase) {
  const double start = PassTimer::now();
  Deck deck = read_deck(deck_path, options, diagnostics);
  if (!diagnostics.broken()) move_included_entries(deck, diagnostics);
  const double read = PassTimer::now();
  auto s = from_deck(deck_path, std::move(deck), diagnostics, before, phase);
  if (!s) return s;
  s->note_read_seconds(read - start, PassTimer::now() - read);
  return s;
}

void Simulation::note_read_seconds(double reading, double building) {
  timer_.add(timer_.row("keyword reader"), reading);
  timer_.add(timer_.row("set-up"), building);
  read_seconds_ = reading + building;
}

// What is wrong in the rest of a deck with errors that say nothing of it is reported in the same go.
std::unique_ptr<Simulation> Simulation::from_deck(const std::string& deck_path, Deck deck,
                                                  Diagnostics& diagnostics, const DeckRecord* before,
                                                  RunPhase phase) {
  if (diagnostics.broken()) return nullptr;  // what could not be read would only cause more messages
  Diagnostics rest;                          // of a deck that is refused already: its errors alone
  Diagnostics& told = diagnostics.ok() ? diagnostics : rest;
  told.set_aside(true);
  auto s = from_read_deck(deck_path, std::move(deck), told, before, phase);
  told.set_aside(false);
  for (const Diagnostic& one : rest.all())
    if (one.severity == Severity::error) diagnostics.add(one);
  return diagnostics.ok() ? std::move(s) : nullptr;
}

std::unique_ptr<Simulation> Simulation::from_read_deck(const std::string& deck_path, Deck deck,
                                                       Diagnostics& diagnostics, const DeckRecord* before,
                                                       RunPhase phase) {
  std::unique_ptr<Simulation> s(new Simulation);
  for (const char* row : {"keyword reader", "set-up"}) s->timer_.row(row);  // stand first
  s->deck_ = std::move(deck);
  s->record_ = record_deck(s->deck_), s->world_.goes_on = before != nullptr;
  if (before) s->changes_ = compare_decks(*before, s->deck_, s->record_, diagnostics);
  sort_mesh_cards(s->deck_);
  s->model_ = build_model(s->deck_, diagnostics, phase);
  if (!holds_places(deck_path, s->model_, diagnostics)) return nullptr;
  s->unit_facts_ = gather_unit_facts(s->deck_);
  release_mesh_cards(s->deck_);
  s->build_world(deck_path, diagnostics);
  if (!diagnostics.ok()) return nullptr;
  s->make_stepper();
  warn_of_scene(*s, diagnostics);
  s->deck_.release_sources();  // some 300 bytes per particle
  s->model_.release_mesh();
  return s;
}

void Simulation::build_world(const std::string& deck_path, Diagnostics& diagnostics) {
  assembly_.lend(deck_), assembly_.lend(model_), assembly_.lend(world_), assembly_.lend(diagnostics);
  for (const ModelPart& part : model_.parts) world_.part_ids.push_back(part.id);
  courant::build(assembly_, BuildPhase::model, BuildPhase::settings);
  const bool model_is_whole = diagnostics.ok();
  if (model_is_whole && !get<Movers>().any)
    diagnostics.error(
        {deck_path, 0, 0},
        "the deck has no *ELEMENT_SPH, no elements that deform and no rigid body that can move: there "
        "is nothing to compute",
        "give it particles, solids, shells, beams, or a rigid body that is not held in all directions");
  if (model_is_whole) courant::build(assembly_, BuildPhase::conditions, BuildPhase::flow);
  if (diagnostics.ok()) courant::build(assembly_, BuildPhase::body_passes, BuildPhase::checks);
  assembly_.drop<Diagnostics>();
}

void Simulation::make_stepper() {
  guard_ = std::make_shared<Guard>(get<Ranges>(), model_.endeng, get<RestEnergy>().value);
  StepRules rules{.dtinit = model_.dtinit, .dtmin = model_.dtmin, .tssfac = model_.tssfac};
  if (model_.dt_max_given) rules.dt_max = model_.dt_max;
  rules.share = get<StepShare>().value, rules.guard = guard_;
  stepper_ = std::make_unique<Stepper>(world_, lists(), rules, timer_);
}

std::string Simulation::why_not_until(Real end) const {
  for (const auto& [id, curve] : model_.curves)
    if (end > model_.endtim && curve.by_formula)
      return fmt::format("curve {} is a formula that was taken until ENDTIM = {:g} only", id, model_.endtim);
  for (const Injection& inlet : get<Injections>().inlets)
    if (end > model_.endtim && inlet.end > model_.endtim)
      return fmt::format("the particles of {} ({}) last until ENDTIM = {:g} only", deck_.keyword(inlet.card),
                         deck_.place(inlet.card), model_.endtim);
  return "";
}

void Simulation::step(const AtTimeLevel& at_time_level) {
  stepper_->step(clock_, at_time_level);
}

void Simulation::evaluate(std::string& dt_controlled_by) {
  stepper_->evaluate(clock_, dt_controlled_by);
}

std::vector<PassNote> Simulation::outputs(bool wanted) const {
  const OutputRequests& out = model_.output;
  std::vector<PassNote> notes;
  const auto add = [&](std::string name, const std::string& keyword, bool on) {
    if (on == wanted) notes.push_back({std::move(name), "no *DATABASE_" + keyword});
  };
  add("field states", "BINARY_D3PLOT", out.d3plot.asked() || out.d3plot_count > 0);
  for (const TextHistory& file : text_histories())
    add(file.name, upper_case(file.name), out.history(file.name).asked());
  return notes;
}

std::string Simulation::passes() const {
  std::string text = "a step, by stages: phase, pass, the set it runs over\n" + stepper_->stages();
  const auto list = [&](const char* kind, const auto& passes) {
    for (const auto* pass : passes) text += fmt::format("  {:<13}{}\n", kind, pass->name());
  };
  list("exchange", world_.passes.all<Exchanger>());
  list("time limit", world_.passes.all<TimeLimit>());
  list("impact", world_.passes.all<Impact>());
  list("energy", world_.passes.all<EnergyTerm>());
  text += fmt::format("  {:<13}every {} steps\n", "guard", Guard::interval);
  for (const PassNote& output : outputs(true)) text += fmt::format("  {:<13}{}\n", "output", output.name);
  text += injections_text(get<Injections>(), model_);
  text += "not needed by this deck:\n";
  for (const PassNote& note : get<LeftOut>().notes)
    text += fmt::format("  {:<28}{}\n", note.name, note.reason);
  for (const PassNote& note : outputs(false)) text += fmt::format("  {:<28}{}\n", note.name, note.reason);
  return text;
}

std::string Simulation::passes_in_short() const {
  std::istringstream lines(stepper_->stages());
  int active = 0;
  for (std::string line; std::getline(lines, line);)  // a pass is four columns in, no "-- threads wait"
    active += line.rfind("    ", 0) == 0 && line[4] != '-';
  return fmt::format("{} passes make a step, {} outputs are asked for, {} of both are left out", active,
                     outputs(true).size(), get<LeftOut>().notes.size() + outputs(false).size());
}

}  // namespace courant
