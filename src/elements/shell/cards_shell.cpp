#include "elements/shell/cards_shell.hpp"

#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

using namespace rules;

using C = ControlShell;
const RegisterKeyword<C> control_shell{
    {.names = {"CONTROL_SHELL"},
     .purpose = "options of shells that deform; rigid ones need none",
     .once = true,
     .many = false,
     .cards = {
         {.fields = {{"WRPANG", &C::wrpang, "-", "warning where a shell is warped by more degrees",
                      or_blank(20)},
                     {"ESORT", &C::esort, "-", "triangles are always formulation 4, as with 1"},
                     {"IRNXX", &C::irnxx, "-", "unit normals", no_effect_but(-1)},
                     {"ISTUPD", &C::istupd, "-", "1: the thickness follows the strain, 0: it stays"},
                     {"THEORY", &C::theory, "-", "formulation where the section names none", or_blank(2)},
                     {"BWC", &C::bwc, "-", "shells of ELFORM 2: 1 heed their warp, 2 do not", or_blank(2)},
                     {"MITER", &C::miter, "-", "plane stress: always to convergence, as with 2", or_blank(1)},
                     {"PROJ", &C::proj, "-", "projection of BWC 1: always full", no_effect}}},
         {.fields = {{"ROTASCL", &C::rotascl, "-", "scale of the rotary inertia of nodes", or_blank(1)},
                     {"INTGRD", &C::intgrd, "-", "points: 0 of Gauss, 1 of Lobatto for 3 to 10"},
                     {"LAMSHT", &C::lamsht, "-", "laminated theory"},
                     {"CSTYP6", &C::cstyp6, "-", "local system of formulation 6", no_effect_but(1)},
                     {"TSHELL", &C::tshell, "-", "thermal shells", no_effect}},
          .optional = true},
         {.fields = {{"PSSTUPD", &C::psstupd, "-", "parts with ISTUPD", id_of(IdSpace::part_set)},
                     {"SIDT4TU", &C::sidt4tu, "-", "parts of formulation 4 with ISTUPD"},
                     {"CNTCO", &C::cntco, "-", "contact at offset shells: takes them as not offset"},
                     {"ITSFLG", &C::itsflg, "-", "initial transverse stress", no_effect},
                     {"IRQUAD", &C::irquad, "-", "points of quadratic shells", no_effect_but(3)},
                     {"W-MODE", &C::wmode, "-", "deletion by warping"},
                     {"STRETCH", &C::stretch, "-", "deletion by stretch"},
                     {"ICRQ", &C::icrq, "-", "thickness continuous over edges"}},
          .optional = true},
         {.fields = {{"NFAIL1", &C::nfail1, "-", "deletion of distorted shells"},
                     {"NFAIL4", &C::nfail4, "-", "deletion of distorted shells of 2 x 2 points", no_effect},
                     {"PSNFAIL",
                      &C::psnfail,
                      "-",
                      "parts with deletion",
                      {.honour = Honour::ignored, .refers = IdSpace::part_set}},
                     {"KEEPCS", &C::keepcs, "-", "keeps contact segments", no_effect},
                     {"DELFR", &C::delfr, "-", "deletes loose shells", no_effect},
                     {"DRCPSID", &C::drcpsid, "-", "parts with a stiffness of drilling",
                      id_of(IdSpace::part_set)},
                     {"DRCPRM", &C::drcprm, "-", "stiffness of drilling", no_effect_but(1)},
                     {"INTPERR", &C::intperr, "-", "interpolated stresses", no_effect}},
          .optional = true},
         {.fields = {{"DRCMTH", &C::drcmth, "-", "method of drilling", no_effect},
                     {"LISPSID",
                      &C::lispsid,
                      "-",
                      "parts of a law",
                      {.honour = Honour::ignored, .refers = IdSpace::part_set}},
                     {"NLOCDT", &C::nlocdt, "-", "step of offset shells", no_effect}},
          .optional = true}}}};

using A = ControlAccuracy;
const RegisterKeyword<A> control_accuracy{
    {.names = {"CONTROL_ACCURACY"},
     .purpose = "axes of shells that deform; stress is objective to second order whatever it asks",
     .once = true,
     .many = false,
     .cards = {{.fields = {{"OSU", &A::osu, "-", "objective stress update", no_effect},
                           {"INN",
                            &A::inn,
                            "-",
                            "2, 4: axes of shells do not depend on which corner is the first",
                            {.allowed = {-4, -2, 0, 1, 2, 3, 4}}},
                           {"PIDOSU",
                            &A::pidosu,
                            "-",
                            "parts with OSU",
                            {.honour = Honour::ignored, .refers = IdSpace::part_set}},
                           {"IACC", &A::iacc, "-", "implicit accuracy", no_effect},
                           {"EXACC", &A::exacc, "-", "explicit accuracy", no_effect}}}}}};

}  // namespace

}  // namespace courant
