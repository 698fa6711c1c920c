// *DATABASE_JNTFORC: forces of joints over time.
#include <fmt/printf.h>

#include "extension/additions.hpp"
#include "extension/history_interval.hpp"
#include "state/reports.hpp"

namespace courant {

namespace {

struct DatabaseJntforc : HistoryInterval {};
const RegisterKeyword<DatabaseJntforc> database_jntforc{history_interval<DatabaseJntforc>(
    "DATABASE_JNTFORC",
    "interval of jntforc: force and moment of each joint on its second body, at its position there")};

std::vector<JointForce> joints_of(const World& world) {
  std::vector<JointForce> out;
  for (const auto* pass : world.passes.all<const JointReporter>()) pass->report_joints(out);
  return out;
}

void jntforc_numbers(const World& world, const Clock&, HistoryNumbers& to) {
  using J = JointForce;
  const std::vector<J> joints = joints_of(world);
  HistoryRows(to, "joints", joints, &J::id, "joints")
      .title(&J::title)
      .fixed("local", [](const J&) { return 0; })
      .vector("{}_force", &J::force, "ML/T2")
      .vector("{}_moment", &J::moment, "ML2/T2")
      .real("resultant_force", [](const J& j) { return j.force.norm(); })
      .real("resultant_moment", [](const J& j) { return j.moment.norm(); });
}

const RegisterAsciiHistory jntforc{
    {.name = "jntforc",
     .interval = interval_in<DatabaseJntforc>,
     .text =
         [](const World& world, const Clock& clock) {
           std::string out;
           const auto line = [&](const char* name, Real value) {
             out +=
                 fmt::sprintf(" %s%s%15.6E\n", name, std::string(30 - std::string(name).size(), '.'), value);
           };
           for (const JointForce& joint : joints_of(world)) {
             out += "\n";
             line("time", clock.t);
             out += fmt::sprintf(" joint ID......................%15d\n", joint.id);
             for (int k = 0; k < 3; ++k) line(std::array{"x-force", "y-force", "z-force"}[k], joint.force[k]);
             for (int k = 0; k < 3; ++k)
               line(std::array{"x-moment", "y-moment", "z-moment"}[k], joint.moment[k]);
             line("resultant force", joint.force.norm());
             line("resultant moment", joint.moment.norm());
           }
           return out;
         },
     .numbers = jntforc_numbers,
     .binary = binary_in<DatabaseJntforc>}};

}  // namespace

}  // namespace courant
