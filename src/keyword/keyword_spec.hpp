#pragma once
// The type-erased form of a keyword: its table, and the storage of its entries in a deck.
#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "keyword/deck.hpp"
#include "keyword/keyword_table.hpp"

namespace courant {

/// An id in a field of an entry.
struct IdUse {
  std::size_t card = 0, field = 0;
  IdSpace space = IdSpace::none;
  Id id = 0;             ///< as in the deck, also 0 and negative ones
  bool defines = false;  ///< the entry's own id
};

class EntrySink;

/// Entries passed to its functions must be of this keyword.
class KeywordSpec : public KeywordTable {
 public:
  explicit KeywordSpec(KeywordTable table) : KeywordTable(std::move(table)) {}
  virtual ~KeywordSpec() = default;
  virtual std::unique_ptr<EntrySink> sink(Deck& deck) const = 0;
  /// All entries of the keyword with this location in the registry.
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
  /// Texts and lists in a field: their values with all digits, separated by blanks; "" for single numbers.
  std::string text_of(const Entry& entry, std::size_t card, std::size_t field) const;
  /// Shifts ids and changes units; returns the reason if it is impossible, otherwise nothing.
  std::string convert(Entry& entry, const Conversion& conversion) const;
  /// Moves the locations and directions in the entries for which `motion_of` gives a motion. `refuse` gets
  /// the reason why an entry cannot be moved.
  void move(Deck& deck, std::int32_t keyword, const std::function<const Affine*(const Entry&)>& motion_of,
            const std::function<void(const Entry&, const std::string&)>& refuse) const;

 protected:
  /// Finds columns and lists, and sets the fields of `standard` to their defaults.
  void complete(Entry& standard);

 private:
  virtual void change_each(Deck& deck, std::int32_t keyword,
                           const std::function<void(Entry&)>& change) const = 0;

  IdSpace space_of(const Entry& entry, std::size_t card, std::size_t field) const;
  bool is_own_id(std::size_t card, std::size_t field) const;
  /// Card and field of each member, once: where it is in several cards, of which a set has one, in that card.
  void for_each_member(const Entry& entry,
                       const std::function<void(std::size_t card, std::size_t field)>& visit) const;
  bool shares_members_ = false;  ///< some member is in several cards
};

/// Builds the entries of one keyword, one after the other, and stores them in a deck.
class EntrySink {
 public:
  explicit EntrySink(const KeywordSpec& spec) : spec_(spec) {}
  virtual ~EntrySink() = default;
  virtual void expect(std::size_t entries) = 0;  ///< a hint: the number of entries to come
  virtual void begin(const Entry& where) = 0;    ///< a new entry, all fields at their standard values
  virtual Entry& entry() = 0;                    ///< the entry as read so far
  virtual void commit() = 0;                     ///< stores the entry in the deck

  void set_integer(std::size_t card, std::size_t field, Id value);  ///< sets or appends
  void set_real(std::size_t card, std::size_t field, Real value);   ///< sets or appends
  void set_text(std::size_t card, std::size_t field, std::string_view value);
  void set_title(std::string_view title);
  void set_id(Id id);
  std::string convert(const Conversion& conversion) { return spec_.convert(entry(), conversion); }
  std::byte* fields() { return reinterpret_cast<std::byte*>(&entry()); }  ///< see FieldMember::offset

 private:
  const KeywordSpec& spec_;
};

/// The part that depends on the type of the stored entries. It is compiled for each such type, so it must be
/// short.
template <class T>
class KeywordSpecOf : public KeywordSpec {
  class Sink : public EntrySink {
   public:
    Sink(const KeywordSpecOf& spec, std::vector<T>& store)
        : EntrySink(spec), standard_(spec.standard_), store_(store) {}
    void expect(std::size_t entries) override {
      const std::size_t wanted = store_.size() + entries;
      // at least twice as many, so that a thousand short blocks do not move the entries a thousand times
      if (wanted > store_.capacity()) store_.reserve(std::max(wanted, 2 * store_.capacity()));
    }
    void begin(const Entry& where) override { entry_ = standard_, static_cast<Entry&>(entry_) = where; }
    Entry& entry() override { return entry_; }
    void commit() override { store_.push_back(std::move(entry_)); }

   private:
    const T& standard_;
    std::vector<T>& store_;
    T entry_{};
  };

 public:
  explicit KeywordSpecOf(KeywordTable table) : KeywordSpec(std::move(table)) { complete(standard_); }
  std::unique_ptr<EntrySink> sink(Deck& deck) const override {
    return std::make_unique<Sink>(*this, deck.store<T>());
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
  T standard_{};
};

/// Of a keyword whose entries are stored as T.
template <class T>
std::unique_ptr<const KeywordSpec> make_keyword_spec(KeywordTable table) {
  return std::make_unique<KeywordSpecOf<T>>(std::move(table));
}
/// Of one whose cards fill the members of `Table`, T itself or a base of it that has all its members.
template <class T, class Table>
std::unique_ptr<const KeywordSpec> make_keyword_spec(KeywordOf<Table>&& keyword) {
  return make_keyword_spec<T>(table_of(std::move(keyword)));
}

}  // namespace courant
