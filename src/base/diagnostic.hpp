#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace courant {

/// A position in an input file; line and column count from 1, 0 means "not known".
struct Location {
  std::string file;
  int line = 0;
  int column = 0;
  std::string
      included_from{};  ///< "main.k:12, from top.k:3": the including file; empty: it is the deck itself
};

enum class Severity { note, warning, error };

/// One message about the user's input. `text()` gives `file:line:column: error: message` and, if there is
/// one, further lines `  included from ...` and `  hint: ...`.
struct Diagnostic {
  Severity severity = Severity::error;
  Location where;
  std::string message;
  std::string hint;
  bool contained = false;  ///< an error beside which all else of the deck can still be judged
  std::string text() const;
};

/// Collects every message about the input, so that all faults of a deck are reported at once. The library
/// never prints. Input of any kind may be in a message, so control characters are shown as '?' and what is
/// too long to read is cut.
class Diagnostics {
 public:
  /// More warnings than these are counted, but not kept: a note instead says how many.
  static constexpr int max_warnings = 100;
  static constexpr std::size_t longest_text = 500;  ///< of a message or a hint, in bytes

  void error(Location where, std::string message, std::string hint = {});
  void warning(Location where, std::string message, std::string hint = {});
  void note(Location where, std::string message, std::string hint = {});
  void add(Diagnostic diagnostic);

  /// Adds words to the message with this position in all().
  void amend(std::size_t index, const std::string& text) { all_[index].message += text; }

  const std::vector<Diagnostic>& all() const { return all_; }
  int errors() const { return errors_ - (aside_ ? contained_ : 0); }
  int warnings() const { return warnings_; }
  bool ok() const { return errors() == 0; }
  /// Whether there are errors that are not contained.
  bool broken() const { return errors_ > contained_; }
  /// Contained errors do not count until this is revoked: the model is built in spite of them.
  void set_aside(bool aside) { aside_ = aside; }
  std::string text() const;  ///< all messages, one or two lines each, in the order they were found

 private:
  std::vector<Diagnostic> all_;
  int errors_ = 0, contained_ = 0;
  bool aside_ = false;
  int warnings_ = 0;
  std::size_t note_of_more_ = 0;  ///< index of the note about warnings that are not kept
};

}  // namespace courant
