#include "base/expression.hpp"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <system_error>
#include <utility>

#include "base/expression_functions.hpp"
#include "base/nearest_word.hpp"

namespace courant {

namespace {

constexpr int depth_limit = 100;  // nested parentheses: keeps hostile input from exhausting the stack

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

class Parser {
 public:
  Parser(std::string_view text, const ExpressionNames& names, Arithmetic arithmetic)
      : text_(text), names_(names), arithmetic_(arithmetic) {}

  ExpressionResult run() {
    const Number value = sum();
    skip_blanks();
    if (result_.ok() && at_ < text_.size())
      fail(at_, fmt::format("'{}' is not understood", text_.substr(at_)));
    if (result_.ok()) result_.value = value;
    return std::move(result_);
  }

 private:
  /// Notes the first fault and ends the reading.
  Number fail(std::size_t at, std::string message, std::string hint = {}) {
    if (result_.ok()) {
      result_.error = std::move(message);
      result_.hint = std::move(hint);
      result_.at = at;
    }
    at_ = text_.size();
    return {};
  }
  void skip_blanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  bool take(std::string_view token) {
    skip_blanks();
    if (text_.substr(at_, token.size()) != token) return false;
    at_ += token.size();
    return true;
  }
  Number typed(const Number& value) const {
    return arithmetic_ == Arithmetic::real ? Number::of(value.value()) : value;
  }
  /// A result, or what is wrong with it.
  Number checked(std::size_t at, const Calculated& result) {
    if (!result_.ok()) return {};
    return result.fault.empty() ? typed(result.value) : fail(at, result.fault);
  }

  Number sum() {
    Number value = product();
    while (result_.ok()) {
      skip_blanks();
      const std::size_t at = at_;
      if (take("+"))
        value = checked(at, added(value, product()));
      else if (take("-"))
        value = checked(at, subtracted(value, product()));
      else
        break;
    }
    return value;
  }

  Number product() {
    Number value = signed_power();
    while (result_.ok()) {
      skip_blanks();
      const std::size_t at = at_;
      if (take("*"))
        value = checked(at, multiplied(value, signed_power()));
      else if (take("/"))
        value = checked(at, divided(value, signed_power()));
      else
        break;
    }
    return value;
  }

  // -a**2 is -(a**2), and a**-2 is allowed.
  Number signed_power() {
    skip_blanks();
    const std::size_t at = at_;
    if (++depth_ > depth_limit) fail(at, "too deeply nested");
    Number value;
    if (take("-")) {
      value = checked(at, subtracted(typed(Number::of(Id(0))), signed_power()));
    } else if (take("+")) {
      value = signed_power();
    } else {
      value = primary();
      skip_blanks();
      const std::size_t power = at_;
      if (take("**") || take("^")) value = checked(power, raised(value, signed_power()));
    }
    --depth_;
    return value;
  }

  Number primary() {
    skip_blanks();
    const std::size_t at = at_;
    if (at_ >= text_.size()) return fail(at, "a value is missing");
    if (take("(")) {
      const Number value = sum();
      expect_end_of_parenthesis();
      return value;
    }
    if (take("&")) {
      skip_blanks();
      return named(at, word());
    }
    if (is_letter(text_[at_])) {
      const std::string_view name = word();
      return take("(") ? call(at, name) : named(at, name);
    }
    return number();
  }

  void expect_end_of_parenthesis() {
    if (result_.ok() && !take(")")) fail(at_, "')' is missing");
  }

  std::string_view word() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  Number named(std::size_t at, std::string_view name) {
    if (name.empty()) return fail(at, "a name is missing behind '&'");
    std::string reason;
    if (names_.find)
      if (const auto value = names_.find(name, reason)) return typed(*value);
    if (!reason.empty()) return fail(at, std::move(reason));
    const std::string near = names_.all ? nearest_word(std::string(name), names_.all()) : "";
    return fail(at, fmt::format("unknown parameter '{}'", name),
                near.empty() ? "" : fmt::format("did you mean {}?", near));
  }

  Number call(std::size_t at, std::string_view name) {
    std::vector<Number> arguments;
    if (!take(")")) {
      do arguments.push_back(sum());
      while (result_.ok() && take(","));
      expect_end_of_parenthesis();
    }
    if (!result_.ok()) return {};
    const ExpressionFunction* function = find_function(name);
    if (!function) {
      const std::string near = nearest_word(lower_case(name), function_names());
      return fail(at, fmt::format("unknown function '{}'", name),
                  near.empty() ? "" : fmt::format("did you mean {}?", near));
    }
    if (const std::string fault = wrong_count(*function, arguments.size()); !fault.empty())
      return fail(at, fault);
    return checked(at, function->of(arguments));
  }

  Number number() {
    const std::size_t at = at_;
    bool whole = true;
    const auto digits = [&] {
      const std::size_t begin = at_;
      while (at_ < text_.size() && is_digit(text_[at_])) ++at_;
      return at_ > begin;
    };
    const auto next_is = [&](std::size_t k, std::string_view any) {
      return k < text_.size() && any.find(text_[k]) != std::string_view::npos;
    };
    bool some = digits();
    if (next_is(at_, ".")) {
      ++at_;
      whole = false;
      some = digits() || some;
    }
    if (!some) return fail(at, fmt::format("expected a number or a name, got '{}'", text_.substr(at)));
    if (next_is(at_, "eEdD")) {
      const std::size_t sign = next_is(at_ + 1, "+-");
      if (next_is(at_ + 1 + sign, "0123456789")) {
        at_ += 1 + sign;
        digits();
        whole = false;
      }
    }
    return value_of(at, text_.substr(at, at_ - at), whole);
  }

  Number value_of(std::size_t at, std::string_view digits, bool whole) {
    if (whole && arithmetic_ == Arithmetic::typed) {
      Id integer = 0;
      if (std::from_chars(digits.data(), digits.data() + digits.size(), integer).ec == std::errc{})
        return Number::of(integer);
      return fail(at, fmt::format("the integer {} has too many digits", digits),
                  "with a decimal point it would be a real");
    }
    std::string text(digits);
    for (char& c : text)
      if (c == 'd' || c == 'D') c = 'e';
    Real real = 0;
    if (std::from_chars(text.data(), text.data() + text.size(), real).ec == std::errc{})
      return Number::of(real);
    return fail(at, fmt::format("the number {} is too large or too small", digits));
  }

  std::string_view text_;
  const ExpressionNames& names_;
  Arithmetic arithmetic_;
  ExpressionResult result_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

std::string Number::text() const {
  return is_integer ? fmt::format("{}", integer) : fmt::format("{}", real);
}

ExpressionResult evaluate_expression(std::string_view text, const ExpressionNames& names,
                                     Arithmetic arithmetic) {
  return Parser(text, names, arithmetic).run();
}

}  // namespace courant
