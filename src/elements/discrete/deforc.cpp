// *DATABASE_DEFORC: forces of springs and dampers over time.
#include <fmt/printf.h>

#include "elements/discrete/discrete.hpp"
#include "extension/additions.hpp"
#include "extension/history_interval.hpp"

namespace courant {

namespace {

struct DatabaseDeforc : HistoryInterval {};
const RegisterKeyword<DatabaseDeforc> database_deforc{history_interval<DatabaseDeforc>(
    "DATABASE_DEFORC",
    "interval of deforc: force or moment of each spring and damper on its first end, and its stretch")};

const RegisterAsciiHistory deforc{{.name = "deforc",
                                   .interval = interval_in<DatabaseDeforc>,
                                   .text = [](const World& world, const Clock& clock) {
                                     std::string out = "\n";
                                     const auto line = [&](std::string label, Real value) {
                                       label.resize(29, '.');
                                       out += fmt::sprintf(" %s%14.5E\n", label, value + 0.0);  // no -0
                                     };
                                     line("time", clock.t);
                                     std::vector<SpringForce> springs;
                                     for (const auto* pass : world.passes.all<const SpringReporter>())
                                       pass->report_springs(springs);
                                     for (const SpringForce& s : springs) {
                                       const std::string kind = s.turns ? "moment" : "force";
                                       out += fmt::sprintf(" spring/damper number.........%10d\n", s.id);
                                       for (int k = 0; k < 3; ++k)
                                         line(std::string(1, "xyz"[k]) + "-" + kind, s.force[k]);
                                       line("resultant " + kind, s.resultant);
                                       line(s.turns ? "relative rotation" : "change in length", s.stretch);
                                     }
                                     return out;
                                   }}};

}  // namespace

}  // namespace courant
