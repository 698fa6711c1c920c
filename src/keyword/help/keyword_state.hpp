#pragma once
// Treatment of a keyword, from its table: for lists, pages and docs/cannot_do.md.
#include <string>
#include <vector>

#include "keyword/keyword_spec.hpp"

namespace courant {

enum class KeywordState {
  honoured,   ///< all fields count, or cannot matter
  partly,     ///< some fields, or some of their values, are refused or give a warning
  no_effect,  ///< asks for nothing but output, or the like, that is not there and changes no result
  refused,    ///< the cards are read, and the deck is refused
};

/// A keyword's state, and the fields that make it so; of a refused one all fields are as good as none.
struct KeywordSupport {
  KeywordState state = KeywordState::honoured;
  std::vector<std::string> refused;  ///< names of fields of which other values than the default are refused
  std::vector<std::string> limited;  ///< "FORM (0, 1)": fields that take some values only
  std::vector<std::string> warned;   ///< fields that request missing output
};

KeywordSupport support_of(const KeywordSpec& spec);
const char* state_word(KeywordState state);  ///< "honoured", "partly", "no effect", "refused"

/// "partly: refused are other values than the default of A, B; ...", on one line without its end.
std::string support_text(const KeywordSpec& spec);
/// What the words of the states mean, for the foot of a list.
std::string state_legend();

/// All tables for programs: a list of keywords with their cards and fields.
std::string keyword_json();

/// The whole of docs/cannot_do.md.
std::string cannot_do_markdown();

}  // namespace courant
