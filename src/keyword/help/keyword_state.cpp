#include "keyword/help/keyword_state.hpp"

#include <fmt/format.h>

#include "keyword/help/families.hpp"

namespace courant {

KeywordSupport support_of(const KeywordSpec& spec) {
  KeywordSupport out;
  bool counts = false, any = false;  // fields
  for (const CardSpec& card : spec.cards)
    for (const FieldSpec& field : card.fields) {
      if (field.type == FieldType::skip) continue;
      const std::string name(field.name);
      any = true;
      counts = counts || field.rules.honour == Honour::yes;
      if (field.rules.honour == Honour::no) out.refused.push_back(name);
      if (field.rules.honour == Honour::output_only) out.warned.push_back(name);
      if (field.rules.honour == Honour::yes && !field.rules.allowed.empty())
        out.limited.push_back(fmt::format("{} ({})", name, fmt::join(field.rules.allowed, ", ")));
    }
  const bool partly = !out.refused.empty() || !out.warned.empty() || !out.limited.empty();
  out.state = !spec.lacking.empty() ? KeywordState::refused
              : any && !counts      ? KeywordState::no_effect
              : partly              ? KeywordState::partly
                                    : KeywordState::honoured;
  return out;
}

const char* state_word(KeywordState state) {
  constexpr const char* words[] = {"honoured", "partly", "no effect", "refused"};
  return words[static_cast<int>(state)];
}

std::string support_text(const KeywordSpec& spec) {
  const KeywordSupport support = support_of(spec);
  std::string out = state_word(support.state);
  if (support.state == KeywordState::refused)
    return out + fmt::format(": its cards are read and checked, and the deck is refused, because {}",
                             not_supported(spec.lacking));
  const char* before = ": ";
  const auto add = [&](const char* what, const std::vector<std::string>& fields) {
    if (fields.empty()) return;
    out += fmt::format("{}{} {}", before, what, fmt::join(fields, ", "));
    before = "; ";
  };
  add("only the default is taken of", support.refused);
  add("only some values are taken of", support.limited);
  add("a warning, and nothing else, comes of", support.warned);
  return out;
}

std::string state_legend() {
  return "honoured: all fields count. partly: of some fields only the default, or some values, are taken, "
         "and a "
         "deck with others\nis refused. no effect: output and the like that changes no result. refused: the "
         "cards "
         "are read and checked, and the\ndeck is refused. A keyword that is not listed is refused, but for "
         "requests for output, which give a warning.\n";
}

}  // namespace courant
