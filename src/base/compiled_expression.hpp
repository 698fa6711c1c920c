#pragma once
// Expressions that are read once and evaluated often, as over all particles of a state.
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/real.hpp"

namespace courant {

struct ExpressionFunction;

/// An expression of named variables in the arithmetic of base/expression.hpp with reals only. Where
/// evaluate_expression would report an error (division by zero, a result that is not finite), the value is
/// NaN.
class CompiledExpression {
 public:
  CompiledExpression() = default;
  /// `names`: the variables, in the order in which values are handed over. Faults, as evaluate_expression
  /// reports them, are in error().
  /// `functions`: besides those of all expressions; they must outlive this.
  CompiledExpression(std::string_view text, const std::vector<std::string>& names,
                     std::span<const ExpressionFunction> functions = {});

  bool ok() const { return error_.empty(); }
  const std::string& error() const { return error_; }  ///< "nothing to evaluate" if there was no text
  const std::string& hint() const { return hint_; }
  std::size_t at() const { return at_; }                    ///< position of the fault in the text, from 0
  std::size_t operations() const { return steps_.size(); }  ///< of one evaluation
  bool uses(std::size_t name) const { return name < used_.size() && used_[name]; }

  /// values: (names). Needs ok().
  Real operator()(const Real* values) const;

 private:
  struct Step {
    enum class Kind { constant, variable, add, subtract, multiply, divide, raise, negate, call };
    Kind kind = Kind::constant;
    Real value = 0;         // of a constant
    std::size_t index = 0;  // of a variable; number of arguments of a call
    const ExpressionFunction* function = nullptr;
  };
  class Recorder;
  static Real combined(Step::Kind kind, Real a, Real b);
  static Real call(const Step& step, const Real* arguments);

  std::vector<Step> steps_;  // operands before their operation
  std::vector<bool> used_;
  std::size_t depth_ = 0;  // values that wait at most
  std::string error_ = "nothing to evaluate", hint_;
  std::size_t at_ = 0;
};

}  // namespace courant
