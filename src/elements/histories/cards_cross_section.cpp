// Tables of *DATABASE_CROSS_SECTION and *DATABASE_SECFORC.
#include "elements/histories/cards_cross_section.hpp"

#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

template <class T>
FieldOf<T> system_of_section(const char* name) {
  return {
      name,
      &T::system,
      "-",
      "whose axes tell force and moment, 0 global",
      FieldRules{.check = Check::not_negative},
      [](const T& card) {
        return card.itype == 2 ? IdSpace::coordinate_system : card.itype == 0 ? IdSpace::part : IdSpace::none;
      }};
}
template <class T>
FieldOf<T> kind_of_system() {
  return {"ITYPE", &T::itype, "-", "what ID numbers: 0 rigid body, 1 accelerometer, 2 coordinate system",
          FieldRules{.allowed = {0, 1, 2}}};
}

using P = CrossSectionPlaneCard;
const FieldRules length_of_edge{.check = Check::not_negative};
const RegisterKeyword<P> cross_section_plane{
    {.names = {"DATABASE_CROSS_SECTION_PLANE"},
     .purpose = "cross section through what a plane cuts at the start, for secforc",
     .id_option = true,
     .title = &P::heading,
     .id = &P::csid,
     .cards = {
         {.fields = {{"PSID", &P::psid, "-", "parts, 0 all", rules::optional_id_of(IdSpace::part_set)},
                     {"XCT", &P::xct, "L", "tail of the normal, on the plane", rules::point},
                     {"YCT", &P::yct, "L", "y of it"},
                     {"ZCT", &P::zct, "L", "z of it"},
                     {"XCH", &P::xch, "L", "its head", rules::point},
                     {"YCH", &P::ych, "L", "y of it"},
                     {"ZCH", &P::zch, "L", "z of it"},
                     {"RADIUS", &P::radius, "L", "of a disc around the tail, 0 none", length_of_edge}}},
         {.fields = {{"XHEV", &P::xhev, "L", "head of the edge vector, whose tail is that of the normal",
                      rules::point},
                     {"YHEV", &P::yhev, "L", "y of it"},
                     {"ZHEV", &P::zhev, "L", "z of it"},
                     {"LENL", &P::lenl, "L", "length along the edge vector, 0 without end", length_of_edge},
                     {"LENM", &P::lenm, "L", "length across it, 0 without end", length_of_edge},
                     system_of_section<P>("ID"),
                     kind_of_system<P>()}}}}};

using S = CrossSectionSetCard;
const RegisterKeyword<S> cross_section_set{
    {.names = {"DATABASE_CROSS_SECTION_SET"},
     .purpose = "cross section: nodes, and the elements on one side of them, for secforc",
     .id_option = true,
     .title = &S::heading,
     .id = &S::csid,
     .cards = {{.fields = {{"NSID", &S::nsid, "-", "nodes", rules::required_id_of(IdSpace::node_set)},
                           {"HSID", &S::hsid, "-", "solids", rules::optional_id_of(IdSpace::solid_set)},
                           {"BSID", &S::bsid, "-", "beams", rules::optional_id_of(IdSpace::beam_set)},
                           {"SSID", &S::ssid, "-", "shells", rules::optional_id_of(IdSpace::shell_set)},
                           {"TSID", &S::tsid, "-", "thick shells", unsupported},
                           {"DSID", &S::dsid, "-", "springs and dampers", unsupported},
                           system_of_section<S>("ID"),
                           kind_of_system<S>()}}}}};

const RegisterKeyword<DatabaseSecforc> database_secforc{history_interval<DatabaseSecforc>(
    "DATABASE_SECFORC", "interval of secforc: force, moment, centroid and area of each cross section")};

}  // namespace

}  // namespace courant
