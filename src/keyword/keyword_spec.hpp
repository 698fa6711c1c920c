#pragma once
// The type-erased form of a keyword's table: what the reader, the messages and the documentation need,
// without the struct.
#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "keyword/card.hpp"
#include "keyword/deck.hpp"

namespace courant {

enum class FieldType { integer, id, real, text, ids, reals, texts, skip };

/// One field of a card, with its place in standard format and in the keyword's struct.
struct FieldSpec {
  std::string_view name, dimension, meaning;
  FieldRules rules;
  FieldType type = FieldType::skip;
  std::size_t offset = 0;   ///< of its value from the start of the entry
  bool dependent = false;   ///< what its ids number depends on other fields
  int column = 0;           ///< first column in standard format, from 0
  bool takes_rest = false;  ///< a vector that takes all further columns of the card
  bool is_vector() const {
    return type == FieldType::ids || type == FieldType::reals || type == FieldType::texts;
  }
};

struct CardSpec {
  std::vector<FieldSpec> fields;
  bool optional = false;
  bool repeat = false;
  bool until_entry = false;  ///< repeats up to the next entry, see CardOf
  bool whole_lines = false;  ///< see CardOf
  bool conditional = false;  ///< there only under a condition, see KeywordSpec::has_card
  bool counted = false;      ///< repeats under a condition, see KeywordSpec::has_more
  bool is_table = false;     ///< several vectors: each card adds one to each of them
};

/// An id in a field of an entry.
struct IdUse {
  std::size_t card = 0, field = 0;
  IdSpace space = IdSpace::none;
  Id id = 0;             ///< as it stands, 0 and negative ones too
  bool defines = false;  ///< the entry's own id
};

class EntrySink;

/// Entries that are handed in must be of this keyword.
class KeywordSpec {
 public:
  virtual ~KeywordSpec() = default;
  virtual std::unique_ptr<EntrySink> sink(Deck& deck) const = 0;
  /// Whether the card is there, as far as the entry was read.
  virtual bool has_card(const Entry& entry, std::size_t card) const = 0;
  /// Whether a repeated card goes on behind the rows read so far, see CardOf::more.
  virtual bool has_more(const Entry& entry, std::size_t card) const = 0;
  /// All entries of the keyword with this place in the registry.
  virtual void for_each(const Deck& deck, std::int32_t keyword,
                        const std::function<void(const Entry&)>& visit) const = 0;
  /// Drops the entries of this keyword under one of its names but the last.
  virtual void keep_last(Deck& deck, std::int32_t keyword, std::int32_t name) const = 0;

  /// The entry's id (with _ID that of its line, else the first field), 0 where there is no id_space.
  Id id_of(const Entry& entry) const;
  /// All ids in an entry's fields, its own first.
  void for_each_id(const Entry& entry, const std::function<void(const IdUse&)>& visit) const;
  /// The number in a field of an entry; 0 for texts, lists and skipped columns.
  Real number_of(const Entry& entry, std::size_t card, std::size_t field) const;
  /// Texts and lists in a field: their values with all digits, apart by blanks; "" for single numbers.
  std::string text_of(const Entry& entry, std::size_t card, std::size_t field) const;
  /// Shifts ids and changes units; returns why it cannot be done, else nothing.
  std::string convert(Entry& entry, const Conversion& conversion) const;
  /// Moves the places and directions in the entries for which `motion_of` gives a motion. `refuse` hears why
  /// an entry cannot be moved.
  void move(Deck& deck, std::int32_t keyword, const std::function<const Affine*(const Entry&)>& motion_of,
            const std::function<void(const Entry&, const std::string&)>& refuse) const;

  std::vector<std::string> names;
  std::string purpose, lacking;
  IdSpace id_space = IdSpace::none;
  bool title_option = false, id_option = false, mpp_option = false, collect_option = false;
  bool id_may_repeat = false, heading = false, once = false, many = true;
  std::optional<std::size_t> title, id, local;  ///< offsets of these members of KeywordOf
  std::vector<CardSpec> cards;

 protected:
  /// Adds a card of which `fields` lack their columns, and sets the fields of `standard` to their defaults.
  void add_card(CardSpec card, Entry& standard);

