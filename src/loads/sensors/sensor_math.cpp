#include "loads/sensors/sensor_math.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace courant {

namespace {

using Values = std::vector<Real>;

template <class F>
Real sum_of(const Values& values, F of_each) {
  Real sum = 0;
  for (const Real value : values) sum += of_each(value);
  return sum;
}
Real sum(const Values& v) {
  return sum_of(v, [](Real a) { return a; });
}
Real sum_of_squares(const Values& v) {
  return sum_of(v, [](Real a) { return a * a; });
}
bool smaller(Real a, Real b) {
  return std::abs(a) < std::abs(b);
}

const std::map<std::string, SensorMath> calculations = {
    {"SUM", sum},
    {"ABSSUM", [](const Values& v) { return std::abs(sum(v)); }},
    {"SUMABS", [](const Values& v) { return sum_of(v, [](Real a) { return std::abs(a); }); }},
    {"MAX", [](const Values& v) { return *std::max_element(v.begin(), v.end()); }},
    {"MIN", [](const Values& v) { return *std::min_element(v.begin(), v.end()); }},
    {"MAXMAG", [](const Values& v) { return std::abs(*std::max_element(v.begin(), v.end(), smaller)); }},
    {"MINMAG", [](const Values& v) { return std::abs(*std::min_element(v.begin(), v.end(), smaller)); }},
    {"MULTIPLY",
     [](const Values& v) {
       Real product = 1;
       for (const Real a : v) product *= a;
       return product;
     }},
    {"SQRE", sum_of_squares},
    {"SQRTSQRE", [](const Values& v) { return std::sqrt(sum_of_squares(v)); }},
    // below 0 no number, which no switch takes for above or below anything
    {"SQRT", [](const Values& v) { return sum_of(v, [](Real a) { return std::sqrt(a); }); }}};

}  // namespace

SensorMath sensor_math(const std::string& calc) {
  const auto found = calculations.find(calc);
  return found == calculations.end() ? nullptr : found->second;
}

}  // namespace courant
