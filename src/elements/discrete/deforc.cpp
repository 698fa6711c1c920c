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

std::vector<SpringForce> springs_of(const World& world) {
  std::vector<SpringForce> out;
  for (const auto* pass : world.passes.all<const SpringReporter>()) pass->report_springs(out);
  return out;
}

void deforc_numbers(const World& world, const Clock&, HistoryNumbers& to) {
  using S = SpringForce;
  const std::vector<S> all = springs_of(world);
  HistoryRows rows(to, "", all, &S::id, "springs");
  rows.fixed("irot", &S::turns).vector("{}_force", &S::force).real("resultant_force", &S::resultant);
  rows.real("displacement", &S::stretch);
  std::size_t row = 0;
  for (const S& s : all) {
    rows.value(row, s.turns ? "moment" : "force", s.turns ? "ML2/T2" : "ML/T2",
               {s.force[0], s.force[1], s.force[2]});
    rows.value(row, "resultant", s.turns ? "ML2/T2" : "ML/T2", {s.resultant});
    rows.value(row++, s.turns ? "relative_rotation" : "change_in_length", s.turns ? "-" : "L", {s.stretch});
  }
}

const RegisterAsciiHistory deforc{{.name = "deforc",
                                   .interval = interval_in<DatabaseDeforc>,
                                   .text =
                                       [](const World& world, const Clock& clock) {
                                         std::string out = "\n";
                                         const auto line = [&](std::string label, Real value) {
                                           label.resize(29, '.');
                                           out += fmt::sprintf(" %s%14.5E\n", label, value + 0.0);  // no -0
                                         };
                                         line("time", clock.t);
                                         for (const SpringForce& s : springs_of(world)) {
                                           const std::string kind = s.turns ? "moment" : "force";
                                           out += fmt::sprintf(" spring/damper number.........%10d\n", s.id);
                                           for (int k = 0; k < 3; ++k)
                                             line(std::string(1, "xyz"[k]) + "-" + kind, s.force[k]);
                                           line("resultant " + kind, s.resultant);
                                           line(s.turns ? "relative rotation" : "change in length",
                                                s.stretch);
                                         }
                                         return out;
                                       },
                                   .numbers = deforc_numbers,
                                   .binary = binary_in<DatabaseDeforc>}};

}  // namespace

}  // namespace courant
