#include "model/definitions/curve_expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "base/expression_functions.hpp"

namespace courant {

namespace {

using Arguments = const std::vector<Number>&;

Real number(Arguments a, std::size_t k) {
  return a[k].value();
}
Calculated real(Real value) {
  return std::isfinite(value) ? Calculated{Number::of(value)}
                              : Calculated{{}, "the result is not a finite number"};
}

Calculated chosen(Arguments a) {
  const Real e = number(a, 0);
  return real(std::isnan(e) ? e : number(a, e < 0 ? 1 : e == 0 ? 2 : 3));
}

/// h0 up to x0, h1 from x1 on, and between them by `shape` of 0 to 1.
template <Real (*shape)(Real)>
Calculated risen(Arguments a) {
  const Real x0 = number(a, 1), h0 = number(a, 2), x1 = number(a, 3), h1 = number(a, 4);
  if (!(x1 > x0)) return {{}, "the second position is not behind the first"};
  const Real d = std::clamp((number(a, 0) - x0) / (x1 - x0), Real(0), Real(1));
  return real(h0 + (h1 - h0) * shape(d));
}
Real cubic(Real d) {
  return d * d * (3 - 2 * d);
}
Real quintic(Real d) {
  return d * d * d * (10 - d * (15 - 6 * d));
}
Real half_wave(Real d) {
  return 0.5 * (1 - std::cos(pi * d));
}

Calculated polynomial(Arguments a) {
  const Real x = number(a, 0) - number(a, 1);
  Real sum = 0;
  for (std::size_t k = a.size(); k-- > 2;) sum = sum * x + number(a, k);
  return real(sum);
}
Calculated chebyshev(Arguments a) {
  const Real x = number(a, 0) - number(a, 1);
  Real sum = 0, before = 1, now = x;
  for (std::size_t k = 2; k < a.size(); ++k) {
    sum += number(a, k) * before;
    const Real next = 2 * x * now - before;
    before = now, now = next;
  }
  return real(sum);
}
template <Real (*wave)(Real)>
Calculated fourier(Arguments a) {
  const Real x = number(a, 2) * (number(a, 0) - number(a, 1));
  Real sum = number(a, 3);
  for (std::size_t k = 4; k < a.size(); ++k) sum += number(a, k) * wave(static_cast<Real>(k - 3) * x);
  return real(sum);
}
Real cosine(Real x) {
  return std::cos(x);
}
Real sine(Real x) {
  return std::sin(x);
}
Calculated harmonic(Arguments a) {
  const Real phase = a.size() > 4 ? number(a, 4) : 0, shift = a.size() > 5 ? number(a, 5) : 0;
  return real(number(a, 2) * std::sin(number(a, 3) * (number(a, 0) - number(a, 1)) - phase) + shift);
}
Calculated remainder_of(Arguments a) {
  const Real b = number(a, 1);
  return b == 0 ? Calculated{{}, "division by zero"} : real(std::fmod(number(a, 0), b));
}
Calculated power(Arguments a) {
  return real(std::pow(number(a, 0), number(a, 1)));
}
Calculated magnitude(Arguments a) {
  return real(std::abs(number(a, 0)));
}

const std::vector<ExpressionFunction>& curve_functions() {
  constexpr std::size_t terms = 34;
  static const std::vector<ExpressionFunction> all{
      {.name = "if", .least = 4, .most = 4, .of = chosen, .chooses = true},
      {"step", 5, 5, risen<cubic>},
      {"step5", 5, 5, risen<quintic>},
      {"havsin", 5, 5, risen<half_wave>},
      {"poly", 3, terms, polynomial},
      {"cheby", 3, terms, chebyshev},
      {"forcos", 4, terms, fourier<cosine>},
      {"forsin", 4, terms, fourier<sine>},
      {"shf", 4, 6, harmonic},
      {"mod", 2, 2, remainder_of},
      {"pow", 2, 2, power},
      {"fabs", 1, 1, magnitude}};
  return all;
}

const std::vector<std::string> constant_names{"pi", "dtor", "rtod"};
constexpr std::array<Real, 3> constants{pi, pi / 180, 180 / pi};

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

/// Reads "float f(float a) {...}" and "f(a) = ...". Comments have become blanks.
class FunctionReader {
 public:
  explicit FunctionReader(std::string_view text) : text_(text) {}

  struct Assignment {
    std::string name;
    std::string_view value;
    std::size_t at = 0;  ///< of the value
  };
  std::vector<std::string> arguments;
  std::vector<Assignment> assignments;  ///< the last one is what is returned
  TextFault fault;

