#pragma once
// *PARAMETER: names for numbers. Names do not distinguish upper and lower case.
#include <map>
#include <string>
#include <string_view>

#include "base/diagnostic.hpp"
#include "keyword/deck.hpp"

namespace courant {

class Parameters {
 public:
  struct Value {
    std::string name;  ///< as declared
    char type = 'R';   ///< R real, I integer
    std::string text;  ///< as written in the deck or given on the command line
    Location where;
  };

  explicit Parameters(const ReadOptions& options);

  /// `declaration`: type letter and name, "R dx". An override of that name replaces the value.
  void define(std::string_view declaration, std::string_view value, const Location& where,
              Diagnostics& diagnostics);

  /// Value of "&name" or "-&name"; null if there is none.
  const Value* find(std::string_view reference) const;
  std::string nearest(std::string_view reference) const;  ///< a defined name close to an undefined one

  /// Errors for overrides that name no parameter of the deck.
  void check_overrides(const std::string& deck, Diagnostics& diagnostics) const;

  static bool is_reference(std::string_view text) {
    return !text.empty() && (text[0] == '&' || (text.size() > 1 && text[0] == '-' && text[1] == '&'));
  }

 private:
  struct Override {
    std::string name, text;
    bool used = false;
  };
  std::map<std::string, Value> values_;        // by name in upper case
  std::map<std::string, Override> overrides_;  // by name in upper case
};

}  // namespace courant
