#include "base/expression_functions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

namespace courant {

namespace {

constexpr std::size_t any_number = std::numeric_limits<std::size_t>::max();
constexpr const char* not_finite = "the result is not a finite number";
constexpr const char* overflow = "the result is too large for an integer";

Calculated real_result(Real value) {
  if (!std::isfinite(value)) return {{}, not_finite};
  return {Number::of(value)};
}

Calculated integer_result(Real whole) {
  const auto value = truncated(whole);
  return value ? Calculated{Number::of(*value)} : Calculated{{}, overflow};
}

Calculated integer_power(Id base, Id exponent) {
  if (exponent < 0) {
    if (base == 0) return {{}, "division by zero"};
    // as 1/(base**-exponent) in integers
    if (base == 1) return {Number::of(Id(1))};
    if (base == -1) return {Number::of(Id(exponent % 2 == 0 ? 1 : -1))};
    return {Number::of(Id(0))};
  }
  Id result = 1;
  for (Id rest = exponent; rest > 0; rest /= 2) {
    if (rest % 2 == 1 && __builtin_mul_overflow(result, base, &result)) return {{}, overflow};
    if (rest > 1 && __builtin_mul_overflow(base, base, &base)) return {{}, overflow};
  }
  return {Number::of(result)};
}

using Arguments = const std::vector<Number>&;

/// The function of one real that is in the template's argument.
template <Real (*f)(Real)>
Calculated real_function(Arguments a) {
  return real_result(f(a[0].value()));
}

template <Real (*f)(Real)>
ExpressionFunction of_one(const char* name) {
  return {name, 1, 1, real_function<f>, f};
}

Real smaller(Real a, Real b) {
  return b < a ? b : a;
}
Real greater(Real a, Real b) {
  return b > a ? b : a;
}

Real csc(Real x) {
  return 1 / std::sin(x);
}
Real sec(Real x) {
  return 1 / std::cos(x);
}
Real ctn(Real x) {
  return 1 / std::tan(x);
}

Calculated atan2_of(Arguments a) {
  return real_result(std::atan2(a[0].value(), a[1].value()));
}

Calculated extreme(Arguments a, bool greatest) {
  const bool whole = std::all_of(a.begin(), a.end(), [](const Number& n) { return n.is_integer; });
  Number best = a[0];
  for (const Number& n : a) {
    const bool less = whole ? n.integer < best.integer : n.value() < best.value();
    const bool more = whole ? n.integer > best.integer : n.value() > best.value();
    if (greatest ? more : less) best = n;
  }
  return {whole ? best : Number::of(best.value())};
}

Calculated magnitude(const Number& a) {
  if (!a.is_integer) return {Number::of(std::abs(a.real))};
  return a.integer < 0 ? subtracted(Number::of(Id(0)), a) : Calculated{a};
}

Calculated with_sign(Arguments a) {
  const Number size = a[0].is_integer && !a[1].is_integer ? Number::of(a[0].value()) : a[0];
  const Calculated out = magnitude(size);
  return out.fault.empty() && a[1].value() < 0 ? subtracted(Number::of(Id(0)), out.value) : out;
}

Calculated remainder(Arguments a) {
  Id whole[2] = {0, 0};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto value = a[k].is_integer ? std::optional<Id>(a[k].integer) : truncated(std::round(a[k].real));
    if (!value) return {{}, overflow};
    whole[k] = *value;
  }
  if (whole[1] == 0) return {{}, "division by zero"};
  return {Number::of(whole[1] == -1 ? Id(0) : whole[0] % whole[1])};
}

/// A rounding that gives an integer.
template <Real (*f)(Real)>
Calculated to_integer(Arguments a) {
  return a[0].is_integer ? Calculated{a[0]} : integer_result(f(a[0].real));
}

Real cut(Real x) {
  return std::trunc(x);
}
Real nearest(Real x) {
  return std::round(x);
}
Real below(Real x) {
  return std::floor(x);
}
Real above(Real x) {
  return std::ceil(x);
}

const std::vector<ExpressionFunction>& functions() {
  static const std::vector<ExpressionFunction> table = {
      of_one<std::sin>("sin"),
      of_one<std::cos>("cos"),
      of_one<std::tan>("tan"),
      of_one<csc>("csc"),
      of_one<sec>("sec"),
      of_one<ctn>("ctn"),
      of_one<std::asin>("asin"),
      of_one<std::acos>("acos"),
      of_one<std::atan>("atan"),
      {"atan2", 2, 2, atan2_of, nullptr, std::atan2},
      of_one<std::sinh>("sinh"),
      of_one<std::cosh>("cosh"),
      of_one<std::tanh>("tanh"),
      of_one<std::asinh>("asinh"),
      of_one<std::acosh>("acosh"),
      of_one<std::atanh>("atanh"),
      of_one<std::exp>("exp"),
      of_one<std::log>("log"),
      of_one<std::log10>("log10"),
      of_one<std::sqrt>("sqrt"),
      {"min", 2, any_number, [](Arguments a) { return extreme(a, false); }, nullptr, smaller},
      {"max", 2, any_number, [](Arguments a) { return extreme(a, true); }, nullptr, greater},
      {"mod", 2, 2, remainder},
      {"abs", 1, 1, [](Arguments a) { return magnitude(a[0]); }, std::fabs},
      {"sign", 2, 2, with_sign},
      {"int", 1, 1, to_integer<cut>},
      of_one<cut>("aint"),
      {"nint", 1, 1, to_integer<nearest>},
      of_one<nearest>("anint"),
      {"float", 1, 1, [](Arguments a) { return real_result(a[0].value()); }},
      {"ls_integer", 1, 1, to_integer<cut>},
      {"ls_real", 1, 1, [](Arguments a) { return real_result(a[0].value()); }},
      {"floor", 1, 1, to_integer<below>},
      {"ceil", 1, 1, to_integer<above>},
      {"round", 1, 1, to_integer<nearest>},
  };
  return table;
}

}  // namespace

