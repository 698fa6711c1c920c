// *DATABASE_SWFORC: forces of welds over time.
#include <fmt/printf.h>

#include "elements/beam/weld.hpp"
#include "extension/additions.hpp"
#include "extension/history_interval.hpp"

namespace courant {

namespace {

struct DatabaseSwforc : HistoryInterval {};
const RegisterKeyword<DatabaseSwforc> database_swforc{history_interval<DatabaseSwforc>(
    "DATABASE_SWFORC",
    "interval of swforc: pull, shear, bending moment and torsion of each weld of beams, and when it failed")};

const RegisterAsciiHistory swforc{
    {.name = "swforc",
     .interval = interval_in<DatabaseSwforc>,
     .text = [](const World& world, const Clock& clock) {
       std::string out = fmt::sprintf("\n spotweld forces (t=%14.5E)\n", clock.t);
       out +=
           "   weld id     type         axial         shear       failure        length        moment"
           "       torsion\n";
       std::vector<WeldForce> welds;
       for (const auto* pass : world.passes.all<const WeldReporter>()) pass->report_welds(world, welds);
       for (const WeldForce& w : welds)
         out += fmt::sprintf("%10d     beam%14.5E%14.5E%14.5E%14.5E%14.5E%14.5E\n", w.id, w.axial + 0.0,
                             w.shear, w.failure_time, w.length, w.moment, w.torsion + 0.0);  // no -0
       return out;
     }}};

}  // namespace

}  // namespace courant
