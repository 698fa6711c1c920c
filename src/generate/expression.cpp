#include "generate/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>
#include <vector>

#include "base/expression.hpp"

namespace courant {
namespace {

/// The text with every `${` and its `}` as parentheses, in the same columns.
Evaluation without_placeholders(std::string_view text, std::string& out) {
  out = text;
  std::vector<char> open;
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (out.compare(i, 2, "${") == 0) {
      open.push_back('$');
      out.replace(i++, 2, " (");
    } else if (out[i] == '(') {
      open.push_back('(');
    } else if (out[i] == ')' || out[i] == '}') {
      const bool fits = !open.empty() && (open.back() == '$') == (out[i] == '}');
      if (out[i] == '}' && fits) out[i] = ')';
      if (!open.empty() && open.back() == '$' && !fits) return {0, "'}' is missing"};
      if (fits) open.pop_back();
    }
  }
  const bool closed = std::find(open.begin(), open.end(), '$') == open.end();
  return {0, closed ? "" : "'}' is missing"};
}

// 1e+05 -> 1e5, 1e-05 -> 1e-5: two columns of ten are worth having.
std::string shorten_exponent(std::string s) {
  const auto e = s.find('e');
  if (e == std::string::npos) return s;
  std::string mantissa = s.substr(0, e), exponent = s.substr(e + 1);
  const bool negative = exponent[0] == '-';
  exponent.erase(0, exponent.find_first_not_of("+-0"));
  return mantissa + (negative ? "e-" : "e") + exponent;
}

std::string plain(Real value, int digits) {
  return shorten_exponent(fmt::format("{:.{}g}", value, digits));
}

std::string scientific(Real value, int digits) {
  std::string s = fmt::format("{:.{}e}", value, digits - 1);
  const auto e = s.find('e'), last = s.find_last_not_of('0', e - 1);
  if (s.find('.') < e) s.erase(s[last] == '.' ? last : last + 1, e - (s[last] == '.' ? last : last + 1));
  return shorten_exponent(s);
}

}  // namespace

Evaluation evaluate(std::string_view text, const Variables& variables, const Vec* place) {
  std::string plain_text;
  if (Evaluation fault = without_placeholders(text, plain_text); !fault.ok()) return fault;
  ExpressionNames names;
  names.find = [&](std::string_view name, std::string&) -> std::optional<Number> {
    if (place && name.size() == 1 && name[0] >= 'x' && name[0] <= 'z')
      return Number::of((*place)[name[0] - 'x']);
    const auto it = variables.find(std::string(name));
    return it == variables.end() ? std::nullopt : std::optional<Number>(Number::of(it->second));
  };
  names.all = [&] {
    std::vector<std::string> all;
    for (const auto& [name, value] : variables) all.push_back(name);
    if (place) all.insert(all.end(), {"x", "y", "z"});
    return all;
  };
  const ExpressionResult result = evaluate_expression(plain_text, names, Arithmetic::real);
  return {result.value.value(), result.hint.empty() ? result.error : result.error + ", " + result.hint};
}

std::string number_text(Real value, int width) {
  if (value == 0) value = 0;  // no "-0"
  // 13 digits: the round-off of the expressions that made the number stays out of sight.
  constexpr int most = 13, least = 4;
  if (width == 0) return plain(value, most);
  const auto room = static_cast<std::size_t>(width);
  for (int digits = most; digits >= least; --digits) {
    const std::size_t longest = digits == most ? room : room - 1;
    if (std::string s = plain(value, digits); s.size() <= longest) return s;
    if (std::string s = scientific(value, digits); s.size() <= longest) return s;
  }
  return {};
}

Substitution substitute(std::string_view text, const Variables& variables) {
  Substitution result;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t begin = text.find("${", at);
    result.text += text.substr(at, begin - at);
    if (begin == std::string_view::npos) break;
    const std::size_t end = text.find_first_of("}\n", begin);
    result.line =
        static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(begin), '\n'));
    if (end == std::string_view::npos || text[end] != '}') {
      result.error = "'${' without '}'";
      return result;
    }
    const std::string_view inside = text.substr(begin + 2, end - begin - 2);
    const std::size_t colon = inside.find(':');
    int width = 0;
    if (colon != std::string_view::npos) {
      const std::string_view digits = inside.substr(colon + 1);
      const auto [stop, code] = std::from_chars(digits.data(), digits.data() + digits.size(), width);
      if (code != std::errc() || stop != digits.data() + digits.size() || width < 1 || width > 160) {
        result.error = fmt::format("expected a width from 1 to 160 after ':', got '{}'", digits);
        return result;
      }
    }
    const Evaluation value = evaluate(inside.substr(0, colon), variables);
    if (!value.ok()) {
      result.error = fmt::format("in '${{{}}}': {}", inside, value.error);
      return result;
    }
    const std::string number = number_text(value.value, width);
    if (number.empty()) {
      result.error = fmt::format("in '${{{}}}': {} does not fit {} columns", inside, value.value, width);
      return result;
    }
    result.text += fmt::format("{:>{}}", number, width);
    at = end + 1;
  }
  return result;
}

}  // namespace courant
