// *DATABASE_DEFORC: forces of springs and dampers over time.
#include <fmt/printf.h>

#include "elements/discrete/discrete.hpp"
#include "extension/additions.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

struct DatabaseDeforc : Entry {
  Real dt = 0;
  int binary = 0, ioopt = 1;
  Id lcur = 0;
};
using D = DatabaseDeforc;
const RegisterKeyword<D> database_deforc{
    {.names = {"DATABASE_DEFORC"},
     .purpose =
         "interval of deforc: force or moment of each spring and damper on its first end, and its stretch",
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

const RegisterAsciiHistory deforc{
    {.name = "deforc",
     .interval = [](const Deck& deck) { return deck.last<D>() ? deck.last<D>()->dt : 0; },
     .text =
         [](const World& world, const Clock& clock) {
           std::string out = "\n";
           const auto line = [&](std::string label, Real value) {
             label.resize(29, '.');
             out += fmt::sprintf(" %s%14.5E\n", label, value + 0.0);  // no -0
           };
           line("time", clock.t);
           std::vector<SpringForce> springs;
           for (const auto* pass : world.passes.all<const SpringReporter>()) pass->report_springs(springs);
           for (const SpringForce& s : springs) {
             const std::string kind = s.turns ? "moment" : "force";
             out += fmt::sprintf(" spring/damper number.........%10d\n", s.id);
             for (int k = 0; k < 3; ++k) line(std::string(1, "xyz"[k]) + "-" + kind, s.force[k]);
             line("resultant " + kind, s.resultant);
             line(s.turns ? "relative rotation" : "change in length", s.stretch);
           }
           return out;
         }}};

}  // namespace

}  // namespace courant
