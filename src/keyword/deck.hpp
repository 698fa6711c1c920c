#pragma once
// A deck that was read: typed entries of every supported keyword, and the location of each, so that later
// checks can name the file, line, column, keyword and field.
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <typeindex>
#include <utility>
#include <vector>

#include "keyword/card.hpp"

namespace courant {

struct SourceText;

/// One file of a deck, as often as it is read.
struct DeckFile {
  std::string name;                            ///< as named by the user
  std::shared_ptr<const SourceText> source{};  ///< its text, kept for messages
  std::int32_t parent = -1;  ///< index of the file that includes this one, -1: the deck itself
  int line = 0;              ///< line of the include
  Conversion conversion{};   ///< of *INCLUDE_TRANSFORM
};

/// Treatment of a keyword.
enum class Treatment {
  honoured,
  output_only,  ///< a request for output that is not supported: warning
  refused,      ///< physics that is not supported, or an unknown name: error
};

struct KeywordUse {
  int blocks = 0;           ///< keyword lines
  std::size_t entries = 0;  ///< sets of cards below them: nodes, elements, materials, ...
  Treatment treatment = Treatment::honoured;
  std::string lacking{};  ///< of a refused one: the missing feature, "solid elements"
  std::size_t lines = 0;  ///< data lines, of keywords without a table, whose entries cannot be counted
};

/// A parameter as a *PARAMETER keyword defines it.
struct DeckParameter {
  std::string name{};  ///< as declared
  char type = 'R';     ///< R real, I integer, C text
  std::string text{};  ///< its value; of an expression: the result
  Location where{};    ///< of the definition that counts
  bool used = false;   ///< a field, title or file name depends on it
  bool local = false;  ///< known in one file and those that it includes
  bool given = false;  ///< its value comes from ReadOptions::parameters
};

class Deck {
 public:
  /// All entries of one keyword in deck order; empty if the deck has none.
  template <class T>
  const std::vector<T>& all() const {
    static const std::vector<T> none;
    const auto it = entries_.find(std::type_index(typeid(T)));
    return it == entries_.end() ? none : *std::static_pointer_cast<std::vector<T>>(it->second);
  }
  /// The entry that counts where a keyword should occur once: the last; nullptr if there is none.
  template <class T>
  const T* last() const {
    return all<T>().empty() ? nullptr : &all<T>().back();
  }
  template <class T>
  std::vector<T>& store() {
    auto& slot = entries_[std::type_index(typeid(T))];
    if (!slot) slot = std::make_shared<std::vector<T>>();
    return *std::static_pointer_cast<std::vector<T>>(slot);
  }
  /// Releases the memory of all entries of one keyword, once they are no longer needed.
  template <class T>
  void release() {
    entries_.erase(std::type_index(typeid(T)));
  }
  /// Releases the text of the files: from then on messages about a field name its line, but not its column.
  void release_sources() {
    for (DeckFile& file : files) file.source.reset();
  }

  Location where(const Entry& entry) const;  ///< first data line
  /// Line and column of a named field. On a repeated card: in that row (from 0), and where `value` is in it
  /// or below; at the field if the value is not in the text, as with a parameter.
  struct Repeat {
    std::size_t row = 0;
    Id value = 0;  ///< 0: not searched for
  };
  Location where(const Entry& entry, std::string_view field, Repeat repeat) const;
  Location where(const Entry& entry, std::string_view field) const { return where(entry, field, Repeat{}); }
  std::string keyword(const Entry& entry) const;  ///< "*SECTION_SPH"
  /// "*SECTION_SPH field 2 (CSLH, h0 = ... [-])", the beginning of every message about a field
  std::string describe(const Entry& entry, std::string_view field) const;
  /// Adds `file:line:column: error: *KEYWORD field N (NAME, meaning [dimension]): <message>` with a hint.
  void error(Diagnostics& diagnostics, const Entry& entry, std::string_view field, std::string message,
             std::string hint = {}) const;
  /// The same for an unsupported value that does not affect further checks (contained).
  void refuse(Diagnostics& diagnostics, const Entry& entry, std::string_view field, std::string message,
              std::string hint = {}) const;
  void warning(Diagnostics& diagnostics, const Entry& entry, std::string_view field, std::string message,
               std::string hint = {}) const;

  /// Records the entry that defines an id. Returns the entry that defined it before, or nullptr if this is
  /// the first.
  const Entry* define(IdSpace space, Id id, const Entry& entry);
  /// For messages about a missing definition: "there is none", or "it is a *MAT_RIGID, defined at deck.k:12".
  std::string found_instead(IdSpace space, Id id) const;
  /// First name of the keyword that defines an id, without *; empty: there is none.
  std::string first_name_of(IdSpace space, Id id) const;
  std::string place(const Entry& entry) const;  ///< "deck.k:12"

  /// A location in one of the files, with the chain of files that include it.
  Location location(std::int32_t file, int line, int column) const;

  std::string title;
  std::vector<DeckFile> files;                 ///< [0] is the deck itself
  std::vector<DeckParameter> parameters;       ///< in the order of their definitions
  std::map<std::string, KeywordUse> keywords;  ///< every keyword of the deck by name, for `courant check`

 private:
  Location find(const Entry& entry, std::string_view field, Repeat repeat, std::string& text) const;
  std::string origin(const std::string& text) const;
  Diagnostic about(const Entry& entry, std::string_view field, const std::string& message,
                   std::string hint) const;

  std::map<std::type_index, std::shared_ptr<void>> entries_;
  std::map<std::pair<IdSpace, Id>, Entry> definitions_;
};

struct ReadOptions {
  std::map<std::string, std::string> parameters;  ///< --param NAME=VALUE: override *PARAMETER of the deck
  std::string more{};                             ///< cards that a call appends to the deck
  /// Text of a file, nothing if it cannot be read; empty: files of this system. Tests read decks from memory.
  std::function<std::optional<std::string>(const std::string& path)> open{};
};

/// Reads a deck with its includes. All faults go to `diagnostics`; never throws for bad input, never prints.
Deck read_deck(const std::string& path, const ReadOptions& options, Diagnostics& diagnostics);

}  // namespace courant
