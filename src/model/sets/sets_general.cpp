// The rows of *SET_..._GENERAL: a word that takes members in or, with D in front, out; in the order of the
// deck.
#include <fmt/format.h>
#include <algorithm>
#include <iterator>
#include <numeric>

#include "keyword/source.hpp"
#include "model/sets/sets.hpp"

namespace courant {

namespace {

struct Word {
  std::string_view word;
  IdSpace space;    // of the ids behind it
  std::size_t ids;  // how many columns hold them
};

constexpr std::size_t all_columns = 7;
constexpr std::size_t segment_columns = 3;  // E4 to E7 are attributes of the segments

const std::vector<Word>& words_of(SetKind kind) {
  static const std::vector<Word> words[] = {{{"ALL", IdSpace::none, 0},
                                             {"NODE", IdSpace::node, all_columns},
                                             {"PART", IdSpace::part, all_columns},
                                             {"BOX", IdSpace::box, all_columns},
                                             {"SET_SHELL", IdSpace::shell_set, all_columns},
                                             {"SET_SOLID", IdSpace::solid_set, all_columns}},
                                            {{"ALL", IdSpace::none, 0},
                                             {"PART", IdSpace::part, all_columns},
                                             {"SET", IdSpace::part_set, all_columns}},
                                            {{"ALL", IdSpace::none, 0},
                                             {"ELEM", IdSpace::shell, all_columns},
                                             {"PART", IdSpace::part, all_columns},
                                             {"BOX", IdSpace::box, all_columns},
                                             {"SET", IdSpace::shell_set, all_columns}},
                                            {{"ALL", IdSpace::none, 0},
                                             {"ELEM", IdSpace::solid, all_columns},
                                             {"PART", IdSpace::part, all_columns},
                                             {"BOX", IdSpace::box, all_columns},
                                             {"SET", IdSpace::solid_set, all_columns}},
                                            {{"ALL", IdSpace::none, 0},
                                             {"PART", IdSpace::part, segment_columns},
                                             {"BOX", IdSpace::box, segment_columns},
                                             {"BOX_SHELL", IdSpace::box, segment_columns},
                                             {"BOX_SOLID", IdSpace::box, segment_columns},
                                             {"SEG", IdSpace::node, 4},
                                             {"SET", IdSpace::segment_set, segment_columns},
                                             {"SET_SHELL", IdSpace::shell_set, segment_columns},
                                             {"SET_SOLID", IdSpace::solid_set, segment_columns}}};
  return words[static_cast<std::size_t>(kind)];
}

struct RowWord {
  const Word* word = nullptr;  // nullptr: not supported
  bool out = false;
};

RowWord read_word(SetKind kind, std::string_view text) {
  const std::string upper = upper_case(text);
  const auto find = [&](std::string_view wanted) -> const Word* {
    for (const Word& w : words_of(kind))
      if (w.word == wanted) return &w;
    return nullptr;
  };
  if (const Word* w = find(upper)) return {w, false};
  if (upper.size() > 1 && upper[0] == 'D' && upper != "DALL")
    return {find(std::string_view(upper).substr(1)), true};
  return {};
}

}  // namespace

std::vector<std::string> set_words(SetKind kind) {
  std::vector<std::string> out;
  for (const Word& w : words_of(kind)) out.emplace_back(w.word);
  return out;
}

IdSpace row_space(SetKind kind, std::string_view word, std::size_t k) {
  const RowWord found = read_word(kind, word);
  return found.word && k < found.word->ids ? found.word->space : IdSpace::none;
}

SetResolver::Found SetResolver::general(SetKind kind, const SetCard& card) {
  const std::vector<Id>* columns[] = {&card.ids, &card.e2, &card.e3, &card.e4, &card.e5, &card.e6, &card.e7};
  Members out;
  for (std::size_t r = 0; r < card.option.size(); ++r) {
    row_ = r;
    if (card.option[r].empty()) continue;  // a blank line
    const RowWord asked = read_word(kind, card.option[r]);
    if (!asked.word) {
      error(card, "OPTION", 0, fmt::format("'{}' is not supported", card.option[r]),
            fmt::format("supported: {}; with D in front they take out", fmt::join(set_words(kind), ", ")));
      return std::nullopt;
    }
    // SEG: E4 is a node there, and an attribute, a real, behind all other words
    const std::optional<Id> fourth = card.fourth_node(r);
    if (kind == SetKind::segment && asked.word->ids > 3 && !fourth) {
      error(card, "E4", 0, fmt::format("expected a node id, got '{:g}'", card.r4[r]));
      return std::nullopt;
    }
    std::vector<Id> ids;
    for (std::size_t k = 0; k < asked.word->ids; ++k)
      if (const Id id = k == 3 && kind == SetKind::segment ? *fourth : cell(*columns[k], r); id != 0)
        ids.push_back(id);
    if (ids.empty() && asked.word->ids > 0) {
      error(card, "OPTION", 0, fmt::format("{} has no id behind it", card.option[r]));
      return std::nullopt;
    }
    Found found = row(kind, card, asked.word->word, ids);
    if (!found) return std::nullopt;
    if (asked.out && kind == SetKind::segment) {  // whichever side is up
      const Members turned = turned_around(*found);
      found->insert(found->end(), turned.begin(), turned.end());
    }
    if (!asked.out) {
      out.insert(out.end(), found->begin(), found->end());
      if (out.size() > 8 * count(kind) + 1000) sort_unique(out);  // rows may overlap many times
      continue;
    }
    sort_unique(out);
    sort_unique(*found);
    Members next;
    std::set_difference(out.begin(), out.end(), found->begin(), found->end(), std::back_inserter(next));
    out = std::move(next);
  }
  return out;  // sorted by the caller
}

SetResolver::Found SetResolver::row(SetKind kind, const SetCard& card, std::string_view word,
                                    const std::vector<Id>& ids) {
  if (word == "ALL") return everything(kind, card);
  if (word == "PART") return kind == SetKind::part ? elements(kind, card, ids) : of_parts(kind, card, ids);
  if (word == "NODE" || word == "ELEM") return elements(kind, card, ids);
  if (word.substr(0, 3) == "BOX") return in_boxes(kind, card, word, ids);
  if (word == "SET") return of_sets(kind, kind, card, ids);
  if (word == "SET_SHELL") return of_sets(kind, SetKind::shell, card, ids);
  if (word == "SET_SOLID") return of_sets(kind, SetKind::solid, card, ids);
  std::array<Id, 4> corners{};  // SEG
  std::copy(ids.begin(), ids.end(), corners.begin());
  const Index found = segment_of_ids(card, "E1", corners);
  if (found < 0) return std::nullopt;
  return Members{found};
}

SetResolver::Found SetResolver::everything(SetKind kind, const SetCard& card) {
  const auto all = [&](SetKind from) {
    Members out(count(from));
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = static_cast<Index>(i);
    return out;
  };
  if (kind != SetKind::segment) return all(kind);
  Members out = converted(SetKind::shell, kind, all(SetKind::shell));
  const Found faces = skin(card, all(SetKind::solid), [](Index) { return true; });
  if (!faces) return std::nullopt;
  out.insert(out.end(), faces->begin(), faces->end());
  return out;
}

SetResolver::Found SetResolver::elements(SetKind kind, const SetCard& card, const std::vector<Id>& ids) {
  Members out;
  for (const Id id : ids) {
    const Index found = find(kind, id);
    if (found < 0) {
      error(card, "E1", id, fmt::format("{} {} does not exist", set_word(kind), id));
      return std::nullopt;
    }
    out.push_back(found);
  }
  return out;
}

SetResolver::Found SetResolver::of_parts(SetKind kind, const SetCard& card, const std::vector<Id>& ids) {
  const Found parts = elements(SetKind::part, card, ids);
  if (!parts) return std::nullopt;
  std::vector<bool> wanted(model_.parts.size(), false);
  for (const Index p : *parts) wanted[static_cast<std::size_t>(p)] = true;
  const auto is_wanted = [&](Index part) { return wanted[static_cast<std::size_t>(part)]; };
  Members shells, solids, out;
  for (std::size_t i = 0; i < model_.shells.size(); ++i)
    if (is_wanted(model_.shells[i].part)) shells.push_back(static_cast<Index>(i));
  for (std::size_t i = 0; i < model_.solids.size(); ++i)
    if (is_wanted(model_.solids[i].part)) solids.push_back(static_cast<Index>(i));
  if (kind == SetKind::shell) return shells;
  if (kind == SetKind::solid) return solids;
  if (kind == SetKind::segment) {
    const Found faces = skin(card, solids, [](Index) { return true; });
    if (!faces) return std::nullopt;
    out = converted(SetKind::shell, kind, shells);
    out.insert(out.end(), faces->begin(), faces->end());
    return out;
  }
  out = converted(SetKind::shell, kind, shells);
  const Members of_solids = converted(SetKind::solid, kind, solids);
  out.insert(out.end(), of_solids.begin(), of_solids.end());
  for (const ModelSph& sph : model_.sph)
    if (is_wanted(sph.part)) out.push_back(sph.node);
  for (const ModelBeam& beam : model_.beams)
    if (is_wanted(beam.part)) out.insert(out.end(), beam.node.begin(), beam.node.end());
  return out;
}

SetResolver::Found SetResolver::in_boxes(SetKind kind, const SetCard& card, std::string_view word,
                                         const std::vector<Id>& ids) {
  Members out, faces;
  for (const Id id : ids) {
    const auto it = model_.boxes.find(id);
    if (it == model_.boxes.end()) {
      error(card, "E1", id, fmt::format("box {} does not exist", id), "define it with *DEFINE_BOX");
      return std::nullopt;
    }
    const auto inside = [&](Index n) {
      return n < 0 || it->second.contains(model_.nodes[static_cast<std::size_t>(n)].x);
    };
    const auto add = [&](std::size_t i, const auto& nodes) {
      if (std::all_of(nodes.begin(), nodes.end(), inside)) out.push_back(static_cast<Index>(i));
    };
    if (kind == SetKind::node)
      for (std::size_t i = 0; i < model_.nodes.size(); ++i) add(i, std::array{static_cast<Index>(i)});
    else if (kind == SetKind::solid)
      for (std::size_t i = 0; i < model_.solids.size(); ++i) add(i, model_.solids[i].node);
    else if (word != "BOX_SOLID")
      for (std::size_t i = 0; i < model_.shells.size(); ++i) add(i, model_.shells[i].node);
    if (kind != SetKind::segment || word == "BOX_SHELL") continue;
    Members solids(model_.solids.size());
    std::iota(solids.begin(), solids.end(), Index(0));
    const Found of_box = skin(card, solids, inside);
    if (!of_box) return std::nullopt;
    faces.insert(faces.end(), of_box->begin(), of_box->end());
  }
  if (kind != SetKind::segment) return out;
  out = converted(SetKind::shell, kind, out);
  out.insert(out.end(), faces.begin(), faces.end());
  return out;
}

SetResolver::Found SetResolver::of_sets(SetKind kind, SetKind from, const SetCard& card,
                                        const std::vector<Id>& ids) {
  Members out;
  for (const Id id : ids) {
    const Members* members = other(card, "E1", from, id);
    if (!members) return std::nullopt;
    const bool of_solids = from == SetKind::solid && kind == SetKind::segment;
    const Found faces = of_solids ? skin(card, *members, [](Index) { return true; }) : Members{};
    if (!faces) return std::nullopt;
    const Members own = of_solids ? *faces : converted(from, kind, *members);
    out.insert(out.end(), own.begin(), own.end());
  }
  return out;
}

SetResolver::Members SetResolver::turned_around(const Members& segments) {
  Members out;
  for (const Index s : segments) {
    std::array<Index, 4> corners = model_.segments[static_cast<std::size_t>(s)].node;
    if (corners[2] == corners[1]) continue;  // a line has no sides
    // a triangle keeps its last corner twice
    std::reverse(corners.begin(), corners.begin() + (corners[3] == corners[2] ? 2 : 4));
    out.push_back(segment(corners));
  }
  return out;
}

}  // namespace courant
