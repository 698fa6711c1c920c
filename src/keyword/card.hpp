#pragma once
// A keyword is a table: field name, columns, type, dimension, default, range, one-line meaning. Parser,
// defaults, checks, `courant keywords`, docs/keywords.md and error texts derive from that one table. Each
// folder registers its own.
//
//   struct SectionSph : Entry { Id secid; Real cslh, hmin, ...; };
//   static const RegisterKeyword<SectionSph> section_sph{{
//       .names = {"SECTION_SPH"}, .purpose = "smoothing length of SPH parts", .title_option = true,
//       .cards = {{.fields = {
//           {"SECID", &SectionSph::secid, "-", "section id", {.required = true, .check = Check::positive}},
//           {"CSLH", &SectionSph::cslh, "-", "h0 = CSLH x largest nearest-neighbour distance", {.standard
//           = 1.2}},
//           {"DEATH", &SectionSph::death, "T", "time SPH stops", {.standard = 1e20, .honour = Honour::no}},
//           ...}}}}};
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "base/diagnostic.hpp"
#include "base/real.hpp"
#include "keyword/conversion.hpp"

namespace courant {

/// Base of every card struct: its location in the deck. `title` is the text of a _TITLE, _ID or heading card.
struct Entry {
  std::int32_t file = -1;     ///< index into Deck::files
  std::int32_t line = 0;      ///< of the first data line (the title or heading line, if there is one)
  std::int32_t keyword = -1;  ///< index into the registry
  std::int32_t name = 0;      ///< which of the keyword's names the deck uses
};

/// Treatment of a value that differs from the default.
enum class Honour {
  yes,          ///< the solver uses it
  no,           ///< physics that is not supported: error
  output_only,  ///< an output request that is not supported: warning
  ignored,      ///< no influence on results by nature (memory sizes, MPP hints): silently accepted
};

enum class Check { any, positive, not_negative, not_positive };

/// A field that is, with the two fields behind it, a location or a direction in space; *INCLUDE_TRANSFORM
/// moves it.
enum class Spatial { none, point, direction };

/// The integers that a field may have; none: any. It is a constant, as the whole field is: tables with
/// constructors and destructors of fields would be slow to compile.
class Allowed {
 public:
  constexpr Allowed() = default;
  constexpr Allowed(std::initializer_list<int> values) : size_(values.size()) {
    if (size_ > values_.size()) throw std::length_error("a field allows more values than fit");
    std::copy(values.begin(), values.end(), values_.begin());
  }
  constexpr const int* begin() const { return values_.data(); }
  constexpr const int* end() const { return values_.data() + size_; }
  constexpr bool empty() const { return size_ == 0; }
  constexpr bool takes(Id value) const { return empty() || std::find(begin(), end(), value) != end(); }

