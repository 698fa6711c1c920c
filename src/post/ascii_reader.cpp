#include "post/ascii_reader.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>
#include <tuple>

namespace courant {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::size_t digits(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && is_digit(text[end])) ++end;
  return end - at;
}

bool starts_with_word(std::string_view text, std::string_view word) {
  return text.size() >= word.size() && std::equal(word.begin(), word.end(), text.begin(), [](char a, char b) {
           return a == std::tolower(static_cast<unsigned char>(b));
         });
}

/// Letters of the exponent at `at`, 0 where there is none: E+05, D-100, and +100 without a letter, as Fortran
/// prints three digits into a field for two.
std::size_t exponent(std::string_view text, std::size_t at) {
  if (at >= text.size()) return 0;
  const bool letter = std::string_view("eEdD").find(text[at]) != std::string_view::npos;
  std::size_t end = at + (letter ? 1 : 0);
  const bool sign = end < text.size() && (text[end] == '+' || text[end] == '-');
  if (sign) ++end;
  const std::size_t count = digits(text, end);
  if (letter) return count >= 1 ? end + count - at : 0;
  const std::size_t after = end + count;
  return sign && count == 3 && (after == text.size() || text[after] != '.') ? after - at : 0;
}

/// From "-0.25D+03" or "0.25-100".
Real value_of(std::string_view mantissa, std::string_view exponent) {
  std::string text(mantissa);
  if (!exponent.empty()) {
    if (!is_digit(exponent[0]) && exponent[0] != '+' && exponent[0] != '-') exponent.remove_prefix(1);
    if (exponent[0] == '+') exponent.remove_prefix(1);  // from_chars knows none
    text += "e" + std::string(exponent);
  }
  Real value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range) {
    const Real size =
        exponent.find('-') == std::string_view::npos ? std::numeric_limits<Real>::infinity() : 0;
    return text[0] == '-' ? -size : size;
  }
  return value;
}

}  // namespace

std::string_view stripped(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

bool take_number(std::string_view& text, Real& value, std::size_t width) {
  std::string_view rest = text;
  while (!rest.empty() && (rest.front() == ' ' || rest.front() == '\t')) rest.remove_prefix(1);
  if (rest.empty()) return false;
  if (rest.front() == '*') {
    const std::size_t stars = std::min(rest.find_first_not_of('*'), rest.size());
    value = std::nan("");
    rest.remove_prefix(width > 0 && stars % width == 0 ? width : stars);
    text = rest;
    return true;
  }
  const std::size_t sign = rest.front() == '-' || rest.front() == '+' ? 1 : 0;
  for (const std::string_view word : {"nan", "infinity", "inf"}) {
    if (!starts_with_word(rest.substr(sign), word)) continue;
    const Real size = word == "nan" ? std::nan("") : std::numeric_limits<Real>::infinity();
    value = rest.front() == '-' ? -size : size;
    text = rest.substr(sign + word.size());
    return true;
  }
  std::size_t end = sign, count = digits(rest, sign);
  end += count;
  if (end < rest.size() && rest[end] == '.') {
    const std::size_t behind = digits(rest, end + 1);
    count += behind;
    end += 1 + behind;
  }
  if (count == 0) return false;
  const std::size_t letters = exponent(rest, end);
  const std::size_t plus = rest.front() == '+' ? 1 : 0;
  value = value_of(rest.substr(plus, end - plus), rest.substr(end, letters));
  text = rest.substr(end + letters);
  return true;
}

bool take_id(std::string_view& text, std::int64_t& id) {
  const std::size_t at = std::min(text.find_first_not_of(" \t"), text.size());
  if (at < text.size() && text[at] == '*')
    throw AsciiFault("an id did not fit into its column: the file has stars in its place");
  const std::size_t count = digits(text, at), end = at + count;
  if (count == 0 ||
      (end < text.size() && std::string_view(" \t+-*,").find(text[end]) == std::string_view::npos))
    return false;
  if (std::from_chars(text.data() + at, text.data() + end, id).ec != std::errc()) return false;
  text.remove_prefix(end);
  return true;
}

std::vector<Real> take_numbers(std::string_view& text, std::size_t width) {
  std::vector<Real> out;
  for (Real value = 0; take_number(text, value, width);) out.push_back(value);
  return out;
}

bool AsciiStates::Order::operator()(const AsciiKey& a, const AsciiKey& b) const {
  return std::tie(a.id, a.side, a.name) < std::tie(b.id, b.side, b.name);
}

void AsciiStates::begin(Real t) {
  while (!t_.empty() && t_.back() > t) {
    t_.pop_back();
    sizes_.pop_back();
    ++dropped_;
  }
  for (AsciiColumn& column : columns_)
    if (column.values.size() > t_.size()) column.values.resize(t_.size());
  t_.push_back(t);
  sizes_.push_back(0);
  next_ = 0;
}

std::size_t AsciiStates::index_of(const AsciiKey& key) {
  if (next_ < columns_.size() && columns_[next_].key == key) return next_++;
  const auto [found, is_new] = index_.try_emplace(key, columns_.size());
  if (is_new) columns_.push_back({key, {}});
  next_ = found->second + 1;
  return found->second;
}

bool AsciiStates::holds(const AsciiKey& key) const {
  const auto found = index_.find(key);
  return found != index_.end() && columns_[found->second].values.size() == t_.size();
}

void AsciiStates::put(const AsciiKey& key, Real value) {
  if (t_.empty()) throw AsciiFault("values stand before the first time");
  std::vector<Real>& values = columns_[index_of(key)].values;
  if (values.size() == t_.size())
    throw AsciiFault("'" + key.name + "'" + (key.id ? " of " + std::to_string(*key.id) : "") +
                     " stands twice in one state");
  values.resize(t_.size() - 1, std::nan(""));
  values.push_back(value);
  ++sizes_.back();
}

std::vector<AsciiColumn> AsciiStates::take_columns() {
  for (AsciiColumn& column : columns_) column.values.resize(t_.size(), std::nan(""));
  return std::move(columns_);
}

}  // namespace courant
