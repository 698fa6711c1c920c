#include "app/report/range_warnings.hpp"

#include <fmt/format.h>

namespace courant {

namespace {

std::string of(const Extreme& e) {
  return fmt::format("{:.4g} (particle {} at {:.5g})", e.value, e.particle, e.t);
}

}  // namespace

std::vector<std::string> range_warnings(const Ranges& ranges, Real most_mach, Real most_change) {
  std::vector<std::string> out;
  for (const PartRange& r : ranges) {
    if (!r.seen || r.stiffness_field.empty()) continue;
    if (r.speed.value > most_mach * r.c0)
      out.push_back(
          fmt::format("part {}: the largest speed {} is above {:.3g} of the sound speed {:.4g}: the "
                      "liquid is no longer nearly incompressible; where it should be, raise {}",
                      r.part, of(r.speed), most_mach, r.c0, r.stiffness_field));
    const bool low = r.density_low.value<1 - most_change, high = r.density_high.value> 1 + most_change;
    if (low || high)
      out.push_back(fmt::format(
          "part {}: density over RO went to {}: the liquid is no longer nearly incompressible; where it "
          "should be, {}",
          r.part,
          high && low ? of(r.density_low) + " and " + of(r.density_high)
                      : of(low ? r.density_low : r.density_high),
          high ? "raise " + r.stiffness_field : "look where it was torn apart, and at PC of *MAT_NULL"));
  }
  return out;
}

std::vector<std::string> range_lines(const Ranges& ranges) {
  std::vector<std::string> out;
  for (const PartRange& r : ranges)
    if (r.seen)
      out.push_back(fmt::format(" part {}: largest speed {}, density over RO from {} to {}", r.part,
                                of(r.speed), of(r.density_low), of(r.density_high)));
  return out;
}

}  // namespace courant
