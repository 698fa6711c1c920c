#pragma once
// The type-erased form of a keyword's table: what the reader, the messages and the documentation need,
// without the struct.
#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "keyword/card.hpp"
#include "keyword/deck.hpp"

namespace courant {

enum class FieldType { integer, id, real, text, ids, reals, texts, skip };

/// One field of a card, with its place in standard format.
struct FieldSpec {
  std::string name, dimension, meaning;
  FieldRules rules;
  FieldType type = FieldType::skip;
  int column = 0;           ///< first column in standard format, from 0
  bool takes_rest = false;  ///< a vector that takes all further columns of the card
  std::size_t offset = 0;   ///< of a single number within its struct, for EntrySink::fields
  bool is_vector() const {
    return type == FieldType::ids || type == FieldType::reals || type == FieldType::texts;
  }
};

struct CardSpec {
  std::vector<FieldSpec> fields;
  bool optional = false;
  bool repeat = false;
  bool conditional = false;  ///< there only under a condition, see KeywordSpec::has_card
  bool is_table = false;     ///< several vectors: each card adds one to each of them
};

/// Builds the entries of one keyword, one after the other, and stores them in a deck.
class EntrySink {
 public:
  virtual ~EntrySink() = default;
  virtual void expect(std::size_t entries) = 0;  ///< room for so many more, a hint
  virtual void begin(const Entry& where) = 0;    ///< a new entry, all fields at their standard values
  virtual void set_integer(std::size_t card, std::size_t field, Id value) = 0;  ///< sets or appends
  virtual void set_real(std::size_t card, std::size_t field, Real value) = 0;   ///< sets or appends
  virtual void set_text(std::size_t card, std::size_t field, std::string_view value) = 0;
  virtual void set_title(std::string_view title) = 0;
  virtual void set_id(Id id) = 0;
  virtual const Entry& entry() const = 0;  ///< the entry as read so far
  virtual std::byte* fields() = 0;         ///< its numbers, each at FieldSpec::offset
  /// Shifts ids and changes units, by the table; returns why it cannot be done, else nothing.
  virtual std::string convert(const Conversion& conversion) = 0;
  virtual void commit() = 0;  ///< stores the entry in the deck
};

/// An id in a field of an entry.
struct IdUse {
  std::size_t card = 0, field = 0;
  IdSpace space = IdSpace::none;
  Id id = 0;             ///< as it stands, 0 and negative ones too
  bool defines = false;  ///< the entry's own id
};

class KeywordSpec {
 public:
  virtual ~KeywordSpec() = default;
  virtual std::unique_ptr<EntrySink> sink(Deck& deck) const = 0;
  /// Whether the card is there, as far as the entry was read. `entry` must be of this keyword.
  virtual bool has_card(const Entry& entry, std::size_t card) const = 0;
  /// The entry's id (with _ID that of its line, else the first field), 0 where there is no id_space. `entry`
  /// must be of this keyword.
  virtual Id id_of(const Entry& entry) const = 0;
  /// All entries of the keyword with this place in the registry.
  virtual void for_each(const Deck& deck, std::int32_t keyword,
                        const std::function<void(const Entry&)>& visit) const = 0;
  /// All ids in an entry's fields, its own first. `entry` must be of this keyword.
  virtual void for_each_id(const Entry& entry, const std::function<void(const IdUse&)>& visit) const = 0;
  /// The number in a field of an entry of this keyword; 0 for texts, lists and skipped columns.
  virtual Real number_of(const Entry& entry, std::size_t card, std::size_t field) const = 0;
  /// Texts and lists in a field: their values with all digits, apart by blanks; "" for single numbers.
  virtual std::string text_of(const Entry& entry, std::size_t card, std::size_t field) const = 0;
  /// Moves the places and directions in the entries for which `motion_of` gives a motion. `refuse` hears why
  /// an entry cannot be moved.
  virtual void move(Deck& deck, std::int32_t keyword,
                    const std::function<const Affine*(const Entry&)>& motion_of,
                    const std::function<void(const Entry&, const std::string&)>& refuse) const = 0;

