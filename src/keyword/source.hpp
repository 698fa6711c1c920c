#pragma once
// The text of the files of a deck, and the splitting of its lines: fixed columns (standard, I10, LONG) or
// commas.
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "keyword/keyword_spec.hpp"

namespace courant {

enum class CardFormat { standard, i10, long_fields };

/// The reason why a file is not the text of a deck.
struct SourceFault {
  int line = 0, column = 0;
  std::string message, hint;
};

/// One file of a deck. Lines end with LF, CRLF or CR; tabs are expanded to multiples of 8. Characters are
/// bytes: a letter that UTF-8 writes with two takes two columns, as LS-DYNA, which knows no encodings,
/// counts.
struct SourceText {
  std::string text;
  std::vector<std::string_view> lines;       ///< views into `text`, without line ends
  std::vector<std::size_t> keyword_lines;    ///< indices of the lines that begin with '*'
  std::vector<std::size_t> encrypted_lines;  ///< where encrypted blocks begin
  std::vector<SourceFault> faults;           ///< not empty: the file is no text, and has no lines
  bool ends_within_line = false;             ///< the last line has no line end
  CardFormat format = CardFormat::standard;  ///< of the file (*KEYWORD LONG=Y, I10=Y)
  /// Index of the first keyword line from line `first` on; the number of lines if there is none.
  std::size_t next_keyword(std::size_t first) const;
};

/// Null if the file cannot be read, or is no regular file: a folder, a device or a pipe may never end.
std::shared_ptr<SourceText> load_source(const std::string& path);
std::shared_ptr<SourceText> make_source(std::string text);

std::string_view trimmed(std::string_view text);
std::string upper_case(std::string_view text);

/// A field as in the deck, without blanks around it.
struct Slice {
  std::string_view text;
  int column = 1;  ///< of its first character (of the field, if that is blank), from 1
};

/// "*node % comment" -> NODE, I10. The format is the file's unless the name has a suffix + (long), -
/// (standard), % (I10).
struct KeywordLine {
  std::string name;
  CardFormat format = CardFormat::standard;
  std::string_view rest;  ///< text behind the name
};
KeywordLine parse_keyword_line(std::string_view line, CardFormat file_format);

/// Iterates over the data lines below a keyword line: comments are skipped, the next keyword ends them.
class DataLines {
 public:
  /// `first`: index of the line to begin with.
  DataLines(const SourceText& source, std::size_t first) : source_(&source), next_(first) { skip_comments(); }
  bool done() const { return next_ >= source_->lines.size() || is_keyword(); }
  bool only_blanks_left() const;
  std::string_view line() const { return source_->lines[next_]; }
  std::size_t index() const { return next_; }  ///< of line(), or of the line that ended the data
  void step() {
    ++next_;
    skip_comments();
  }

 private:
  bool is_keyword() const { return !line().empty() && line()[0] == '*'; }
  void skip_comments() {
    while (next_ < source_->lines.size() && !line().empty() && line()[0] == '$') ++next_;
  }
  const SourceText* source_;
  std::size_t next_;
};

/// The lines that the option _MPP adds; the second one begins with &.
inline void skip_mpp_lines(DataLines& data) {
  if (!data.done()) data.step();
  if (!data.done() && !data.line().empty() && data.line()[0] == '&') data.step();
}

/// The card holds only the name of a file.
bool holds_file_name(const CardSpec& card);

/// A name of a file, without quotes around it; after " +" it continues in the next line.
std::string read_file_name(DataLines& data);

/// Skips a card, of one line or, if it holds a name of a file, of several.
void skip_card(DataLines& data, const CardSpec& card);

/// Whether `line` has parentheses or <...>, all of them closed; commas inside them do not separate fields.
bool has_brackets(std::string_view line);

/// Position of the next comma that separates fields, or npos. `brackets`: result of has_brackets for the
/// line.
std::size_t next_comma(std::string_view line, std::size_t from, bool brackets);

/// Whether a comma within the first `columns` columns separates fields.
bool is_comma_line(std::string_view line, std::size_t columns);

int field_width(const FieldSpec& field, CardFormat format);

/// Splits a data line into the fields of the card; a list takes all further columns. `too_many`: fields of a
/// comma line beyond the card's last, or values in the columns behind it.
void split_card(std::string_view line, const CardSpec& card, CardFormat format, std::vector<Slice>& slices,
                int* too_many = nullptr);

/// The last column of a card in a format that is not commas; a list extends to the end of the line.
std::size_t last_column(const CardSpec& card, CardFormat format);

/// Whether a number of a line without commas runs across a column: its end would be lost silently.
inline bool runs_across(std::string_view line, std::size_t column) {
  constexpr std::string_view of_numbers = "0123456789.+-";
  return line.size() > column && column > 0 && of_numbers.find(line[column]) != std::string_view::npos &&
         of_numbers.find(line[column - 1]) != std::string_view::npos;
}

/// Splits a line into fields of one width, for cards without a table (*PARAMETER, _ID).
std::vector<Slice> split_equal(std::string_view line, int width, int limit);

}  // namespace courant
