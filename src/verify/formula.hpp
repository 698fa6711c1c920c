#pragma once
// Expressions of suites: of parameters of a run and of what they are evaluated over (t, particles, ...).
#include <cstddef>
#include <initializer_list>
#include <string>
#include <vector>

#include "base/compiled_expression.hpp"
#include "generate/expression.hpp"

namespace courant {

/// What an expression over particles may name, in the order in which values are handed over: position,
/// velocity, its magnitude, pressure, density, smoothing length, mass, V = m/rho, internal energy per
/// reference volume, deck number of the part, id, 1 where active, and the time of the state.
const std::vector<std::string>& particle_variables();
inline constexpr std::size_t particle_variable_count = 17;

/// A dataset of history.h5 as an expression names it: "contacts/1/force.y".
struct HistoryName {
  std::string text;    ///< as written
  std::string path;    ///< "/contacts/1/force"
  int component = -1;  ///< 0, 1, 2 of a vector; -1: a scalar
};

/// An expression with the names of datasets, which hold slashes, replaced by words.
struct HistoryText {
  std::string text;
  std::vector<HistoryName> names;  ///< each once
  std::vector<std::string> words;  ///< in `text`, in the order of `names`
};
HistoryText find_history_names(const std::string& text);

/// An expression whose parameters have their values.
class Formula {
 public:
  /// `variables`: what it is evaluated over. A name that is used and is both a variable and a parameter is a
  /// fault, as is anything else that cannot be evaluated.
  Formula(const std::string& text, const std::vector<std::string>& variables, const Variables& parameters);

  bool ok() const { return error_.empty(); }
  const std::string& error() const { return error_; }
  const std::string& hint() const { return hint_; }
  bool uses(std::size_t variable) const { return compiled_.uses(variable); }

  /// values: (variables). NaN where there is no finite value. Needs ok().
  Real operator()(const Real* values);
  Real operator()(std::initializer_list<Real> values) { return (*this)(values.begin()); }

 private:
  CompiledExpression compiled_;
  std::vector<Real> values_;  // of variables, then of parameters
  std::size_t variables_ = 0;
  std::string error_, hint_;
};

/// Value of an expression of parameters alone; NaN, and the reason in `why`, if there is none.
Real constant_value(const std::string& text, const Variables& parameters, std::string& why);

}  // namespace courant
