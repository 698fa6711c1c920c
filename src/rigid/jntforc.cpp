// *DATABASE_JNTFORC: forces of joints over time.
#include <fmt/printf.h>

#include "extension/additions.hpp"
#include "keyword/registry.hpp"
#include "state/reports.hpp"

namespace courant {

namespace {

struct DatabaseJntforc : Entry {
  Real dt = 0;
  int binary = 0, ioopt = 1;
  Id lcur = 0;
};
using D = DatabaseJntforc;
const RegisterKeyword<D> database_jntforc{
    {.names = {"DATABASE_JNTFORC"},
     .purpose = "interval of jntforc: force and moment of each joint on its second body, at its place there",
     .once = true,
     .many = false,
     .cards = {{.fields = {{"DT", &D::dt, "T", "interval, 0 none", {.check = Check::not_negative}},
                           {"BINARY", &D::binary, "-", "text is written", no_effect},
                           {"LCUR",
                            &D::lcur,
                            "-",
                            "curve of intervals",
                            {.honour = Honour::output_only, .refers = IdSpace::curve}},
                           {"IOOPT", &D::ioopt, "-", "how LCUR counts", no_effect_but(1)}}}}}};

const RegisterAsciiHistory jntforc{
    {.name = "jntforc",
     .interval = [](const Deck& deck) { return deck.last<D>() ? deck.last<D>()->dt : 0; },
     .text =
         [](const World& world, const Clock& clock) {
           std::string out;
           const auto line = [&](const char* name, Real value) {
             out +=
                 fmt::sprintf(" %s%s%15.6E\n", name, std::string(30 - std::string(name).size(), '.'), value);
           };
           std::vector<JointForce> joints;
           for (const auto* pass : world.passes.all<const JointReporter>()) pass->report_joints(joints);
           for (const JointForce& joint : joints) {
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
         }}};

}  // namespace

}  // namespace courant