  std::vector<std::string> names;
  std::string purpose, lacking;
  IdSpace id_space = IdSpace::none;
  bool title_option = false, id_option = false, mpp_option = false, collect_option = false;
  bool heading = false, once = false, many = true;
  std::vector<CardSpec> cards;
};

namespace detail {

template <class T>
FieldType field_type(const typename FieldOf<T>::Member& member) {
  // in the order of FieldOf::Member
  constexpr FieldType types[] = {FieldType::skip, FieldType::integer, FieldType::id,    FieldType::real,
                                 FieldType::text, FieldType::ids,     FieldType::reals, FieldType::texts};
  return types[member.index()];
}

template <class T>
void set_number(T& entry, const typename FieldOf<T>::Member& member, auto value) {
  switch (member.index()) {
    case 1:
      entry.*(*std::get_if<1>(&member)) = static_cast<int>(value);
      break;
    case 2:
      entry.*(*std::get_if<2>(&member)) = static_cast<Id>(value);
      break;
    case 3:
      entry.*(*std::get_if<3>(&member)) = static_cast<Real>(value);
      break;
    case 5:
      (entry.*(*std::get_if<5>(&member))).push_back(static_cast<Id>(value));
      break;
    case 6:
      (entry.*(*std::get_if<6>(&member))).push_back(static_cast<Real>(value));
      break;
    default:
      break;
  }
}

/// Where a single number stands in its struct.
template <class T>
std::size_t offset_of(const T& entry, const typename FieldOf<T>::Member& member) {
  const auto place = [&](const auto& number) {
    return static_cast<std::size_t>(reinterpret_cast<const std::byte*>(&number) -
                                    reinterpret_cast<const std::byte*>(&entry));
  };
  if (auto* integer = std::get_if<int T::*>(&member)) return place(entry.*(*integer));
  if (auto* id = std::get_if<Id T::*>(&member)) return place(entry.*(*id));
  if (auto* real = std::get_if<Real T::*>(&member)) return place(entry.*(*real));
  return 0;
}

/// What the ids in a field number.
template <class T>
IdSpace space_of(const KeywordOf<T>& keyword, std::size_t card, std::size_t field, const T& entry) {
  if (card == 0 && field == 0 && !keyword.id && keyword.id_space != IdSpace::none) return keyword.id_space;
  const FieldOf<T>& f = keyword.cards[card].fields[field];
  return f.refers ? f.refers(entry) : f.rules.refers;
}

template <class T>
void convert_field(const KeywordOf<T>& keyword, std::size_t card, std::size_t field,
                   const Conversion& conversion, T& entry) {
  const FieldOf<T>& f = keyword.cards[card].fields[field];
  const IdSpace space = space_of(keyword, card, field, entry);
  const Real factor = conversion.units.of(f.dimension);
  if (auto* id = std::get_if<Id T::*>(&f.member)) {
    entry.*(*id) = conversion.offsets.shifted(space, entry.*(*id));
  } else if (auto* ids = std::get_if<std::vector<Id> T::*>(&f.member)) {
    for (Id& one : entry.*(*ids)) one = conversion.offsets.shifted(space, one);
  } else if (auto* real = std::get_if<Real T::*>(&f.member)) {
    // a standard value ("1e20", never) is no number in the file's units
    if (entry.*(*real) != f.rules.standard) entry.*(*real) *= factor;
  } else if (auto* reals = std::get_if<std::vector<Real> T::*>(&f.member)) {
    for (Real& one : entry.*(*reals)) one *= factor;
  }
}

/// A title with what *INCLUDE_TRANSFORM puts before and behind it.
inline std::string converted_title(const Conversion& conversion, const std::string& title) {
  std::string out = conversion.prefix.empty() ? title : conversion.prefix + "." + title;
  return conversion.suffix.empty() ? out : out + "." + conversion.suffix;
}

template <class T>
void move_fields(const KeywordOf<T>& keyword, const Affine& motion, T& entry) {
  for (const CardOf<T>& card : keyword.cards) {
    for (std::size_t f = 0; f + 2 < card.fields.size(); ++f) {
      if (card.fields[f].rules.spatial == Spatial::none) continue;
      const auto component = [&](std::size_t k) -> Real& {
        return entry.*(*std::get_if<Real T::*>(&card.fields[f + k].member));
      };
      const Vec old(component(0), component(1), component(2));
      const Vec now =
          card.fields[f].rules.spatial == Spatial::point ? Vec(motion * old) : Vec(motion.linear() * old);
      for (std::size_t k = 0; k < 3; ++k) component(k) = now[static_cast<Eigen::Index>(k)];
    }
  }
}

template <class T>
class EntrySinkOf : public EntrySink {
 public:
  EntrySinkOf(const KeywordOf<T>& keyword, const T& standard, std::vector<T>& store)
      : keyword_(keyword), standard_(standard), store_(store) {}
  void expect(std::size_t entries) override {
    const std::size_t wanted = store_.size() + entries;
    // at least twice as many, so that a thousand short blocks do not move what is there a thousand times
    if (wanted > store_.capacity()) store_.reserve(std::max(wanted, 2 * store_.capacity()));
  }
  void begin(const Entry& where) override {
    entry_ = standard_;
    static_cast<Entry&>(entry_) = where;
  }
  void set_integer(std::size_t card, std::size_t field, Id value) override {
    set_number<T>(entry_, keyword_.cards[card].fields[field].member, value);
  }
  void set_real(std::size_t card, std::size_t field, Real value) override {
    set_number<T>(entry_, keyword_.cards[card].fields[field].member, value);
  }
  void set_text(std::size_t card, std::size_t field, std::string_view value) override {
    const auto& member = keyword_.cards[card].fields[field].member;
    if (auto* text = std::get_if<std::string T::*>(&member)) entry_.*(*text) = value;
    if (auto* texts = std::get_if<std::vector<std::string> T::*>(&member))
      (entry_.*(*texts)).emplace_back(value);
  }
  void set_title(std::string_view title) override {
    if (keyword_.title) entry_.*(keyword_.title) = title;
  }
  void set_id(Id id) override {
    if (keyword_.id) entry_.*(keyword_.id) = id;
  }
  const Entry& entry() const override { return entry_; }
  std::byte* fields() override { return reinterpret_cast<std::byte*>(&entry_); }
  std::string convert(const Conversion& conversion) override {
    for (std::size_t c = 0; c < keyword_.cards.size(); ++c)
      for (std::size_t f = 0; f < keyword_.cards[c].fields.size(); ++f)
        convert_field(keyword_, c, f, conversion, entry_);
    if (keyword_.id)
      entry_.*(keyword_.id) = conversion.offsets.shifted(keyword_.id_space, entry_.*(keyword_.id));
    if (keyword_.title) entry_.*(keyword_.title) = converted_title(conversion, entry_.*(keyword_.title));
    return keyword_.convert ? keyword_.convert(entry_, conversion) : std::string();
  }
  void commit() override { store_.push_back(std::move(entry_)); }

