#pragma once
// What the readers of the single kinds of ASCII histories have in common.
#include <cstdint>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "post/ascii_history.hpp"

namespace courant {

/// A line that is not what it should be.
struct AsciiFault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The states of a file as they are read.
class AsciiStates {
 public:
  /// A new state. States of later times that were read before are dropped: the run was restarted.
  void begin(Real t);
  bool begun() const { return !t_.empty(); }
  Real time() const { return t_.back(); }
  bool holds(const AsciiKey& key) const;  ///< in the present state
  /// Into the present state. Throws AsciiFault where there is none, or the value is there already.
  void put(const AsciiKey& key, Real value);
  /// Numbers that the state with this index holds.
  std::size_t size_of(std::size_t state) const { return sizes_[state]; }

  const std::vector<Real>& times() const { return t_; }
  std::vector<AsciiColumn> take_columns();
  std::size_t dropped() const { return dropped_; }

 private:
  struct Order {
    bool operator()(const AsciiKey& a, const AsciiKey& b) const;
  };
  std::size_t index_of(const AsciiKey& key);

  std::vector<Real> t_;
  std::vector<std::size_t> sizes_;
  std::vector<AsciiColumn> columns_;
  std::map<AsciiKey, std::size_t, Order> index_;
  std::size_t next_ = 0;  // columns come in the same order in each state
  std::size_t dropped_ = 0;
};

/// Takes the lines of a file one by one.
class AsciiReader {
 public:
  virtual ~AsciiReader() = default;
  /// Lines that are no data are passed over. Throws AsciiFault.
  virtual void line(std::string_view text, AsciiStates& states) = 0;
  /// After the last line. Throws AsciiFault where something was begun that has no end.
  virtual void end() {}
};

struct AsciiKind {
  const char* name;
  /// Whether a file of this kind may have this line, and no other.
  bool (*is_told_by)(std::string_view line);
  std::unique_ptr<AsciiReader> (*make)();
};
const std::vector<AsciiKind>& ascii_kinds();

/// Takes blanks and one number off the text. `width`: of the field, for stars: a run of them may be several
/// fields. False, and nothing taken, where there is no number.
bool take_number(std::string_view& text, Real& value, std::size_t width);
/// Takes blanks and an integer that ends with the text, a blank or a sign. Throws AsciiFault for stars.
bool take_id(std::string_view& text, std::int64_t& id);
/// All numbers up to the first word that is none.
std::vector<Real> take_numbers(std::string_view& text, std::size_t width);
std::string_view stripped(std::string_view text);

}  // namespace courant
