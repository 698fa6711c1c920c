// `courant check --json`: the report for programs.
#include <fmt/format.h>

#include "app/check/check.hpp"
#include "base/json_text.hpp"
#include "base/version.hpp"

namespace courant {

namespace {

void add_messages(const Diagnostics& diagnostics, JsonText& json) {
  constexpr const char* severities[] = {"note", "warning", "error"};
  json.open("messages", '[');
  for (const Diagnostic& d : diagnostics.all()) {
    json.open(nullptr, '{');
    json.text("severity", severities[static_cast<int>(d.severity)]);
    json.text("file", d.where.file);
    json.whole("line", d.where.line);
    json.whole("column", d.where.column);
    json.text("message", d.message);
    json.text("hint", d.hint);
    json.close();
  }
  json.close();
}

void add_keywords(const DeckHead& deck, JsonText& json) {
  constexpr const char* treatments[] = {"honoured", "output only", "refused"};
  json.open("keywords", '[');
  for (const auto& [name, use] : deck.keywords) {
    json.open(nullptr, '{');
    json.text("name", name);
    json.whole("blocks", use.blocks);
    json.whole("entries", use.entries);
    json.text("treatment", treatments[static_cast<int>(use.treatment)]);
    if (!use.lacking.empty()) json.text("lacking", use.lacking);
    json.close();
  }
  json.close();
}

void add_mesh(const DeckFacts& facts, JsonText& json) {
  json.whole("nodes", facts.nodes);
  json.open("elements", '[');
  for (const ElementFacts& e : facts.elements) {
    json.open(nullptr, '{');
    json.text("kind", e.kind);
    json.whole("count", e.count);
    json.number("given_mass", e.mass);
    json.number("given_volume", e.volume);
    json.whole("lines_not_read", e.unread);
    json.close();
  }
  json.close();
}

void add_unused(const UnusedIds& unused, JsonText& json) {
  json.open("unused_ids", '[');
  const auto add = [&](IdSpace space, Id id) {
    json.open(nullptr, '{');
    json.text("kind", id_word(space));
    json.whole("id", id);
    json.close();
  };
  for (const UnusedId& one : unused.named) add(one.space, one.id);
  for (const Id node : unused.nodes) add(IdSpace::node, node);
  json.close();
}

void add_model(const ModelFacts& model, JsonText& json) {
  using Part = ModelFacts::Part;
  json.open("run", '{');
  json.whole("dimension", model.dim);
  json.whole("particles", model.particles);
  json.whole("active_particles", model.active);
  json.number("spacing", model.spacing);
  json.number("neighbours", model.neighbours);
  json.number("first_step", model.dt);
  json.text("first_step_set_by", model.set_by);
  json.number("end_time", model.endtim);
  json.number("steps", model.steps);
  json.number("seconds_on_one_thread", model.seconds);
  json.open("advice", '[');
  for (const std::string& one : model.advice) json.text(nullptr, one);
  json.close();
  json.open("parts", '[');
  for (const Part& part : model.parts) {
    json.open(nullptr, '{');
    json.whole("id", part.id);
    json.text("title", part.title);
    json.text("kind", part.kind);
    json.whole("elements", part.elements);
    json.number("mass", part.mass, Part::none);
    json.number("volume", part.volume, Part::none);
    json.number("density", part.rho, Part::none);
    json.number("sound_speed", part.c, Part::none);
    json.number("spacing", part.spacing, Part::none);
    json.number("smoothing_length", part.h, Part::none);
    json.number("initial_speed", part.speed);
    json.close();
  }
  json.close();
  json.close();
}

}  // namespace

DeckHead::DeckHead(const Deck& deck) : title(deck.title), keywords(deck.keywords) {
  for (const DeckFile& file : deck.files) files.push_back(file.name);
}

std::string check_json(const DeckHead& deck, const DeckFacts& facts, const UnusedIds& unused,
                       const ModelFacts* model, const Diagnostics& diagnostics, bool sound) {
  JsonText json;
  json.open(nullptr, '{');
  json.text("version", COURANT_VERSION);
  json.text("title", deck.title);
  json.whole("can_be_run", sound);
  json.whole("errors", diagnostics.errors());
  json.whole("warnings", diagnostics.warnings());
  add_messages(diagnostics, json);
  json.open("files", '[');
  for (const std::string& file : deck.files) json.text(nullptr, file);
  json.close();
  add_keywords(deck, json);
  add_mesh(facts, json);
  add_unused(unused, json);
  if (model) add_model(*model, json);
  json.close();
  return json.take();
}

}  // namespace courant