 private:
  const KeywordOf<T>& keyword_;
  const T& standard_;
  std::vector<T>& store_;
  T entry_{};
};

template <class T>
class KeywordSpecOf : public KeywordSpec {
 public:
  explicit KeywordSpecOf(KeywordOf<T> keyword) : keyword_(std::move(keyword)) {
    names = keyword_.names;
    purpose = keyword_.purpose;
    id_space = keyword_.id_space;
    lacking = keyword_.lacking;
    title_option = keyword_.title_option;
    id_option = keyword_.id_option;
    mpp_option = keyword_.mpp_option;
    collect_option = keyword_.collect_option;
    heading = keyword_.heading;
    once = keyword_.once;
    many = keyword_.many;
    for (const CardOf<T>& card : keyword_.cards) add_card(card);
  }
  std::unique_ptr<EntrySink> sink(Deck& deck) const override {
    return std::make_unique<EntrySinkOf<T>>(keyword_, standard_, deck.store<T>());
  }
  bool has_card(const Entry& entry, std::size_t card) const override {
    const auto& when = keyword_.cards[card].when;
    return !when || when(static_cast<const T&>(entry));
  }
  Id id_of(const Entry& entry) const override {
    if (id_space == IdSpace::none) return 0;
    const T& e = static_cast<const T&>(entry);
    if (keyword_.id) return e.*(keyword_.id);
    const auto* member = std::get_if<Id T::*>(&keyword_.cards[0].fields[0].member);
    return member ? e.*(*member) : 0;
  }
  void for_each(const Deck& deck, std::int32_t keyword,
                const std::function<void(const Entry&)>& visit) const override {
    for (const T& entry : deck.all<T>())
      if (entry.keyword == keyword) visit(entry);
  }
  void for_each_id(const Entry& entry, const std::function<void(const IdUse&)>& visit) const override {
    const T& e = static_cast<const T&>(entry);
    if (keyword_.id) visit({0, 0, id_space, e.*(keyword_.id), true});
    for (std::size_t c = 0; c < keyword_.cards.size(); ++c) {
      for (std::size_t f = 0; f < keyword_.cards[c].fields.size(); ++f) {
        const IdSpace space = space_of(keyword_, c, f, e);
        if (space == IdSpace::none) continue;
        const bool own = c == 0 && f == 0 && !keyword_.id && id_space != IdSpace::none;
        const auto& member = keyword_.cards[c].fields[f].member;
        if (auto* id = std::get_if<Id T::*>(&member)) visit({c, f, space, e.*(*id), own});
        if (auto* ids = std::get_if<std::vector<Id> T::*>(&member))
          for (const Id one : e.*(*ids)) visit({c, f, space, one, own});
      }
    }
  }
  Real number_of(const Entry& entry, std::size_t card, std::size_t field) const override {
    const T& e = static_cast<const T&>(entry);
    const auto& member = keyword_.cards[card].fields[field].member;
    if (auto* integer = std::get_if<int T::*>(&member)) return e.*(*integer);
    if (auto* id = std::get_if<Id T::*>(&member)) return static_cast<Real>(e.*(*id));
    if (auto* real = std::get_if<Real T::*>(&member)) return e.*(*real);
    return 0;
  }
  std::string text_of(const Entry& entry, std::size_t card, std::size_t field) const override {
    const T& e = static_cast<const T&>(entry);
    const auto& member = keyword_.cards[card].fields[field].member;
    if (auto* text = std::get_if<std::string T::*>(&member)) return e.*(*text);
    std::string out;
    const auto add = [&](const auto& values) {
      for (const auto& value : values) out += fmt::format("{}{}", out.empty() ? "" : " ", value);
    };
    if (auto* ids = std::get_if<std::vector<Id> T::*>(&member)) add(e.*(*ids));
    if (auto* reals = std::get_if<std::vector<Real> T::*>(&member)) add(e.*(*reals));
    if (auto* texts = std::get_if<std::vector<std::string> T::*>(&member)) add(e.*(*texts));
    return out;
  }
  void move(Deck& deck, std::int32_t keyword, const std::function<const Affine*(const Entry&)>& motion_of,
            const std::function<void(const Entry&, const std::string&)>& refuse) const override {
    for (T& entry : deck.store<T>()) {
      const Affine* motion = entry.keyword == keyword ? motion_of(entry) : nullptr;
      if (!motion) continue;
      move_fields(keyword_, *motion, entry);
      const std::string reason = keyword_.move ? keyword_.move(entry, *motion) : std::string();
      if (!reason.empty()) refuse(entry, reason);
    }
  }

