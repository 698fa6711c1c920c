#pragma once
// The table of a keyword, used by the reader, the messages and the documentation. The build makes such
// tables, with the structs of the entries, of the files *_cards.yaml (cmake/keyword_tables.cpp).
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "keyword/card.hpp"

namespace courant {

enum class FieldType { skip, integer, id, real, text, ids, reals, texts };

/// Type of the value of a field, and its offset in the entry.
struct FieldMember {
  FieldType type = FieldType::skip;
  std::size_t offset = 0;
  bool is_vector() const {
    return type == FieldType::ids || type == FieldType::reals || type == FieldType::texts;
  }
};

/// One field of a card.
struct FieldSpec : FieldMember {
  std::string_view name, dimension, meaning;
  FieldRules rules;
  /// Id space where it depends on other fields (a type beside it); instead of rules.refers.
  std::function<IdSpace(const Entry&)> refers{};
  /// Dimensions of the curve where they depend on other fields; instead of rules.curve.
  std::function<CurveOf(const Entry&)> curve_of{};
  int column = 0;           ///< first column in standard format, from 0
  bool takes_rest = false;  ///< a vector that takes all further columns of the card
};

struct CardSpec {
  std::vector<FieldSpec> fields;
  bool optional = false;     ///< may be missing at the end of the keyword
  bool repeat = false;       ///< repeats up to the next keyword, filling vectors
  bool until_entry = false;  ///< repeats up to the next entry, see CardOf
  bool whole_lines = false;  ///< see CardOf
  /// Of a repeated card: it ends where this does not hold for the rows read so far.
  std::function<bool(const Entry&)> more{};
  std::function<bool(const Entry&)> when{};  ///< the card is there if this holds for the cards read so far
  bool is_table = false;                     ///< several vectors: each card adds one to each of them
};

/// Names, options and cards of a keyword; see KeywordOf for what each member means.
struct KeywordTable {
  std::vector<std::string> names;
  std::string purpose, lacking{};
  IdSpace id_space = IdSpace::none;
  bool title_option = false, id_option = false, mpp_option = false, collect_option = false;
  bool id_may_repeat = false, heading = false, once = false, many = true;
  std::optional<std::size_t> title{}, id{}, local{};  ///< offsets
  std::vector<CardSpec> cards{};
  std::function<std::string(Entry&, const Conversion&)> convert_rest{};
  std::function<std::string(Entry&, const Affine&)> move_rest{};
};

/// Of a member of an entry.
template <class T, class Value>
FieldMember member(Value T::*member) {
  static const T sample{};
  const auto* begin = reinterpret_cast<const std::byte*>(static_cast<const Entry*>(&sample));
  FieldMember out{FieldType::text,
                  static_cast<std::size_t>(reinterpret_cast<const std::byte*>(&(sample.*member)) - begin)};
  if constexpr (std::is_same_v<Value, int>) out.type = FieldType::integer;
  if constexpr (std::is_same_v<Value, Id>) out.type = FieldType::id;
  if constexpr (std::is_same_v<Value, Real>) out.type = FieldType::real;
  if constexpr (std::is_same_v<Value, std::vector<Id>>) out.type = FieldType::ids;
  if constexpr (std::is_same_v<Value, std::vector<Real>>) out.type = FieldType::reals;
  if constexpr (std::is_same_v<Value, std::vector<std::string>>) out.type = FieldType::texts;
  return out;
}

namespace detail {

template <class T>
FieldMember member_of(const typename FieldOf<T>::Member& any) {
  FieldMember out;
  const auto look = [&]<class Value>(Value T::*const* value) {
    if (value) out = member(*value);
  };
  look(std::get_if<1>(&any)), look(std::get_if<2>(&any)), look(std::get_if<3>(&any));
  look(std::get_if<4>(&any)), look(std::get_if<5>(&any)), look(std::get_if<6>(&any));
  look(std::get_if<7>(&any));
  return out;
}

/// A function of entries of type T as one of Entry.
template <class T, class Out, class... More>
std::function<Out(const Entry&, More...)> of_entry(Out (*function)(const T&, More...)) {
  if (!function) return {};
  return [function](const Entry& e, More... more) { return function(static_cast<const T&>(e), more...); };
}

}  // namespace detail

/// It is compiled for each struct, so it must be short.
template <class T>
KeywordTable table_of(KeywordOf<T> keyword) {
  KeywordTable out{.names = std::move(keyword.names),
                   .purpose = std::move(keyword.purpose),
                   .lacking = std::move(keyword.lacking),
                   .id_space = keyword.id_space,
                   .title_option = keyword.title_option,
                   .id_option = keyword.id_option,
                   .mpp_option = keyword.mpp_option,
                   .collect_option = keyword.collect_option,
                   .id_may_repeat = keyword.id_may_repeat,
                   .heading = keyword.heading,
                   .once = keyword.once,
                   .many = keyword.many};
  if (keyword.title) out.title = member(keyword.title).offset;
  if (keyword.id) out.id = member(keyword.id).offset;
  if (keyword.local) out.local = member(keyword.local).offset;
  if (const auto convert = keyword.convert)
    out.convert_rest = [convert](Entry& e, const Conversion& by) { return convert(static_cast<T&>(e), by); };
  if (const auto move = keyword.move)
    out.move_rest = [move](Entry& e, const Affine& by) { return move(static_cast<T&>(e), by); };
  for (const CardOf<T>& card : keyword.cards) {
    CardSpec& spec = out.cards.emplace_back(CardSpec{.fields = {},
                                                     .optional = card.optional,
                                                     .repeat = card.repeat,
                                                     .until_entry = card.until_entry,
                                                     .whole_lines = card.whole_lines,
                                                     .more = detail::of_entry(card.more),
                                                     .when = detail::of_entry(card.when)});
    for (const FieldOf<T>& field : card.fields)
      spec.fields.push_back({detail::member_of<T>(field.member), field.name, field.dimension, field.meaning,
                             field.rules, detail::of_entry(field.refers), detail::of_entry(field.curve_of)});
  }
  return out;
}

}  // namespace courant
