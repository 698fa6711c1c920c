#pragma once
// The fast path through tables of nodes and elements, where a deck of millions of lines spends its time: an
// ordinary line goes from its characters to the numbers of an entry at once. Any other line (a parameter, a
// fault, a value that needs a word) is left to CardReader, which handles every case.
#include <cstddef>
#include <string_view>
#include <vector>

#include "base/real.hpp"
#include "keyword/source.hpp"

namespace courant {

/// Whether a number is one that the field allows.
bool satisfies(Check check, Real value);

class TableLines {
 public:
  TableLines() = default;
  /// For keywords of one card per entry; `usable` states whether all its fields are numbers.
  TableLines(const KeywordSpec& spec, CardFormat format);
  bool usable() const { return !columns_.empty(); }
  /// Reads a line into an entry at its standard values (EntrySink::fields). False: not an ordinary line, and
  /// some numbers may have been set.
  bool read(std::string_view line, std::byte* entry) const;

 private:
  struct Column {
    std::size_t width = 0, offset = 0;
    FieldType type = FieldType::skip;
    Check check = Check::any;
    bool required = false, zero_is_standard = true;
    bool any_value = true;  ///< no message for any value
    Real standard = 0;
    Allowed allowed;
  };
  bool read_columns(std::string_view line, std::byte* entry) const;
  bool read_commas(std::string_view line, std::byte* entry) const;
  static bool read_field(const Column& column, const char* begin, const char* end, std::byte* entry);
  static bool read_integer(const Column& column, const char* begin, const char* end, std::byte* entry);
  static bool read_real(const Column& column, const char* begin, const char* end, std::byte* entry);

  std::vector<Column> columns_;
  std::size_t total_ = 0;  ///< width of all
};

}  // namespace courant