  void read() {
    std::string name = word();
    if (is_real(name)) name = word();
    if (name.empty()) return fail("the name of a function is missing", "float f(float t) { return 2*t; }");
    if (!take('(')) return fail("'(' is missing behind the name of the function", "float f(float t) { ... }");
    while (!fault.any() && !take(')')) {
      std::string argument = word();
      if (is_real(argument)) argument = word();
      if (argument.empty()) return fail("the name of an argument is missing");
      arguments.push_back(std::move(argument));
      take(',');
    }
    if (arguments.empty()) return fail("the function has no argument", "the first one is the time");
    if (take('=')) {
      assignments.push_back({"", text_.substr(at_), at_});
      while (!assignments[0].value.empty() &&
             (assignments[0].value.back() == ';' || assignments[0].value.back() == ' '))
        assignments[0].value.remove_suffix(1);
      return;
    }
    if (!take('{')) return fail("'{' or '=' is missing behind the arguments");
    while (!fault.any() && !returned_) statement();
    if (fault.any()) return;
    if (!take('}'))
      return fail("'}' is missing behind what is returned", "one value is returned, at the end");
    if (skip(), at_ < text_.size())
      fail("something follows the function", "one function is read from each entry");
  }

 private:
  static bool is_real(const std::string& word) { return word == "float" || word == "double"; }
  void skip() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  bool take(char c) {
    skip();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  std::string word() {
    skip();
    const std::size_t begin = at_;
    if (at_ < text_.size() && !std::isdigit(static_cast<unsigned char>(text_[at_])))
      while (at_ < text_.size() && is_word(text_[at_])) ++at_;
    return std::string(text_.substr(begin, at_ - begin));
  }
  void fail(std::string message, std::string hint = {}) {
    if (!fault.any()) fault = {std::move(message), std::move(hint), at_};
  }
  void statement() {
    skip();
    const std::size_t begin = at_;
    std::string name = word();
    if (is_real(name)) name = word();
    returned_ = name == "return";
    static const std::vector<std::string> others{"if",   "for",    "while", "do",  "int",
                                                 "else", "switch", "char",  "long"};
    if (std::find(others.begin(), others.end(), name) != others.end() || name.empty()) {
      at_ = begin;
      return fail(
          name.empty() ? std::string("a statement is missing") : fmt::format("'{}' is not supported", name),
          "known are 'float a = ...;', 'a = ...;' and one 'return ...;' at the end; IF(e, a, b, c) chooses "
          "by "
          "the sign of e");
    }
    if (!returned_ && !take('=')) return fail("'=' is missing");
    const std::size_t end = text_.find(';', at_);
    if (end == std::string_view::npos) return fail("';' is missing");
    constexpr std::size_t most = 1000;
    if (assignments.size() == most) {
      at_ = begin;
      return fail(fmt::format("the function has more than {} statements", most),
                  "give points with *DEFINE_CURVE");
    }
    assignments.push_back({returned_ ? "" : name, text_.substr(at_, end - at_), at_});
    at_ = end + 1;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  bool returned_ = false;
};

/// Comments of C as blanks, so that places stay.
std::string without_comments(std::string_view text) {
  std::string out(text);
  for (std::size_t k = 0; k + 1 < out.size(); ++k) {
    if (out[k] != '/' || (out[k + 1] != '*' && out[k + 1] != '/')) continue;
    const bool line = out[k + 1] == '/';
    std::size_t end = line ? out.find('\n', k) : out.find("*/", k + 2);
    end = end == std::string::npos ? out.size() : line ? end : end + 2;
    for (; k < end; ++k)
      if (out[k] != '\n') out[k] = ' ';
  }
  return out;
}

void compile(std::string_view text, const std::vector<std::string>& names, std::size_t offset,
             CompiledExpression& out, TextFault& fault) {
  out = CompiledExpression(text, names, curve_functions());
  if (out.ok()) return;
  fault = {out.error(), out.hint(), offset + out.at()};
  if (out.hint().empty() && out.error().rfind("unknown", 0) == 0)
    fault.hint =
        "known are TIME, numbers and functions of numbers; what the run computes (DX, VX, FX, LC, ...) is "
        "not "
        "supported";
}

}  // namespace

CurveExpression CurveExpression::of_time(std::string_view text, TextFault& fault) {
  CurveExpression out;
  std::vector<std::string> names = constant_names;
  names.push_back("time");
  out.values_ = names.size();
  out.steps_.emplace_back();
  compile(lower_case(text), names, 0, out.steps_[0].value, fault);
  return out;
}

CurveExpression CurveExpression::of_function(std::string_view text, TextFault& fault) {
  const std::string plain = lower_case(without_comments(text));
  FunctionReader reader(plain);
  reader.read();
  fault = reader.fault;
  CurveExpression out;
  if (fault.any()) return out;
  std::vector<std::string> names = constant_names;
  out.arguments_ = reader.arguments.size();
  names.insert(names.end(), reader.arguments.begin(), reader.arguments.end());
  for (const auto& assignment : reader.assignments) {
    Step& step = out.steps_.emplace_back();
    compile(assignment.value, names, assignment.at, step.value, fault);
    if (fault.any()) return out;
    for (std::size_t k = 1; k < out.arguments_; ++k)
      if (step.value.uses(constants.size() + k)) {
        fault = {
            fmt::format("the value depends on '{}', and only the first argument, the time, is known here",
                        reader.arguments[k]),
            "loads that depend on position are not supported", assignment.at};
        return out;
      }
    const auto known = std::find(names.begin() + static_cast<std::ptrdiff_t>(constants.size()), names.end(),
                                 assignment.name);
    step.to = static_cast<std::size_t>(known - names.begin());
    if (known == names.end()) names.push_back(assignment.name);
  }
  out.values_ = names.size();
  return out;
}

std::size_t CurveExpression::operations() const {
  std::size_t sum = 0;
  for (const Step& step : steps_) sum += step.value.operations();
  return sum;
}

Real CurveExpression::operator()(Real time) const {
  constexpr std::size_t usual_count = 16;
  std::array<Real, usual_count> usual{};
  std::vector<Real> many(values_ < usual_count ? 0 : values_ + 1, 0);
  Real* const values = many.empty() ? usual.data() : many.data();
  std::copy(constants.begin(), constants.end(), values);
  values[constants.size()] = time;
  Real result = 0;
  for (const Step& step : steps_) {
    result = step.value(values);
    if (steps_.size() > 1) values[step.to] = result;
  }
  return result;
}

namespace {

class Sampler {
 public:
  Sampler(const std::function<Real(Real)>& f, std::size_t operations, Real from, Real to,
          SamplingBudget& budget, Curve& curve)
      : f_(f),
        operations_(static_cast<Real>(operations)),
        budget_(budget),
        from_(from),
        to_(to),
        curve_(curve) {}

