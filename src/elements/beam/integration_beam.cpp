#include "elements/beam/integration_beam.hpp"

#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

using R = IntegrationBeam;
constexpr FieldRules size_of_section{.check = Check::not_negative};
constexpr FieldRules other_part{.honour = Honour::no, .refers = IdSpace::part};

const RegisterKeyword<R> integration_beam{
    {.names = {"INTEGRATION_BEAM"},
     .purpose = "points in the section of beams (ELFORM 1), one by one or of a standard section",
     .many = false,
     .cards = {
         {.fields = {{"IRID", &R::irid, "-", "number of the rule, QR/IRID = -IRID of *SECTION_BEAM",
                      rules::required_id},
                     {"NIP", &R::nip, "-", "number of points, 0 with ICST", {.check = Check::not_negative}},
                     {"RA", &R::ra, "-", "with NIP: area over TS1 TT1", size_of_section},
                     {"ICST",
                      &R::icst,
                      "-",
                      "1 I, 2 channel, 3 angle, 4 T, 5 box tube, 6 Z, 7 trapezoid, 8 circle, 9 tube, 11 box",
                      {.check = Check::not_negative}},
                     {"K",
                      &R::k,
                      "-",
                      "with ICST: refines the points",
                      {.standard = 1, .check = Check::not_negative}}}},
         {.fields = {{"D1", &R::d1, "L",
                      "width W along s (1 to 6, 11), lower width (7), radius (8), outer radius (9)",
                      size_of_section},
                     {"D2", &R::d2, "L",
                      "flange thickness TF along t (1 to 6), upper width (7), inner radius (9), depth (11)",
                      size_of_section},
                     {"D3", &R::d3, "L", "depth D along t (1 to 6), depth (7)", size_of_section},
                     {"D4", &R::d4, "L", "web thickness TW along s (1 to 6)", size_of_section},
                     {"SREF", &R::sref, "-", "nodes off the middle in s", unsupported},
                     {"TREF", &R::tref, "-", "nodes off the middle in t", unsupported},
                     {"D5", &R::d5, "L", "of other standard sections", no_effect},
                     {"D6", &R::d6, "L", "of other standard sections", no_effect}},
          .when = [](const R& rule) { return rule.icst > 0; }},
         {.fields = {{"S", &R::s, "-", "place over half of TS1, -1 to 1"},
                     {"T", &R::t, "-", "place over half of TT1, -1 to 1"},
                     {"WF", &R::wf, "-", "share of the area", size_of_section},
                     {"PID", &R::pid, "-", "part with the material of the point", other_part}},
          .repeat = true,
          .when = [](const R& rule) { return rule.nip > 0; }}}}};

}  // namespace

}  // namespace courant