std::optional<Id> truncated(Real value) {
  constexpr Real limit = 9223372036854775808.0;  // 2^63
  if (!(value >= -limit && value < limit)) return std::nullopt;
  return static_cast<Id>(value);
}

Calculated added(const Number& a, const Number& b) {
  if (!a.is_integer || !b.is_integer) return real_result(a.value() + b.value());
  Id out = 0;
  if (__builtin_add_overflow(a.integer, b.integer, &out)) return {{}, overflow};
  return {Number::of(out)};
}

Calculated subtracted(const Number& a, const Number& b) {
  if (!a.is_integer || !b.is_integer) return real_result(a.value() - b.value());
  Id out = 0;
  if (__builtin_sub_overflow(a.integer, b.integer, &out)) return {{}, overflow};
  return {Number::of(out)};
}

Calculated multiplied(const Number& a, const Number& b) {
  if (!a.is_integer || !b.is_integer) return real_result(a.value() * b.value());
  Id out = 0;
  if (__builtin_mul_overflow(a.integer, b.integer, &out)) return {{}, overflow};
  return {Number::of(out)};
}

Calculated divided(const Number& a, const Number& b) {
  if (b.value() == 0) return {{}, "division by zero"};
  if (!a.is_integer || !b.is_integer) return real_result(a.value() / b.value());
  if (b.integer == -1) return subtracted(Number::of(Id(0)), a);
  return {Number::of(a.integer / b.integer)};
}

Calculated raised(const Number& a, const Number& b) {
  if (a.is_integer && b.is_integer) return integer_power(a.integer, b.integer);
  if (a.value() == 0 && b.value() < 0) return {{}, "division by zero"};
  return real_result(std::pow(a.value(), b.value()));
}

const ExpressionFunction* find_function(std::string_view name) {
  const std::string wanted = lower_case(name);
  for (const ExpressionFunction& f : functions())
    if (f.name == wanted) return &f;
  return nullptr;
}

std::vector<std::string> function_names() {
  std::vector<std::string> names;
  for (const ExpressionFunction& f : functions()) names.push_back(f.name);
  return names;
}

std::string wrong_count(const ExpressionFunction& function, std::size_t count) {
  if (count >= function.least && count <= function.most) return {};
  return fmt::format("{} takes {} argument{}{}, got {}", function.name, function.least,
                     function.least == 1 ? "" : "s", function.most == any_number ? " or more" : "", count);
}

std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

}  // namespace courant