  std::string run() {
    constexpr int pieces = 65536, looks = 3;  // at the ends of a piece and within it
    budget_.add_curve();
    take(looks * pieces);
    if (!fault_.empty()) return fault_;
    std::vector<Real> x(pieces + 1), y(pieces + 1);
    Real least = 0, most = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
      x[k] = from_ + (to_ - from_) * static_cast<Real>(k) / pieces, y[k] = value(x[k]);
      least = k == 0 ? y[k] : std::min(least, y[k]), most = k == 0 ? y[k] : std::max(most, y[k]);
    }
    constexpr Real share = 3e-8;  // of the range; a piece may be farther off than where it is looked at
    tolerance_ = share * std::max(most - least, 1e-9 * std::max(std::abs(least), std::abs(most)));
    put(x[0], y[0]);
    for (std::size_t k = 1; k < x.size() && fault_.empty(); ++k) between(x[k - 1], y[k - 1], x[k], y[k]);
    return fault_;
  }

 private:
  void take(Real evaluations) {
    if (!budget_.take(evaluations * operations_) && fault_.empty())
      fault_ = "it takes too many operations, together with the curves by a formula before it";
  }
  Real value(Real x) {
    const Real y = f_(x);
    if (!std::isfinite(y) && fault_.empty()) fault_ = fmt::format("it has no finite value at {:.6g}", x);
    return y;
  }
  void put(Real x, Real y) {
    constexpr std::size_t most_points = 4000000;
    if (curve_.abscissa.size() >= most_points && fault_.empty())
      fault_ = "it changes too often: more than 4 million straight pieces would be needed";
    // a piece that goes straight on is none of its own
    curve_.abscissa.push_back(x), curve_.ordinate.push_back(y);
  }
  void between(Real a, Real ya, Real b, Real yb) {
    if (!fault_.empty()) return;
    const Real middle = 0.5 * (a + b), aside = a + 0.37 * (b - a);
    const Real y = value(middle), z = value(aside);
    if (!fault_.empty()) return;
    if (std::abs(y - 0.5 * (ya + yb)) <= tolerance_ && std::abs(z - ya - 0.37 * (yb - ya)) <= tolerance_)
      return put(b, yb);
    if (b - a < 1e-12 * (to_ - from_)) {
      put(b, ya);
      return put(b, yb);
    }
    take(4);
    between(a, ya, middle, y);
    between(middle, y, b, yb);
  }

  const std::function<Real(Real)>& f_;
  Real operations_;
  SamplingBudget& budget_;
  Real from_, to_, tolerance_ = 0;
  Curve& curve_;
  std::string fault_;
};

}  // namespace

std::string sample_curve(const std::function<Real(Real)>& f, std::size_t operations, Real from, Real to,
                         SamplingBudget& budget, Curve& curve) {
  return Sampler(f, operations, from, to, budget, curve).run();
}

}  // namespace courant
