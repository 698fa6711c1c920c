#include "elements/shell/integration_shell.hpp"

#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

using namespace rules;
using Rule = IntegrationShell;

const RegisterKeyword<Rule> integration_shell{
    {.names = {"INTEGRATION_SHELL"},
     .purpose =
         "points through the thickness of shells, each with its weight and perhaps a material of its own",
     .many = false,
     .cards = {
         {.fields =
              {{"IRID", &Rule::irid, "-", "number of the rule, QR/IRID = -IRID of *SECTION_SHELL",
                required_id},
               {"NIP", &Rule::nip, "-", "number of points", {.required = true, .check = Check::positive}},
               {"ESOP",
                &Rule::esop,
                "-",
                "1: points in the middle of layers of one thickness; no more cards",
                {.allowed = {0, 1}}},
               {"FAILOPT",
                &Rule::failopt,
                "-",
                "0: an element fails with its points that can; 1: not while others cannot",
                {.allowed = {0, 1}}}}},
         {.fields = {{"S", &Rule::s, "-", "height over half the thickness, -1 to 1"},
                     {"WF", &Rule::wf, "-", "share of the thickness", {.check = Check::not_negative}},
                     {"PID", &Rule::pid, "-", "part whose material it has; 0: its own",
                      optional_id_of(IdSpace::part)}},
          .repeat = true,
          .when = [](const Rule& i) { return i.esop == 0; }}}}};

}  // namespace

}  // namespace courant