 private:
  std::array<int, 8> values_{};
  std::size_t size_ = 0;
};

/// Dimensions of the numbers of a curve or table that a field names; empty: not known.
struct CurveOf {
  const char* abscissa = "";
  const char* ordinate = "";
  bool known() const { return *abscissa != 0; }
};

struct FieldRules {
  Real standard = 0;  ///< value of a blank field; also of 0 when `zero_is_standard`
  bool zero_is_standard = true;
  bool required = false;  ///< blank (or 0 for ids) is an error
  Check check = Check::any;
  Honour honour = Honour::yes;
  Allowed allowed{};  ///< for integers: the supported values; others are refused by name. Empty: any
  int width = 10;     ///< columns in standard format
  IdSpace refers =
      IdSpace::none;  ///< what the ids in this field number; for the first field KeywordOf::id_space
  Spatial spatial = Spatial::none;
  bool pairs = false;  ///< of a list of ids: in pairs on each card, so blank and 0 remain in it
  CurveOf curve{};     ///< of curve ids; *INCLUDE_TRANSFORM changes the units of the curves
};

// Rules that many tables share.
inline constexpr FieldRules no_effect{.honour = Honour::ignored};
inline constexpr FieldRules no_output{.honour = Honour::output_only};
inline constexpr FieldRules unsupported{.honour = Honour::no};
constexpr FieldRules no_effect_but(Real standard) {
  return {.standard = standard, .honour = Honour::ignored};
}

/// One field. `member` gives the destination and so the type of the value: Id and int are I, Real is F,
/// std::string A. A vector member takes this and all following columns of the card, and (on a repeated card)
/// of all cards up to the next keyword; blank and 0 entries are skipped for Id. Two or more vectors on a card
/// take one column each, as a table, and each card adds a row, blank fields as 0 or "". Its texts must be
/// literals: they are not copied.
template <class T>
struct FieldOf {
  /// monostate, the default: columns that are skipped
  using Member = std::variant<std::monostate, int T::*, Id T::*, Real T::*, std::string T::*,
                              std::vector<Id> T::*, std::vector<Real> T::*, std::vector<std::string> T::*>;
  const char* name = "";
  Member member;
  const char* dimension = "";
  const char* meaning = "";
  FieldRules rules{};
  /// Id space where it depends on other fields (a type beside it); instead of rules.refers.
  IdSpace (*refers)(const T&) = nullptr;
  /// Dimensions of the curve where they depend on other fields; instead of rules.curve.
  CurveOf (*curve_of)(const T&) = nullptr;
};

template <class T>
struct CardOf {
  std::vector<FieldOf<T>> fields{};
  bool optional = false;  ///< may be missing at the end of the keyword
  bool repeat = false;    ///< repeats up to the next keyword, filling the vector members
  /// Of a repeated one: it also ends where all required fields of card 1 are on the line as integers > 0,
  /// with which the next entry begins.
  bool until_entry = false;
  /// Of a repeated one with one list of texts: lines are read complete, with their blanks and commas, and
  /// with values instead of &names.
  bool whole_lines = false;
  /// Of a repeated one: it ends where this does not hold for the rows read so far, and the next card follows.
  bool (*more)(const T&) = nullptr;
  bool (*when)(const T&) = nullptr;  ///< the card is there only if this holds for the cards read so far
};

template <class T>
struct KeywordOf {
  std::vector<std::string> names{};  ///< without '*', the first is shown: {"MAT_NULL", "MAT_009"}
  std::string purpose{};
  /// Id space of the first field: an id may occur once among all keywords that share the space.
  IdSpace id_space = IdSpace::none;
  bool title_option = false;  ///< NAME_TITLE adds an A80 card, stored in the member named by `title`
  bool id_option = false;     ///< NAME_ID adds a card ID I10, HEADING A70
  bool mpp_option = false;    ///< NAME_MPP adds one or two cards for parallel runs, which have no effect here
  bool collect_option = false;  ///< NAME_COLLECT adds to what an earlier entry with the same id defines
  /// The id may be that of an earlier entry: the code that builds this one assigns another and reports it.
  bool id_may_repeat = false;
  bool heading = false;  ///< always starts with an A70 heading card (*PART)
  std::string T::*title = nullptr;
  Id T::*id = nullptr;
  /// The coordinate system in which locations and directions are given, 0 global. With a system
  /// *INCLUDE_TRANSFORM does not change them: the system moves.
  Id T::*local = nullptr;
  /// Counts once in a deck, with one set of cards; of several the last one counts.
  bool once = false;
  bool many = true;  ///< several card sets may follow one keyword line
  /// Not empty: what Courant lacks to honour the keyword ("solid elements"). Its cards are read and checked,
  /// counted by `courant check`, and the deck is refused.
  std::string lacking{};
  std::vector<CardOf<T>> cards{};
  /// Changes of units and motions beyond the rules of the fields, applied after these. They return the reason
  /// if it is impossible, otherwise nothing.
  std::string (*convert)(T&, const Conversion&) = nullptr;
  std::string (*move)(T&, const Affine&) = nullptr;
};

}  // namespace courant