 private:
  virtual void change_each(Deck& deck, std::int32_t keyword,
                           const std::function<void(Entry&)>& change) const = 0;
  virtual IdSpace dependent_space(const Entry& entry, std::size_t card, std::size_t field) const = 0;
  /// KeywordOf::convert and move.
  virtual std::string convert_rest(Entry& entry, const Conversion& conversion) const = 0;
  virtual std::string move_rest(Entry& entry, const Affine& motion) const = 0;

  IdSpace space_of(const Entry& entry, std::size_t card, std::size_t field) const;
  bool is_own_id(std::size_t card, std::size_t field) const;
  /// Card and field of each member, once: where it stands in several cards, of which a set has one, the one
  /// that is there.
  void for_each_member(const Entry& entry,
                       const std::function<void(std::size_t card, std::size_t field)>& visit) const;
  bool shares_members_ = false;  ///< some member stands in several cards
};

/// Builds the entries of one keyword, one after the other, and stores them in a deck.
class EntrySink {
 public:
  explicit EntrySink(const KeywordSpec& spec) : spec_(spec) {}
  virtual ~EntrySink() = default;
  virtual void expect(std::size_t entries) = 0;  ///< room for so many more, a hint
  virtual void begin(const Entry& where) = 0;    ///< a new entry, all fields at their standard values
  virtual Entry& entry() = 0;                    ///< the entry as read so far
  virtual void commit() = 0;                     ///< stores the entry in the deck

  void set_integer(std::size_t card, std::size_t field, Id value);  ///< sets or appends
  void set_real(std::size_t card, std::size_t field, Real value);   ///< sets or appends
  void set_text(std::size_t card, std::size_t field, std::string_view value);
  void set_title(std::string_view title);
  void set_id(Id id);
  std::string convert(const Conversion& conversion) { return spec_.convert(entry(), conversion); }
  std::byte* fields() { return reinterpret_cast<std::byte*>(&entry()); }  ///< see FieldSpec::offset

 private:
  const KeywordSpec& spec_;
};

namespace detail {

template <class T>
FieldType field_type(const typename FieldOf<T>::Member& member) {
  // in the order of FieldOf::Member
  constexpr FieldType types[] = {FieldType::skip, FieldType::integer, FieldType::id,    FieldType::real,
                                 FieldType::text, FieldType::ids,     FieldType::reals, FieldType::texts};
  return types[member.index()];
}

/// Where a value stands in its struct.
template <class T, class Value>
std::size_t offset_of(const T& entry, Value T::*member) {
  return static_cast<std::size_t>(reinterpret_cast<const std::byte*>(&(entry.*member)) -
                                  reinterpret_cast<const std::byte*>(static_cast<const Entry*>(&entry)));
}
template <class T>
std::size_t offset_of(const T& entry, const typename FieldOf<T>::Member& member) {
  std::size_t offset = 0;
  const auto look = [&]<class Value>(Value T::*const* value) {
    if (value) offset = offset_of(entry, *value);
  };
  look(std::get_if<1>(&member)), look(std::get_if<2>(&member)), look(std::get_if<3>(&member));
  look(std::get_if<4>(&member)), look(std::get_if<5>(&member)), look(std::get_if<6>(&member));
  look(std::get_if<7>(&member));
  return offset;
}

/// `Table`: the struct whose members the cards fill, T itself or a base of it that has all its members.
template <class T, class Table>
class EntrySinkOf : public EntrySink {
 public:
  EntrySinkOf(const KeywordSpec& spec, const Table& standard, std::vector<T>& store)
      : EntrySink(spec), standard_(standard), store_(store) {}
  void expect(std::size_t entries) override {
    const std::size_t wanted = store_.size() + entries;
    // at least twice as many, so that a thousand short blocks do not move what is there a thousand times
    if (wanted > store_.capacity()) store_.reserve(std::max(wanted, 2 * store_.capacity()));
  }
  void begin(const Entry& where) override {
    static_cast<Table&>(entry_) = standard_;
    static_cast<Entry&>(entry_) = where;
  }
  Entry& entry() override { return entry_; }
  void commit() override { store_.push_back(std::move(entry_)); }

