#include "generate/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>
#include <vector>

namespace courant {
namespace {

constexpr int depth_limit = 100;  // nested parentheses: keeps hostile input from exhausting the stack

class Parser {
 public:
  Parser(std::string_view text, const Variables& variables) : text_(text), variables_(variables) {}

  Evaluation run() {
    Evaluation result{sum(), {}};
    skip_blanks();
    if (error_.empty() && at_ < text_.size()) fail(fmt::format("'{}' is not understood", text_.substr(at_)));
    if (error_.empty() && !std::isfinite(result.value)) fail("the result is not a finite number");
    result.error = error_;
    return result;
  }

 private:
  void fail(std::string message) {
    if (error_.empty()) error_ = std::move(message);
    at_ = text_.size();
  }
  void skip_blanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  bool take(char c) {
    skip_blanks();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (error_.empty() && !take(c)) fail(fmt::format("'{}' is missing", c));
  }

  Real sum() {
    Real value = product();
    for (;;) {
      if (take('+')) {
        value += product();
      } else if (take('-')) {
        value -= product();
      } else {
        return value;
      }
    }
  }
  Real product() {
    Real value = signed_power();
    for (;;) {
      if (take('*')) {
        value *= signed_power();
      } else if (take('/')) {
        const Real divisor = signed_power();
        if (divisor == 0 && error_.empty()) fail("division by zero");
        value /= divisor;
      } else {
        return value;
      }
    }
  }
  // -a^2 is -(a^2), and a^-2 is allowed.
  Real signed_power() {
    if (++depth_ > depth_limit) fail("too deeply nested");
    Real value = 0;
    if (take('-')) {
      value = -signed_power();
    } else if (take('+')) {
      value = signed_power();
    } else {
      value = primary();
      if (take('^')) value = std::pow(value, signed_power());
    }
    --depth_;
    return value;
  }
  Real primary() {
    skip_blanks();
    if (at_ >= text_.size()) {
      fail("a value is missing");
      return 0;
    }
    if (take('(')) {
      const Real value = sum();
      expect(')');
      return value;
    }
    if (text_.substr(at_, 2) == "${") {
      at_ += 2;
      const Real value = sum();
      expect('}');
      return value;
    }
    if (std::isalpha(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_') return named();
    return number();
  }
  Real number() {
    Real value = 0;
    const auto [end, code] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (code != std::errc()) {
      fail(fmt::format("expected a number or a name, got '{}'", text_.substr(at_)));
      return 0;
    }
    at_ = static_cast<std::size_t>(end - text_.data());
    return value;
  }
  Real named() {
    std::size_t end = at_;
    while (end < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[end])) || text_[end] == '_'))
      ++end;
    const std::string name(text_.substr(at_, end - at_));
    at_ = end;
    if (take('(')) return call(name);
    const auto it = variables_.find(name);
    if (it != variables_.end()) return it->second;
    fail(fmt::format("unknown parameter '{}'", name));
    return 0;
  }
  Real call(const std::string& name) {
    std::vector<Real> a{sum()};
    while (take(',')) a.push_back(sum());
    expect(')');
    if (!error_.empty()) return 0;
    if (a.size() == 1) {
      if (name == "sqrt") return std::sqrt(a[0]);
      if (name == "abs") return std::abs(a[0]);
      if (name == "floor") return std::floor(a[0]);
      if (name == "ceil") return std::ceil(a[0]);
      if (name == "round") return std::round(a[0]);
    }
    if (a.size() == 2) {
      if (name == "min") return std::min(a[0], a[1]);
      if (name == "max") return std::max(a[0], a[1]);
    }
    fail(fmt::format("unknown function '{}' of {} argument(s)", name, a.size()));
    return 0;
  }

  std::string_view text_;
  const Variables& variables_;
  std::size_t at_ = 0;
  int depth_ = 0;
  std::string error_;
};

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

Evaluation evaluate(std::string_view text, const Variables& variables) {
  return Parser(text, variables).run();
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
