#pragma once
// The type-erased form of a keyword's table: what the reader, the messages and the documentation need,
// without the struct.
#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "keyword/card.hpp"
#include "keyword/deck.hpp"

namespace courant {

enum class FieldType { integer, id, real, text, ids, reals, skip };

/// One field of a card, with its place in standard format.
struct FieldSpec {
  std::string name, dimension, meaning;
  FieldRules rules;
  FieldType type = FieldType::skip;
  int column = 0;           ///< first column in standard format, from 0
  bool takes_rest = false;  ///< a vector that takes all further columns of the card
  bool is_vector() const { return type == FieldType::ids || type == FieldType::reals; }
};

struct CardSpec {
  std::vector<FieldSpec> fields;
  bool optional = false;
  bool repeat = false;
  bool conditional = false;  ///< there only under a condition, see KeywordSpec::has_card
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
  virtual void commit() = 0;               ///< stores the entry in the deck
};

class KeywordSpec {
 public:
  virtual ~KeywordSpec() = default;
  virtual std::unique_ptr<EntrySink> sink(Deck& deck) const = 0;
  /// Whether the card is there, as far as the entry was read. `entry` must be of this keyword.
  virtual bool has_card(const Entry& entry, std::size_t card) const = 0;
  /// The entry's id (first field of the first card), 0 where there is no id_space. `entry` must be of this
  /// keyword.
  virtual Id id_of(const Entry& entry) const = 0;

  std::vector<std::string> names;
  std::string purpose, id_space;
  bool title_option = false, id_option = false, heading = false, once = false, many = true;
  std::vector<CardSpec> cards;
};

namespace detail {

template <class T>
FieldType field_type(const typename FieldOf<T>::Member& member) {
  // in the order of FieldOf::Member
  constexpr FieldType types[] = {FieldType::skip, FieldType::integer, FieldType::id,   FieldType::real,
                                 FieldType::text, FieldType::ids,     FieldType::reals};
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
    if (auto* text = std::get_if<std::string T::*>(&keyword_.cards[card].fields[field].member))
      entry_.*(*text) = value;
  }
  void set_title(std::string_view title) override {
    if (keyword_.title) entry_.*(keyword_.title) = title;
  }
  void set_id(Id id) override {
    if (keyword_.id) entry_.*(keyword_.id) = id;
  }
  const Entry& entry() const override { return entry_; }
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
    title_option = keyword_.title_option;
    id_option = keyword_.id_option;
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
    if (id_space.empty()) return 0;
    const auto* member = std::get_if<Id T::*>(&keyword_.cards[0].fields[0].member);
    return member ? static_cast<const T&>(entry).*(*member) : 0;
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
                      .takes_rest = false};
      column += f.rules.width;
      vectors += field.is_vector();
      if (!field.is_vector()) set_number<T>(standard_, f.member, f.rules.standard);
      spec.fields.push_back(std::move(field));
    }
    // two vectors side by side are columns of a table (abscissa, ordinate); a single one is a list
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