 private:
  void add_card(const CardOf<T>& card) {
    CardSpec spec{
        .fields = {}, .optional = card.optional, .repeat = card.repeat, .conditional = card.when != nullptr};
    int column = 0, vectors = 0;
    for (const FieldOf<T>& f : card.fields) {
      FieldSpec field{.name = f.name,
                      .dimension = f.dimension,
                      .meaning = f.meaning,
                      .rules = f.rules,
                      .type = field_type<T>(f.member),
                      .column = column,
                      .takes_rest = false,
                      .offset = offset_of(standard_, f.member)};
      column += f.rules.width;
      vectors += field.is_vector();
      if (!field.is_vector()) set_number<T>(standard_, f.member, f.rules.standard);
      spec.fields.push_back(std::move(field));
    }
    // two vectors side by side are columns of a table (abscissa, ordinate); a single one is a list
    spec.is_table = vectors > 1;
    if (vectors == 1 && spec.fields.back().is_vector()) spec.fields.back().takes_rest = true;
    cards.push_back(std::move(spec));
  }

  KeywordOf<T> keyword_;
  T standard_{};
};

}  // namespace detail

template <class T>
std::shared_ptr<const KeywordSpec> make_keyword_spec(KeywordOf<T> keyword) {
  return std::make_shared<detail::KeywordSpecOf<T>>(std::move(keyword));
}

}  // namespace courant