 private:
  const Table& standard_;
  std::vector<T>& store_;
  T entry_{};
};

/// What takes the struct of the cards; all else is done by KeywordSpec with the places of its fields. It is
/// compiled for each such struct: every line counts.
template <class Table>
class TableSpec : public KeywordSpec {
 public:
  explicit TableSpec(KeywordOf<Table>&& keyword)
      : own_cards_(std::move(keyword.cards)), convert_(keyword.convert), move_(keyword.move) {
    names = std::move(keyword.names), purpose = std::move(keyword.purpose);
    lacking = std::move(keyword.lacking), id_space = keyword.id_space;
    title_option = keyword.title_option, id_option = keyword.id_option, mpp_option = keyword.mpp_option;
    collect_option = keyword.collect_option, id_may_repeat = keyword.id_may_repeat;
    heading = keyword.heading;
    once = keyword.once, many = keyword.many;
    if (keyword.title) title = offset_of(standard_, keyword.title);
    if (keyword.id) id = offset_of(standard_, keyword.id);
    if (keyword.local) local = offset_of(standard_, keyword.local);
    for (const CardOf<Table>& card : own_cards_) {
      CardSpec spec{.fields = std::vector<FieldSpec>(card.fields.size()),
                    .optional = card.optional,
                    .repeat = card.repeat,
                    .until_entry = card.until_entry,
                    .whole_lines = card.whole_lines,
                    .conditional = card.when != nullptr,
                    .counted = card.more != nullptr};
      for (std::size_t f = 0; f < card.fields.size(); ++f) {
        const FieldOf<Table>& field = card.fields[f];
        spec.fields[f] = {field.name,
                          field.dimension,
                          field.meaning,
                          field.rules,
                          field_type<Table>(field.member),
                          offset_of(standard_, field.member),
                          field.refers != nullptr};
      }
      add_card(std::move(spec), standard_);
    }
  }
  bool has_card(const Entry& entry, std::size_t card) const override {
    const auto when = own_cards_[card].when;
    return !when || when(static_cast<const Table&>(entry));
  }
  bool has_more(const Entry& entry, std::size_t card) const override {
    const auto more = own_cards_[card].more;
    return !more || more(static_cast<const Table&>(entry));
  }

 protected:
  Table standard_{};

 private:
  IdSpace dependent_space(const Entry& entry, std::size_t card, std::size_t field) const override {
    return own_cards_[card].fields[field].refers(static_cast<const Table&>(entry));
  }
  std::string convert_rest(Entry& entry, const Conversion& conversion) const override {
    return convert_ ? convert_(static_cast<Table&>(entry), conversion) : std::string();
  }
  std::string move_rest(Entry& entry, const Affine& motion) const override {
    return move_ ? move_(static_cast<Table&>(entry), motion) : std::string();
  }

  std::vector<CardOf<Table>> own_cards_;
  std::string (*convert_)(Table&, const Conversion&);
  std::string (*move_)(Table&, const Affine&);
};

/// What takes the type by which the deck stores the entries.
template <class T, class Table>
class KeywordSpecOf : public TableSpec<Table> {
  static_assert(std::is_base_of_v<Table, T> && sizeof(T) == sizeof(Table));

 public:
  using TableSpec<Table>::TableSpec;
  std::unique_ptr<EntrySink> sink(Deck& deck) const override {
    return std::make_unique<EntrySinkOf<T, Table>>(*this, this->standard_, deck.store<T>());
  }
  void for_each(const Deck& deck, std::int32_t keyword,
                const std::function<void(const Entry&)>& visit) const override {
    for (const T& entry : deck.all<T>())
      if (entry.keyword == keyword) visit(entry);
  }
  void keep_last(Deck& deck, std::int32_t keyword, std::int32_t name) const override {
    const auto is_one = [&](const Entry& entry) { return entry.keyword == keyword && entry.name == name; };
    std::vector<T>& all = deck.store<T>();
    const auto last = std::find_if(all.rbegin(), all.rend(), is_one);
    if (last != all.rend()) all.erase(std::remove_if(all.begin(), last.base() - 1, is_one), last.base() - 1);
  }

 private:
  void change_each(Deck& deck, std::int32_t keyword,
                   const std::function<void(Entry&)>& change) const override {
    for (T& entry : deck.store<T>())
      if (entry.keyword == keyword) change(entry);
  }
};

}  // namespace detail

/// Of a keyword whose entries are stored as T and whose cards fill the members of `Table`.
template <class T, class Table>
std::unique_ptr<const KeywordSpec> make_keyword_spec(KeywordOf<Table>&& keyword) {
  return std::unique_ptr<const KeywordSpec>(new detail::KeywordSpecOf<T, Table>(std::move(keyword)));
}

}  // namespace courant
