#include "keyword/deck_record.hpp"

#include <fmt/format.h>

#include <cstring>

#include "keyword/help/families.hpp"
#include "keyword/registry.hpp"

namespace courant {
namespace {

constexpr std::int64_t most_lines = 500;  // of a keyword; from there on only their checksum is kept
constexpr int most_shown = 20;            // characters of a value in a message

/// 64-bit FNV-1a (Fowler, Noll, Vo).
class Checksum {
 public:
  void add(const void* data, std::size_t bytes) {
    const auto* at = static_cast<const unsigned char*>(data);
    for (std::size_t k = 0; k < bytes; ++k) sum_ = (sum_ ^ at[k]) * 0x100000001b3u;
  }
  void add(Real number) { add(&number, sizeof number); }
  void add(const std::string& text) {
    add(static_cast<Real>(text.size()));
    add(text.data(), text.size());
  }
  std::uint64_t value() const { return sum_; }

 private:
  std::uint64_t sum_ = 0xcbf29ce484222325u;
};

bool is_number(FieldType type) {
  return type == FieldType::integer || type == FieldType::id || type == FieldType::real;
}

/// Calls visit(card, field, spec) for every field that holds something, always in the same order.
template <class Visit>
void for_each_field(const KeywordSpec& spec, const Visit& visit) {
  for (std::size_t c = 0; c < spec.cards.size(); ++c)
    for (std::size_t f = 0; f < spec.cards[c].fields.size(); ++f)
      if (spec.cards[c].fields[f].type != FieldType::skip) visit(c, f, spec.cards[c].fields[f]);
}

std::string line_of(const KeywordSpec& spec, const Entry& entry) {
  std::string line =
      fmt::format("{}\t{}", spec.names[static_cast<std::size_t>(entry.name)], spec.id_of(entry));
  for_each_field(spec, [&](std::size_t c, std::size_t f, const FieldSpec& field) {
    line += '\t' + (is_number(field.type) ? fmt::format("{}", spec.number_of(entry, c, f))
                                          : spec.text_of(entry, c, f));
  });
  for (char& letter : line)
    if (letter == '\n') letter = ' ';
  return line;
}

void add_to(Checksum& sum, const KeywordSpec& spec, const Entry& entry) {
  sum.add(static_cast<Real>(entry.name));
  sum.add(static_cast<Real>(spec.id_of(entry)));
  for_each_field(spec, [&](std::size_t c, std::size_t f, const FieldSpec& field) {
    if (is_number(field.type))
      sum.add(spec.number_of(entry, c, f));
    else
      sum.add(spec.text_of(entry, c, f));
  });
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> words{""};
  for (const char letter : line) {
    if (letter == '\t')
      words.emplace_back();
    else
      words.back() += letter;
  }
  return words;
}

std::string shown(const std::string& value) {
  if (value.empty()) return "nothing";
  return "'" + (value.size() > most_shown ? value.substr(0, most_shown) + "..." : value) + "'";
}

/// Keywords of what happens when a run goes on.
bool acts_at_restart(const std::string& name) {
  return name.starts_with("CHANGE_") || name.starts_with("DELETE_");
}

/// Keywords that may change between the parts of a run whatever their fields say.
bool may_change(const KeywordSpec& spec) {
  const std::string& name = spec.names.front();
  return is_output_request(name) || acts_at_restart(name) || name == "CONTROL_TERMINATION" ||
         name == "CONTROL_CPU" || name == "COURANT_OUTPUT" || name == "COURANT_D3PLOT" ||
         name == "COURANT_PROGRAM_FORCES" || name.rfind("DEFINE_CURVE", 0) == 0;
}

constexpr const char* step_keyword = "CONTROL_TIMESTEP";

/// Fields that may change though their keyword may not: a run that stopped in error may go on with shorter
/// steps.
bool may_change(const KeywordSpec& spec, const FieldSpec& field) {
  return spec.names.front() == step_keyword && field.name == "TSSFAC";
}

bool has_influence(const FieldSpec& field) {
  return field.rules.honour == Honour::yes || field.rules.honour == Honour::no;
}

/// What line_of gives for an entry with nothing but blanks, which begins as `like` does.
std::string blank_line(const KeywordSpec& spec, const std::string& like) {
  std::string line = like.substr(0, like.find('\t', like.find('\t') + 1));
  for_each_field(spec, [&](std::size_t, std::size_t, const FieldSpec& field) {
    line += '\t' + (is_number(field.type) ? fmt::format("{}", field.rules.standard) : std::string());
  });
  return line;
}

class Comparison {
 public:
  Comparison(const Deck& deck, Diagnostics& diagnostics) : deck_(deck), diagnostics_(diagnostics) {}
  std::vector<std::string> allowed;

