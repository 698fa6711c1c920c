// *DATABASE_SWFORC: forces of welds over time.
#include <fmt/printf.h>

#include "elements/beam/weld.hpp"
#include "extension/additions.hpp"
#include "extension/history_interval.hpp"

namespace courant {

namespace {

struct DatabaseSwforc : HistoryInterval {};
const RegisterKeyword<DatabaseSwforc> database_swforc{
    history_interval<DatabaseSwforc>("DATABASE_SWFORC",
                                     "interval of swforc: axial force, shear, bending moment and torsion of "
                                     "each weld of beams, and when it failed")};

std::vector<WeldForce> welds_of(const World& world) {
  std::vector<WeldForce> out;
  for (const auto* pass : world.passes.all<const WeldReporter>()) pass->report_welds(world, out);
  return out;
}

void swforc_numbers(const World& world, const Clock&, HistoryNumbers& to) {
  using W = WeldForce;
  constexpr int beam_type = 2;  // of a weld that is a beam
  const std::vector<W> welds = welds_of(world);
  HistoryRows(to, "", welds, &W::id, "welds")
      .fixed("types", [](const W&) { return beam_type; })
      .real("axial", &W::axial, "ML/T2")
      .real("shear", &W::shear, "ML/T2")
      .real("resultant_moment", &W::moment, "ML2/T2")
      .real("torsion", &W::torsion, "ML2/T2")
      .real("length", &W::length, "L")
      .integer("failure_flag", [](const W& w) { return w.failure_time > 0; })
      .real("failure", [](const W& w) { return w.failure_time > 0 ? 1.0 : 0.0; })
      .real("failure_time", &W::failure_time, "T");
}

const RegisterAsciiHistory swforc{
    {.name = "swforc",
     .interval = interval_in<DatabaseSwforc>,
     .text =
         [](const World& world, const Clock& clock) {
           std::string out = fmt::sprintf("\n spotweld forces (t=%14.5E)\n", clock.t);
           out +=
               "   weld id     type         axial         shear       failure        length        moment"
               "       torsion\n";
           for (const WeldForce& w : welds_of(world))
             out += fmt::sprintf("%10d     beam%14.5E%14.5E%14.5E%14.5E%14.5E%14.5E\n", w.id, w.axial + 0.0,
                                 w.shear, w.failure_time, w.length, w.moment, w.torsion + 0.0);  // no -0
           return out;
         },
     .numbers = swforc_numbers,
     .binary = binary_in<DatabaseSwforc>}};

}  // namespace

}  // namespace courant
