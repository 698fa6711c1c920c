#include "keyword/keyword_spec.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace courant {

namespace {

template <class Value>
Value& value_at(Entry& entry, std::size_t offset) {
  return *reinterpret_cast<Value*>(reinterpret_cast<std::byte*>(&entry) + offset);
}
template <class Value>
const Value& value_at(const Entry& entry, std::size_t offset) {
  return *reinterpret_cast<const Value*>(reinterpret_cast<const std::byte*>(&entry) + offset);
}

/// Sets a number or appends it to a list of numbers; nothing for texts.
void set_number(Entry& entry, const FieldSpec& field, auto value) {
  switch (field.type) {
    case FieldType::integer:
      value_at<int>(entry, field.offset) = static_cast<int>(value);
      break;
    case FieldType::id:
      value_at<Id>(entry, field.offset) = static_cast<Id>(value);
      break;
    case FieldType::real:
      value_at<Real>(entry, field.offset) = static_cast<Real>(value);
      break;
    case FieldType::ids:
      value_at<std::vector<Id>>(entry, field.offset).push_back(static_cast<Id>(value));
      break;
    case FieldType::reals:
      value_at<std::vector<Real>>(entry, field.offset).push_back(static_cast<Real>(value));
      break;
    case FieldType::text:
    case FieldType::texts:
    case FieldType::skip:
      break;
  }
}

void convert_field(Entry& entry, const FieldSpec& field, IdSpace space, const Conversion& conversion) {
  const Real factor = conversion.units.of(field.dimension);
  if (field.type == FieldType::id) {
    Id& id = value_at<Id>(entry, field.offset);
    id = conversion.offsets.shifted(space, id);
  } else if (field.type == FieldType::ids) {
    for (Id& one : value_at<std::vector<Id>>(entry, field.offset))
      one = conversion.offsets.shifted(space, one);
  } else if (field.type == FieldType::real) {
    // a standard value ("1e20", never) is no number in the file's units
    Real& real = value_at<Real>(entry, field.offset);
    if (real != field.rules.standard) real *= factor;
  } else if (field.type == FieldType::reals) {
    for (Real& one : value_at<std::vector<Real>>(entry, field.offset)) one *= factor;
  }
}

/// A title with what *INCLUDE_TRANSFORM puts before and behind it.
std::string converted_title(const Conversion& conversion, const std::string& title) {
  std::string out = conversion.prefix.empty() ? title : conversion.prefix + "." + title;
  return conversion.suffix.empty() ? out : out + "." + conversion.suffix;
}

/// A location or direction that begins with this field.
void move_field(Entry& entry, const CardSpec& card, std::size_t f, const Affine& motion) {
  const Spatial spatial = card.fields[f].rules.spatial;
  if (spatial == Spatial::none || f + 2 >= card.fields.size()) return;
  const auto component = [&](std::size_t k) -> Real& {
    return value_at<Real>(entry, card.fields[f + k].offset);
  };
  const Vec old(component(0), component(1), component(2));
  const Vec now = spatial == Spatial::point ? Vec(motion * old) : Vec(motion.linear() * old);
  for (std::size_t k = 0; k < 3; ++k) component(k) = now[static_cast<Eigen::Index>(k)];
}

}  // namespace

bool KeywordSpec::is_own_id(std::size_t card, std::size_t field) const {
  return card == 0 && field == 0 && !id && id_space != IdSpace::none;
}

IdSpace KeywordSpec::space_of(const Entry& entry, std::size_t card, std::size_t field) const {
  if (is_own_id(card, field)) return id_space;
  const FieldSpec& f = cards[card].fields[field];
  return f.refers ? f.refers(entry) : f.rules.refers;
}

Id KeywordSpec::id_of(const Entry& entry) const {
  if (id_space == IdSpace::none) return 0;
  if (id) return value_at<Id>(entry, *id);
  const FieldSpec& first = cards[0].fields[0];
  return first.type == FieldType::id ? value_at<Id>(entry, first.offset) : 0;
}

void KeywordSpec::for_each_id(const Entry& entry, const std::function<void(const IdUse&)>& visit) const {
  if (id) visit({0, 0, id_space, value_at<Id>(entry, *id), true});
  for (std::size_t c = 0; c < cards.size(); ++c) {
    for (std::size_t f = 0; f < cards[c].fields.size(); ++f) {
      const IdSpace space = space_of(entry, c, f);
      if (space == IdSpace::none) continue;
      const FieldSpec& field = cards[c].fields[f];
      const bool own = is_own_id(c, f);
      if (field.type == FieldType::id) visit({c, f, space, value_at<Id>(entry, field.offset), own});
      if (field.type == FieldType::ids)
        for (const Id one : value_at<std::vector<Id>>(entry, field.offset)) visit({c, f, space, one, own});
    }
  }
}