  void compare(std::int32_t keyword, const KeywordRecord& before, const KeywordRecord& now) {
    const KeywordSpec& spec = *keyword_registry()[static_cast<std::size_t>(keyword)];
    if (before.entries == now.entries && before.sum == now.sum) return;
    std::vector<const Entry*> entries;
    spec.for_each(deck_, keyword, [&](const Entry& entry) { entries.push_back(&entry); });
    // a run without the card had its defaults
    if (spec.names.front() == step_keyword && before.entries == 0 && now.lines.size() == 1)
      return compare_fields(spec, *entries[0], split(blank_line(spec, now.lines[0])), split(now.lines[0]));
    if (before.entries == 0 && spec.names.front().starts_with("RIGID_DEFORMABLE"))
      return allowed.push_back(fmt::format("*{}: new", now.name));
    const bool lines = static_cast<std::int64_t>(before.lines.size()) == before.entries &&
                       before.lines.size() == now.lines.size();
    if (!lines) return compare_as_a_whole(spec, before, now, entries);
    const std::size_t errors_before = diagnostics_.all().size();
    for (std::size_t k = 0; k < entries.size(); ++k)
      if (before.lines[k] != now.lines[k] && diagnostics_.all().size() < errors_before + most_errors)
        compare_fields(spec, *entries[k], split(before.lines[k]), split(now.lines[k]));
  }

 private:
  static constexpr std::size_t most_errors = 5;  // of a keyword

  void compare_as_a_whole(const KeywordSpec& spec, const KeywordRecord& before, const KeywordRecord& now,
                          const std::vector<const Entry*>& entries) {
    const std::string what =
        before.entries == now.entries
            ? fmt::format("*{}: the {} entries are not those of the run so far", now.name, now.entries)
            : fmt::format("*{}: the run so far had {} entr{}, the deck has {}", now.name, before.entries,
                          before.entries == 1 ? "y" : "ies", now.entries);
    bool influence = !may_change(spec);
    if (influence) {
      influence = false;
      for_each_field(spec,
                     [&](std::size_t, std::size_t, const FieldSpec& f) { influence |= has_influence(f); });
    }
    if (!influence) return allowed.push_back(what);
    const Location where = entries.empty() ? Location{deck_.files.empty() ? "" : deck_.files[0].name, 0, 0}
                                           : deck_.where(*entries[0]);
    diagnostics_.error(where, what, hint);
  }

  void compare_fields(const KeywordSpec& spec, const Entry& entry, const std::vector<std::string>& before,
                      const std::vector<std::string>& now) {
    if (before.size() != now.size() || before[0] != now[0] || before[1] != now[1]) {
      if (may_change(spec)) return allowed.push_back(fmt::format("{}: another entry", deck_.keyword(entry)));
      diagnostics_.error(deck_.where(entry),
                         fmt::format("{}: this is not the entry of the run so far", deck_.keyword(entry)),
                         hint);
      return;
    }
    std::size_t k = 2;
    for_each_field(spec, [&](std::size_t, std::size_t, const FieldSpec& field) {
      const std::string &old = before[k], &value = now[k];
      ++k;
      if (old == value) return;
      if (may_change(spec) || may_change(spec, field) || !has_influence(field))
        allowed.push_back(
            fmt::format("{} {}: {}, was {}", deck_.keyword(entry), field.name, shown(value), shown(old)));
      else
        deck_.error(diagnostics_, entry, field.name,
                    fmt::format("the run so far had {}, the deck has {}", shown(old), shown(value)), hint);
    });
  }

  static constexpr const char* hint =
      "a run can go on with another end time, other outputs, curves or TSSFAC; change this back, or start a "
      "new "
      "run";
  const Deck& deck_;
  Diagnostics& diagnostics_;
};

}  // namespace

DeckRecord record_deck(const Deck& deck) {
  DeckRecord out;
  const auto& registry = keyword_registry();
  for (std::size_t k = 0; k < registry.size(); ++k) {
    const KeywordSpec& spec = *registry[k];
    KeywordRecord record{.name = spec.names.front(), .lines = {}};
    Checksum sum;
    spec.for_each(deck, static_cast<std::int32_t>(k), [&](const Entry& entry) {
      ++record.entries;
      add_to(sum, spec, entry);
      if (record.entries <= most_lines) record.lines.push_back(line_of(spec, entry));
    });
    if (record.entries == 0) continue;
    if (record.entries > most_lines) record.lines.clear();
    record.sum = sum.value();
    out.push_back(std::move(record));
  }
  return out;
}

std::vector<std::string> compare_decks(const DeckRecord& before, const Deck& deck, const DeckRecord& now,
                                       Diagnostics& diagnostics) {
  Comparison comparison(deck, diagnostics);
  const auto find = [](const DeckRecord& record, const std::string& name) {
    for (const KeywordRecord& one : record)
      if (one.name == name) return one;
    return KeywordRecord{.name = name, .lines = {}};
  };
  const auto& registry = keyword_registry();
  for (std::size_t k = 0; k < registry.size(); ++k) {
    const std::string& name = registry[k]->names.front();
    comparison.compare(static_cast<std::int32_t>(k), find(before, name), find(now, name));
  }
  return std::move(comparison.allowed);
}

}  // namespace courant
