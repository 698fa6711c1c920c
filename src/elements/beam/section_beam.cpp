#include "elements/beam/section_beam.hpp"

#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

using S = SectionBeam;
constexpr FieldRules measure{.check = Check::not_negative};

const RegisterKeyword<S> section_beam{
    {.names = {"SECTION_BEAM"},
     .purpose = "cross-sections and formulations of beams",
     .id_space = IdSpace::section,
     .title_option = true,
     .title = &S::title,
     .cards =
         {{.fields =
               {{"SECID", &S::secid, "-", "id that *PART refers to", rules::required_id},
                {"ELFORM",
                 &S::elform,
                 "-",
                 "1 Hughes-Liu with points in the section, 2 Belytschko-Schwer, 3 truss, 6 discrete beam or "
                 "cable, 9 weld",
                 {.standard = 1}},
                {"SHRF",
                 &S::shrf,
                 "-",
                 "factor of transverse shear of 1",
                 {.standard = 1, .check = Check::positive}},
                {"QR/IRID",
                 &S::rule,
                 "-",
                 "points in the section: 1, 2, 3, 4, 5, or minus the IRID of *INTEGRATION_BEAM",
                 {.standard = 2}},
                {"CST", &S::cst, "-", "0 rectangle, 1 tube, 2 by a rule"},
                {"SCOOR", &S::scoor, "-",
                 "discrete beams: their axes turn with end 1 (-3, -2, -1), end 2 (1, 2, 3), or the mean (0); "
                 "-2, 2: r stays on the line between the ends; -3, -2, 2, 3: shear forces turn the ends"},
                {"NSM", &S::nsm, "M/L", "mass per length besides the material's", measure},
                {"NAUPD", &S::naupd, "-", "neutral axis of damaged beams", no_effect}}},
          // only where the line begins with a word
          {.fields =
               {{"STYPE", &S::stype, "-",
                 "standard section: SECTION_01 to _09 and _11, as ICST of *INTEGRATION_BEAM"},
                {"D1", &S::d1, "L", "width W along s (01 to 06, 11), lower width (07), outer radius (08, 09)",
                 measure},
                {"D2", &S::d2, "L",
                 "flange thickness TF along t (01 to 06), upper width (07), inner radius (09), depth (11)",
                 measure},
                {"D3", &S::d3, "L", "depth D along t (01 to 07)", measure},
                {"D4", &S::d4, "L", "web thickness TW along s (01 to 06)", measure},
                {"D5", &S::d5, "L", "of other standard sections", no_effect},
                {"D6", &S::d6, "L", "of other standard sections", no_effect}},
           .optional = true,
           .when = [](const S& s) { return s.used() >= 1 && s.used() <= 3 && !s.weld(); }},
          {.fields = {{"TS1", &S::ts1, "L", "width in s at end 1; of a tube its outer diameter", measure},
                      {"TS2", &S::ts2, "L", "the same at end 2, 0: as at end 1", measure},
                      {"TT1", &S::tt1, "L", "width in t at end 1; of a tube its inner diameter", measure},
                      {"TT2", &S::tt2, "L", "the same at end 2, 0: as at end 1", measure},
                      {"NSLOC", &S::nsloc, "-", "nodes off the middle in s", unsupported},
                      {"NTLOC", &S::ntloc, "-", "nodes off the middle in t", unsupported}},
           .when = [](const S& s) { return s.used() == 1 && !s.weld() && s.stype.empty(); }},
          {.fields = {{"A", &S::a, "L2", "area", measure},
                      {"ISS", &S::iss, "L4", "second moment of area about s", measure},
                      {"ITT", &S::itt, "L4", "about t, 0: ISS", measure},
                      {"J", &S::j, "L4", "of torsion, 0: ISS + ITT", measure},
                      {"SA", &S::sa, "L2", "area of shear, 0: no shear strain", measure},
                      {"IST", &S::ist, "L4", "product moment", unsupported}},
           .when = [](const S& s) { return s.used() == 2 && s.stype.empty(); }},
          {.fields = {{"A", &S::a, "L2", "area", measure},
                      {"RAMPT", &S::rampt, "T", "ramp of a stress at the start", no_effect},
                      {"STRESS", &S::stress, "M/LT2", "stress at the start", unsupported}},
           .when = [](const S& s) { return s.used() == 3 && s.stype.empty(); }},
          {.fields = {{"VOL", &S::vol, "L3", "volume, 0: CA times the length", measure},
                      {"INER", &S::iner, "ML2",
                       "inertia of both ends of discrete beams about all axes; of cables none", measure},
                      {"CID",
                       &S::cid,
                       "-",
                       "axes of discrete beams at the start; 0: by the ends and the third node, or global",
                       {.check = Check::not_negative, .refers = IdSpace::coordinate_system}},
                      {"CA", &S::ca, "L2", "area of cables", measure},
                      {"OFFSET", &S::offset, "L",
                       "what cables are shorter without load than from end to end"},
                      {"RRCON", &S::rrcon, "-", "1: the axes of discrete beams do not turn about r"},
                      {"SRCON", &S::srcon, "-", "about s"},
                      {"TRCON", &S::trcon, "-", "about t"}},
           .when = [](const S& s) { return s.used() == 6; }},
          {.fields = {{"", {}, "-", "measures of other formulations, which are refused"}},
           .when = [](const S& s) { return s.used() == 0; }},
          {.fields = {{"TS1", &S::ts1, "L", "outer diameter at end 1", measure},
                      {"TS2", &S::ts2, "L", "the same at end 2, 0: as at end 1", measure},
                      {"TT1", &S::tt1, "L", "inner diameter at end 1, 0: a full circle", measure},
                      {"TT2", &S::tt2, "L", "the same at end 2, 0: as at end 1", measure},
                      {"PRINT", &S::print, "-", "1: not in swforc", {.honour = Honour::output_only}},
                      {},
                      {"ITOFF", &S::itoff, "-", "1: no torsional stiffness", unsupported}},
           .when = [](const S& s) { return s.weld(); }}}}};

}  // namespace

}  // namespace courant