Real KeywordSpec::number_of(const Entry& entry, std::size_t card, std::size_t field) const {
  const FieldSpec& f = cards[card].fields[field];
  if (f.type == FieldType::integer) return value_at<int>(entry, f.offset);
  if (f.type == FieldType::id) return static_cast<Real>(value_at<Id>(entry, f.offset));
  return f.type == FieldType::real ? value_at<Real>(entry, f.offset) : 0;
}

std::string KeywordSpec::text_of(const Entry& entry, std::size_t card, std::size_t field) const {
  const FieldSpec& f = cards[card].fields[field];
  if (f.type == FieldType::text) return value_at<std::string>(entry, f.offset);
  if (f.type == FieldType::ids)
    return fmt::format("{}", fmt::join(value_at<std::vector<Id>>(entry, f.offset), " "));
  if (f.type == FieldType::reals)
    return fmt::format("{}", fmt::join(value_at<std::vector<Real>>(entry, f.offset), " "));
  if (f.type == FieldType::texts)
    return fmt::format("{}", fmt::join(value_at<std::vector<std::string>>(entry, f.offset), " "));
  return {};
}

void KeywordSpec::for_each_member(
    const Entry& entry, const std::function<void(std::size_t card, std::size_t field)>& visit) const {
  std::vector<std::size_t> seen;
  for (const bool there : {true, false})
    for (std::size_t c = 0; c < cards.size(); ++c) {
      const auto& when = cards[c].when;
      if (shares_members_ ? (!when || when(entry)) != there : !there) continue;
      for (std::size_t f = 0; f < cards[c].fields.size(); ++f) {
        const FieldSpec& field = cards[c].fields[f];
        if (shares_members_ && field.type != FieldType::skip) {
          if (std::find(seen.begin(), seen.end(), field.offset) != seen.end()) continue;
          seen.push_back(field.offset);
        }
        visit(c, f);
      }
    }
}

std::string KeywordSpec::convert(Entry& entry, const Conversion& conversion) const {
  for_each_member(entry, [&](std::size_t c, std::size_t f) {
    convert_field(entry, cards[c].fields[f], space_of(entry, c, f), conversion);
  });
  if (id) value_at<Id>(entry, *id) = conversion.offsets.shifted(id_space, value_at<Id>(entry, *id));
  if (title) {
    std::string& text = value_at<std::string>(entry, *title);
    text = converted_title(conversion, text);
  }
  return convert_rest ? convert_rest(entry, conversion) : std::string();
}

void KeywordSpec::move(Deck& deck, std::int32_t keyword,
                       const std::function<const Affine*(const Entry&)>& motion_of,
                       const std::function<void(const Entry&, const std::string&)>& refuse) const {
  change_each(deck, keyword, [&](Entry& entry) {
    const Affine* motion = motion_of(entry);
    if (!motion) return;
    if (!local || value_at<Id>(entry, *local) == 0)
      for_each_member(entry, [&](std::size_t c, std::size_t f) { move_field(entry, cards[c], f, *motion); });
    const std::string reason = move_rest ? move_rest(entry, *motion) : std::string();
    if (!reason.empty()) refuse(entry, reason);
  });
}

void KeywordSpec::complete(Entry& standard) {
  std::vector<std::size_t> offsets;
  for (CardSpec& card : cards) {
    int column = 0, vectors = 0;
    for (FieldSpec& field : card.fields) {
      field.column = column;
      column += field.rules.width;
      vectors += field.is_vector();
      if (field.type == FieldType::skip) continue;
      if (!field.is_vector()) set_number(standard, field, field.rules.standard);
      const bool seen = std::find(offsets.begin(), offsets.end(), field.offset) != offsets.end();
      shares_members_ = shares_members_ || seen;
    }
    for (const FieldSpec& field : card.fields)
      if (field.type != FieldType::skip) offsets.push_back(field.offset);
    // two vectors side by side are columns of a table (abscissa, ordinate); a single one is a list
    card.is_table = vectors > 1;
    if (vectors == 1 && card.fields.back().is_vector()) card.fields.back().takes_rest = true;
  }
}

void EntrySink::set_integer(std::size_t card, std::size_t field, Id value) {
  set_number(entry(), spec_.cards[card].fields[field], value);
}

void EntrySink::set_real(std::size_t card, std::size_t field, Real value) {
  set_number(entry(), spec_.cards[card].fields[field], value);
}

void EntrySink::set_text(std::size_t card, std::size_t field, std::string_view value) {
  const FieldSpec& f = spec_.cards[card].fields[field];
  if (f.type == FieldType::text) value_at<std::string>(entry(), f.offset) = value;
  if (f.type == FieldType::texts) value_at<std::vector<std::string>>(entry(), f.offset).emplace_back(value);
}

void EntrySink::set_title(std::string_view title) {
  if (spec_.title) value_at<std::string>(entry(), *spec_.title) = title;
}

void EntrySink::set_id(Id id) {
  if (spec_.id) value_at<Id>(entry(), *spec_.id) = id;
}

}  // namespace courant
