#include "model/requests/output_times.hpp"

#include <algorithm>
#include <limits>

namespace courant {

namespace {

constexpr Real never = std::numeric_limits<Real>::infinity();

/// The smallest s > t with s = t + f(s), for f > 0: piece by piece, since f is linear in each.
Real implicit_next(const Curve& f, Real t) {
  Real from = t;
  for (std::size_t k = 0; k < f.abscissa.size(); ++k) {
    const Real to = f.abscissa[k];
    if (to <= from) continue;
    const Real left = from - t - f(from),
               right = to - t - f.ordinate[k];  // f in front of a jump, if there is one
    if (left >= 0) return from;                 // f has jumped across
    if (right >= 0) return from + (to - from) * (-left / (right - left));
    from = to;
  }
  return std::max(from,
                  t + f(from));  // constant behind the last abscissa, at which it may have jumped across
}

}  // namespace

Real first_output(const OutputTimes& times) {
  if (times.rule != OutputTimes::Rule::abscissae) return 0;
  const auto& t = times.curve.abscissa;
  const auto first = std::lower_bound(t.begin(), t.end(), 0.0);
  return first == t.end() ? never : *first;
}

Real next_output(const OutputTimes& times, Real due) {
  switch (times.rule) {
    case OutputTimes::Rule::interval:
      return times.interval > 0 ? due + times.interval : never;
    case OutputTimes::Rule::after_last:
      return due + times.curve(due);
    case OutputTimes::Rule::implicit:
      return implicit_next(times.curve, due);
    case OutputTimes::Rule::abscissae: {
      const auto& t = times.curve.abscissa;
      const auto next = std::upper_bound(t.begin(), t.end(), due);
      return next == t.end() ? never : *next;
    }
  }
  return never;
}

}  // namespace courant
