#pragma once
// The grammar of expressions, apart from what is done with them: one reader serves evaluation and
// compilation.
#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/expression.hpp"
#include "base/expression_functions.hpp"
#include "base/nearest_word.hpp"

namespace courant {

/// What an action makes of its operands, or what is wrong with them.
template <class Value>
struct Outcome {
  Value value{};
  std::string fault{}, hint{};
};

/// Reads an expression and calls an action for every part of it, operands before their operation. Actions:
///   using Value = ...;
///   Arithmetic arithmetic() const;
///   Outcome<Value> constant(const Number&);
///   Outcome<Value> named(std::string_view name);
///   Outcome<Value> negated(const Value&);
///   Outcome<Value> combined(char operation, const Value&, const Value&);     + - * / ^
///   Outcome<Value> called(const ExpressionFunction&, const std::vector<Value>&);
///   std::span<const ExpressionFunction> functions() const;                   may be missing
template <class Actions>
class ExpressionParser {
 public:
  using Value = typename Actions::Value;
  struct Result {
    Value value{};
    std::string error{}, hint{};
    std::size_t at = 0;
    bool ok() const { return error.empty(); }
  };

  ExpressionParser(std::string_view text, Actions& actions) : text_(text), actions_(actions) {}

  Result run() {
    const Value value = sum();
    skip_blanks();
    if (result_.ok() && at_ < text_.size())
      fail(at_, fmt::format("'{}' is not understood", text_.substr(at_)));
    if (result_.ok()) result_.value = value;
    return std::move(result_);
  }

 private:
  /// Notes the first fault and ends the reading.
  Value fail(std::size_t at, std::string message, std::string hint = {}) {
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
  /// A result, or what is wrong with it.
  Value checked(std::size_t at, Outcome<Value> result) {
    if (!result_.ok()) return {};
    if (result.fault.empty()) return std::move(result.value);
    return fail(at, std::move(result.fault), std::move(result.hint));
  }

  Value combined(std::size_t at, char operation, const Value& a, const Value& b) {
    return result_.ok() ? checked(at, actions_.combined(operation, a, b)) : Value{};
  }

  Value sum() {
    Value value = product();
    while (result_.ok()) {
      skip_blanks();
      const std::size_t at = at_;
      if (take("+"))
        value = combined(at, '+', value, product());
      else if (take("-"))
        value = combined(at, '-', value, product());
      else
        break;
    }
    return value;
  }

  Value product() {
    Value value = signed_power();
    while (result_.ok()) {
      skip_blanks();
      const std::size_t at = at_;
      if (take("*"))
        value = combined(at, '*', value, signed_power());
      else if (take("/"))
        value = combined(at, '/', value, signed_power());
      else
        break;
    }
    return value;
  }

  // -a**2 is -(a**2), and a**-2 is allowed.
  Value signed_power() {
    skip_blanks();
    const std::size_t at = at_;
    if (++depth_ > depth_limit) fail(at, "too deeply nested");
    Value value;
    if (take("-")) {
      const Value operand = signed_power();
      if (result_.ok()) value = checked(at, actions_.negated(operand));
    } else if (take("+")) {
      value = signed_power();
    } else {
      value = primary();
      skip_blanks();
      const std::size_t power = at_;
      if (take("**") || take("^")) value = combined(power, '^', value, signed_power());
    }
    --depth_;
    return value;
  }

  Value primary() {
    skip_blanks();
    const std::size_t at = at_;
    if (at_ >= text_.size()) return fail(at, "a value is missing");
    if (take("(")) {
      const Value value = sum();
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

  Value named(std::size_t at, std::string_view name) {
    if (name.empty()) return fail(at, "a name is missing behind '&'");
    return checked(at, actions_.named(name));
  }

  Value call(std::size_t at, std::string_view name) {
    std::vector<Value> arguments;
    if (!take(")")) {
      do arguments.push_back(sum());
      while (result_.ok() && take(","));
      expect_end_of_parenthesis();
    }
    if (!result_.ok()) return {};
    const ExpressionFunction* function = find(name);
    if (!function) {
      const std::string near = nearest_word(lower_case(name), names_of_functions());
      return fail(at, fmt::format("unknown function '{}'", name),
                  near.empty() ? "" : fmt::format("did you mean {}?", near));
    }
    if (const std::string fault = wrong_count(*function, arguments.size()); !fault.empty())
      return fail(at, fault);
    return checked(at, actions_.called(*function, arguments));
  }

  /// Actions may have functions of their own, which come first.
  const ExpressionFunction* find(std::string_view name) {
    if constexpr (requires { actions_.functions(); })
      for (const ExpressionFunction& own : actions_.functions())
        if (own.name == lower_case(name)) return &own;
    return find_function(name);
  }
  std::vector<std::string> names_of_functions() {
    std::vector<std::string> out = function_names();
    if constexpr (requires { actions_.functions(); })
      for (const ExpressionFunction& own : actions_.functions()) out.push_back(own.name);
    return out;
  }

  Value number() {
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

  Value value_of(std::size_t at, std::string_view digits, bool whole) {
    if (whole && actions_.arithmetic() == Arithmetic::typed) {
      Id integer = 0;
      if (std::from_chars(digits.data(), digits.data() + digits.size(), integer).ec == std::errc{})
        return checked(at, actions_.constant(Number::of(integer)));
      return fail(at, fmt::format("the integer {} has too many digits", digits),
                  "with a decimal point it would be a real");
    }
    std::string text(digits);
    for (char& c : text)
      if (c == 'd' || c == 'D') c = 'e';
    Real real = 0;
    if (std::from_chars(text.data(), text.data() + text.size(), real).ec == std::errc{})
      return checked(at, actions_.constant(Number::of(real)));
    return fail(at, fmt::format("the number {} is too large or too small", digits));
  }

  static constexpr int depth_limit =
      100;  // nested parentheses: keeps hostile input from exhausting the stack
  static bool is_digit(char c) { return c >= '0' && c <= '9'; }
  static bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

  std::string_view text_;
  Actions& actions_;
  Result result_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace courant
