#pragma once
// *PARAMETER and similar keywords: names for integers, reals and texts. Names do not distinguish upper and
// lower case.
#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.hpp"
#include "base/expression.hpp"
#include "keyword/deck.hpp"
#include "keyword/deck_cards.hpp"

namespace courant {

class Parameters {
 public:
  struct Value : DeckParameter {
    Number number{};                     ///< of types I and R
    bool can_change = false;             ///< _MUTABLE
    bool faulty = false;                 ///< its definition was refused: no further messages about it
    std::vector<std::size_t> made_of{};  ///< parameters that its expression uses
  };

  /// One definition, as the deck has it.
  struct Definition {
    std::string_view keyword;      ///< "*PARAMETER_LOCAL", for messages
    std::string_view declaration;  ///< type letter and name, "R dx"
    std::string_view value;        ///< a number, a text, a reference, or <expression>
    bool is_expression = false;    ///< the value is an expression, without < and >
    bool local = false, can_change = false;
    Location where;
    std::function<Location(std::size_t)> place_in_value{};  ///< of a character of `value`
  };

  /// What represents a reference or an expression in a field.
  struct Resolved {
    char type = 'R';
    std::string text{};    ///< as if it stood in the field itself
    Number number{};       ///< of types I and R
    std::string origin{};  ///< "&width is 2.0, defined at deck.k:21"; empty for an expression
    bool failed = false;
    std::string unknown{};        ///< if failed because no parameter has this name
    std::string error{}, hint{};  ///< if failed; both may be empty where the definition had its error before
    std::size_t at = 0;           ///< position of the error in the text
  };

  explicit Parameters(const ReadOptions& options);

  void enter_file() { scopes_.emplace_back(); }
  void leave_file() { scopes_.pop_back(); }

  /// An override of that name replaces the value.
  void define(const Definition& definition, Diagnostics& diagnostics);
  void set_duplication(int dflag) { duplication_ = dflag; }

  /// Value of "&name", "-&name", "<expression>" or "-<expression>"; what it is made of counts as used.
  Resolved resolve(std::string_view text);
  /// A title, file name or other text with each &name of a text parameter replaced; other & stay.
  std::string with_texts(std::string_view text);
  /// The same for a title or heading: its first 500 bytes, without control characters.
  std::string title(std::string_view text);
  static constexpr std::size_t longest_title = 500;  ///< [bytes]
  /// Text that is not read as fields: what it mentions counts as used.
  void note_mentions(std::string_view text);

  /// Errors for overrides that name no parameter of the deck.
  void check_overrides(const std::string& deck, Diagnostics& diagnostics) const;
  /// Warnings for parameters that nothing depends on.
  void check_unused(Diagnostics& diagnostics) const;
  std::vector<DeckParameter> list() const;

  static bool is_reference(std::string_view text) {
    if (!text.empty() && text[0] == '-') text.remove_prefix(1);
    return !text.empty() && (text[0] == '&' || text[0] == '<');
  }
  static bool is_name(std::string_view text);  ///< "&name" or "-&name" and nothing more

 private:
  using Scope = std::map<std::string, std::size_t, std::less<>>;  // index into values_ by upper-case name
  struct Override {
    std::string name, text;
    bool used = false;
  };

  bool look_up(std::string_view name, std::size_t& index) const;
  void mark_used(std::size_t index);
  std::string nearest(std::string_view reference) const;  ///< hint for a name that is not known here
  /// `unknown`: becomes the name that no parameter has, where there is one.
  ExpressionResult evaluate(std::string_view text, std::vector<std::size_t>& uses, bool& faulty,
                            std::string& unknown) const;
  Resolved resolve_expression(std::string_view text, bool negative, std::vector<std::size_t>& uses) const;
  Resolved resolve_name(std::string_view text, bool negative, std::vector<std::size_t>& uses) const;
  Resolved resolve_with(std::string_view text, std::vector<std::size_t>& uses) const;
  std::string replaced(std::string_view text, std::vector<std::size_t>& uses) const;

  bool read_declaration(const Definition& definition, Value& value, Diagnostics& diagnostics) const;
  void read_value(const Definition& definition, Value& value, Diagnostics& diagnostics);
  void read_literal(const Definition& definition, std::string_view text, Value& value,
                    Diagnostics& diagnostics) const;
  void read_expression(const Definition& definition, Value& value, Diagnostics& diagnostics) const;
  void read_reference(const Definition& definition, Value& value, Diagnostics& diagnostics) const;
  void store(const Definition& definition, Value value, Diagnostics& diagnostics);
  bool replaces(const Definition& definition, const Value& old, const Value& value,
                Diagnostics& diagnostics) const;

  std::deque<Value> values_;      // in the order of their definitions
  std::vector<Scope> scopes_{1};  // [0] of the whole deck, then the local ones of the files being read
  std::map<std::string, Override> overrides_;  // by name in upper case
  int duplication_ = 1;
};

/// "deck.k:12", for messages.
std::string place_of(const Location& where);

}  // namespace courant
