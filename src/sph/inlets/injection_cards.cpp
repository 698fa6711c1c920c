// The cards of inlets.
#include "sph/inlets/injection_cards.hpp"

#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"

namespace courant {

using namespace rules;

namespace {

const FieldRules not_negative{.check = Check::not_negative};
FieldRules unsupported_id_of(IdSpace space) {
  return {.honour = Honour::no, .refers = space};
}

KeywordOf<DefineSphInjection> define_sph_injection() {
  using T = DefineSphInjection;
  return {
      .names = {"DEFINE_SPH_INJECTION"},
      .purpose =
          "inlet: layers of particles that enter at the nodes of a set, one each time the flow has gone "
          "one spacing",
      .title_option = true,
      .title = &T::title,
      .cards = {
          {.fields = {{"PID", &T::pid, "-", "part of the new particles", required_id_of(IdSpace::part)},
                      {"NSID", &T::nsid, "-", "nodes at which particles enter; blank with RADIUS or XLEN",
                       id_of(IdSpace::node_set)},
                      {"CID", &T::cid, "-", "system whose z is the normal of the inlet; 0: the velocity is",
                       id_of(IdSpace::coordinate_system)},
                      {"VX", &T::vx, "L/T", "velocity, along the global axes", direction},
                      {"VY", &T::vy, "L/T", "velocity"},
                      {"VZ", &T::vz, "L/T", "velocity"},
                      {"AREA", &T::area, "L2",
                       "area of the inlet, 2D: length; 0: from the square lattice of the nodes",
                       not_negative},
                      {"VMAG",
                       &T::vmag,
                       "-",
                       "factor on the velocity, 0: 1; < 0: curve |VMAG| of it over time",
                       {.curve = {"T", "-"}},
                       [](const T& e) { return e.vmag > 0 ? IdSpace::none : IdSpace::curve; }}}},
          {.fields = {{"TBEG", &T::tbeg, "T", "start time", not_negative},
                      {"TEND", &T::tend, "T", "end time", {.standard = 1e20, .check = Check::positive}},
                      {"NID", &T::nid, "-", "node that the inlet follows", unsupported_id_of(IdSpace::node)},
                      {"RADIUS", &T::radius, "L", "circular inlet around the origin of CID", not_negative},
                      {"XLEN", &T::xlen, "L", "rectangular inlet around the origin of CID, along its x",
                       not_negative},
                      {"YLEN", &T::ylen, "L", "the same along y", not_negative},
                      {"PSIZE", &T::psize, "L", "spacing of particles, with RADIUS or XLEN", not_negative}},
           .optional = true}}};
}
const RegisterKeyword<DefineSphInjection> define_sph_injection_keyword{define_sph_injection()};

/// VEL or FLWRT < 0 is an id in a field of a number, which neither offsets of ids nor units know.
template <class T>
std::string keep_curve(T& card, const Conversion& conversion) {
  if (!(card.vel < 0 && (conversion.offsets.any() || conversion.units.any()))) return {};
  return "the curve that its second field names would need the file's offsets of ids and unit factors";
}

template <class T>
KeywordOf<T> simplified(std::string name, std::string purpose, FieldOf<T> flow) {
  return {
      .names = {std::move(name)},
      .purpose = std::move(purpose),
      .title_option = true,
      .title = &T::title,
      .cards =
          {{.fields =
                {{"PID", &T::pid, "-", "part of the new particles", required_id_of(IdSpace::part)},
                 std::move(flow),
                 {"RADIUS", &T::radius, "L", "inlet radius", {.required = true, .check = Check::positive}},
                 {"PSIZE", &T::psize, "L", "particle spacing", {.required = true, .check = Check::positive}},
                 {"OFFST", &T::offst, "L", "offset of the inlet along its normal"},
                 {"CID", &T::cid, "-", "inlet system (origin, z normal); 0: by the second card",
                  id_of(IdSpace::coordinate_system)},
                 {"NID", &T::nid, "-", "node that the inlet follows", unsupported_id_of(IdSpace::node)}}},
           {.fields = {{"XC", &T::xc, "L", "x of the centre of the inlet", point},
                       {"YC", &T::yc, "L", "y of the centre"},
                       {"ZC", &T::zc, "L", "z of the centre"},
                       {"DNX", &T::dnx, "-", "normal of the inlet, downstream, x", direction},
                       {"DNY", &T::dny, "-", "normal of the inlet, y"},
                       {"DNZ", &T::dnz, "-", "normal of the inlet, z"},
                       {"TBEG", &T::tbeg, "T", "start time", not_negative},
                       {"TEND", &T::tend, "T", "end time", {.standard = 1e20, .check = Check::positive}}},
            .optional = true}},
      .convert = keep_curve<T>};
}

using Simplified = DefineSphInjectionSimplified;
const RegisterKeyword<Simplified> simplified_keyword{simplified<Simplified>(
    "DEFINE_SPH_INJECTION_SIMPLIFIED", "circular inlet, 2D: a line of twice the radius",
    {"VEL",
     &Simplified::vel,
     "L/T",
     "speed along the normal; < 0: curve |VEL| of it over time",
     {.required = true}})};

using Flowrate = DefineSphInjectionFlowrate;
const RegisterKeyword<Flowrate> flowrate_keyword{simplified<Flowrate>(
    "DEFINE_SPH_INJECTION_SIMPLIFIED_FLOWRATE", "circular inlet with a given volume flow",
    {"FLWRT",
     &Flowrate::vel,
     "L3/T",
     "volume per time, 2D: per unit of depth; < 0: curve |FLWRT| of it over time",
     {.required = true}})};

}  // namespace

}  // namespace courant
