#include "base/expression.hpp"

#include <fmt/format.h>

#include <utility>

#include "base/expression_functions.hpp"
#include "base/expression_parser.hpp"
#include "base/nearest_word.hpp"

namespace courant {

namespace {

/// Computes while it reads.
class Evaluator {
 public:
  using Value = Number;
  Evaluator(const ExpressionNames& names, Arithmetic arithmetic) : names_(names), arithmetic_(arithmetic) {}

  Arithmetic arithmetic() const { return arithmetic_; }
  Outcome<Number> constant(const Number& value) const { return {typed(value)}; }
  Outcome<Number> negated(const Number& a) const { return typed(subtracted(typed(Number::of(Id(0))), a)); }
  Outcome<Number> called(const ExpressionFunction& function, const std::vector<Number>& arguments) const {
    return typed(function.of(arguments));
  }
  Outcome<Number> combined(char operation, const Number& a, const Number& b) const {
    switch (operation) {
      case '+':
        return typed(added(a, b));
      case '-':
        return typed(subtracted(a, b));
      case '*':
        return typed(multiplied(a, b));
      case '/':
        return typed(divided(a, b));
      default:
        return typed(raised(a, b));
    }
  }
  Outcome<Number> named(std::string_view name) const {
    std::string reason;
    if (names_.find)
      if (const auto value = names_.find(name, reason)) return {typed(*value)};
    if (!reason.empty()) return {{}, std::move(reason)};
    if (name == "pi" || name == "PI") return {typed(Number::of(pi))};  // where no parameter has that name
    const std::string near = names_.all ? nearest_word(std::string(name), names_.all()) : "";
    return {{},
            fmt::format("unknown parameter '{}'", name),
            near.empty() ? "" : fmt::format("did you mean {}?", near)};
  }

 private:
  Number typed(const Number& value) const {
    return arithmetic_ == Arithmetic::real ? Number::of(value.value()) : value;
  }
  Outcome<Number> typed(Calculated result) const { return {typed(result.value), std::move(result.fault)}; }

  const ExpressionNames& names_;
  Arithmetic arithmetic_;
};

}  // namespace

std::string Number::text() const {
  return is_integer ? fmt::format("{}", integer) : fmt::format("{}", real);
}

ExpressionResult evaluate_expression(std::string_view text, const ExpressionNames& names,
                                     Arithmetic arithmetic) {
  Evaluator actions(names, arithmetic);
  auto result = ExpressionParser<Evaluator>(text, actions).run();
  return {result.value, std::move(result.error), std::move(result.hint), result.at};
}

}  // namespace courant
