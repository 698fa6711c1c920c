#include "base/compiled_expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/expression_parser.hpp"

namespace courant {

namespace {

constexpr Real none = std::numeric_limits<Real>::quiet_NaN();

/// A value that is not finite is a fault, and stays one whatever is done with it.
Real finite(Real value) {
  return std::isfinite(value) ? value : none;
}

}  // namespace

/// Writes down the operations instead of computing.
class CompiledExpression::Recorder {
 public:
  struct Value {};  // where it is, the order of the steps tells
  using Kind = Step::Kind;
  Recorder(CompiledExpression& to, const std::vector<std::string>& names,
           std::span<const ExpressionFunction> functions)
      : to_(to), names_(names), functions_(functions) {}

  Arithmetic arithmetic() const { return Arithmetic::real; }
  std::span<const ExpressionFunction> functions() const { return functions_; }
  Outcome<Value> constant(const Number& number) { return push({Kind::constant, number.value()}); }
  Outcome<Value> named(std::string_view name) {
    const auto at = std::find(names_.begin(), names_.end(), name);
    if (at != names_.end()) {
      const auto index = static_cast<std::size_t>(at - names_.begin());
      to_.used_[index] = true;
      return push({Kind::variable, 0, index});
    }
    const std::string near = nearest_word(std::string(name), names_);
    return {{},
            fmt::format("unknown name '{}'", name),
            near.empty() ? "" : fmt::format("did you mean {}?", near)};
  }
  Outcome<Value> negated(Value) {
    to_.steps_.push_back({Kind::negate});
    return {};
  }
  Outcome<Value> combined(char operation, Value, Value) {
    Kind kind = Kind::raise;
    if (operation == '+') kind = Kind::add;
    if (operation == '-') kind = Kind::subtract;
    if (operation == '*') kind = Kind::multiply;
    if (operation == '/') kind = Kind::divide;
    to_.steps_.push_back({kind});
    --waiting_;
    return {};
  }
  Outcome<Value> called(const ExpressionFunction& function, const std::vector<Value>& arguments) {
    to_.steps_.push_back({Kind::call, 0, arguments.size(), &function});
    waiting_ -= arguments.size() - 1;
    return {};
  }

 private:
  Outcome<Value> push(const Step& step) {
    to_.steps_.push_back(step);
    to_.depth_ = std::max(to_.depth_, ++waiting_);
    return {};
  }
  CompiledExpression& to_;
  const std::vector<std::string>& names_;
  std::span<const ExpressionFunction> functions_;
  std::size_t waiting_ = 0;
};

CompiledExpression::CompiledExpression(std::string_view text, const std::vector<std::string>& names,
                                       std::span<const ExpressionFunction> functions)
    : used_(names.size(), false) {
  Recorder recorder(*this, names, functions);
  auto result = ExpressionParser<Recorder>(text, recorder).run();
  error_ = std::move(result.error);
  hint_ = std::move(result.hint);
  at_ = result.at;
}

Real CompiledExpression::combined(Step::Kind kind, Real a, Real b) {
  switch (kind) {
    case Step::Kind::add:
      return finite(a + b);
    case Step::Kind::subtract:
      return finite(a - b);
    case Step::Kind::multiply:
      return finite(a * b);
    case Step::Kind::divide:
      return b == 0 ? none : finite(a / b);
    default:  // pow(x, 0) and pow(1, x) are 1 for NaN, too
      return (a == 0 && b < 0) || std::isnan(a) || std::isnan(b) ? none : finite(std::pow(a, b));
  }
}

Real CompiledExpression::call(const Step& step, const Real* arguments) {
  const ExpressionFunction& f = *step.function;
  for (std::size_t k = 0; k < step.index; ++k)
    if (std::isnan(arguments[k]) && !f.chooses) return none;  // a comparison would lose it
  if (step.index == 1 && f.of_real) return f.of_real(arguments[0]);
  if (step.index == 2 && f.of_reals) return f.of_reals(arguments[0], arguments[1]);
  std::vector<Number> numbers;
  for (std::size_t k = 0; k < step.index; ++k) numbers.push_back(Number::of(arguments[k]));
  const Calculated result = f.of(numbers);
  return result.fault.empty() ? result.value.value() : none;
}

Real CompiledExpression::operator()(const Real* values) const {
  constexpr std::size_t usual_depth = 32;
  std::array<Real, usual_depth> usual;
  std::vector<Real> deep(depth_ > usual_depth ? depth_ : 0);
  Real* const bottom = deep.empty() ? usual.data() : deep.data();
  Real* top = bottom;  // the next free place
  for (const Step& step : steps_) {
    if (step.kind == Step::Kind::constant) {
      *top++ = step.value;
    } else if (step.kind == Step::Kind::variable) {
      *top++ = finite(values[step.index]);
    } else if (step.kind == Step::Kind::call) {
      top -= step.index;
      *top = finite(call(step, top));
      ++top;
    } else if (step.kind == Step::Kind::negate) {
      top[-1] = 0 - top[-1];
    } else {
      --top;
      top[-1] = combined(step.kind, top[-1], top[0]);
    }
  }
  return bottom[0];
}

}  // namespace courant
