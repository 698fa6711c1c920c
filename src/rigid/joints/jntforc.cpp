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
    "interval of jntforc: force and moment of each joint on its second body, at its place there")};

const RegisterAsciiHistory jntforc{
    {.name = "jntforc",
     .interval = interval_in<DatabaseJntforc>,
     .text = [](const World& world, const Clock& clock) {
       std::string out;
       const auto line = [&](const char* name, Real value) {
         out += fmt::sprintf(" %s%s%15.6E\n", name, std::string(30 - std::string(name).size(), '.'), value);
       };
       std::vector<JointForce> joints;
       for (const auto* pass : world.passes.all<const JointReporter>()) pass->report_joints(joints);
       for (const JointForce& joint : joints) {
         out += "\n";
         line("time", clock.t);
         out += fmt::sprintf(" joint ID......................%15d\n", joint.id);
         for (int k = 0; k < 3; ++k) line(std::array{"x-force", "y-force", "z-force"}[k], joint.force[k]);
         for (int k = 0; k < 3; ++k) line(std::array{"x-moment", "y-moment", "z-moment"}[k], joint.moment[k]);
         line("resultant force", joint.force.norm());
         line("resultant moment", joint.moment.norm());
       }
       return out;
     }}};

}  // namespace

}  // namespace courant
