// Tables of nodes, elements, parts, curves and boxes.
#include "keyword/registry.hpp"
#include "model/cards.hpp"

namespace courant {

namespace {

using N = NodeCard;
const RegisterKeyword<N> node{
    {.names = {"NODE"},
     .purpose = "coordinates of nodes",
     .cards = {
         {.fields = {
              {"NID", &N::nid, "-", "node id", {.required = true, .check = Check::positive, .width = 8}},
              {"X", &N::x, "L", "x coordinate", {.width = 16}},
              {"Y", &N::y, "L", "y coordinate", {.width = 16}},
              {"Z", &N::z, "L", "z coordinate", {.width = 16}},
              {"TC",
               &N::tc,
               "-",
               "held translations: 0 none, 1 x, 2 y, 3 z, 4 xy, 5 yz, 6 zx, 7 xyz",
               {.allowed = {0, 1, 2, 3, 4, 5, 6, 7}, .width = 8}},
              {"RC",
               &N::rc,
               "-",
               "held rotations, same code",
               {.honour = Honour::ignored, .allowed = {0, 1, 2, 3, 4, 5, 6, 7}, .width = 8}}}}}}};

using E = ElementSphCard;
const RegisterKeyword<E> element_sph{
    {.names = {"ELEMENT_SPH"},
     .purpose = "SPH particles; a particle has the id of its node",
     .cards = {
         {.fields = {
              {"NID", &E::nid, "-", "node id", {.required = true, .check = Check::positive, .width = 8}},
              {"PID", &E::pid, "-", "part id", {.required = true, .check = Check::positive, .width = 8}},
              {"MASS", &E::mass, "M", "mass; negative: volume, in 2D area, times -1", {.width = 16}},
              {"NEND",
               &E::nend,
               "-",
               "particles NID to NEND get the same data",
               {.check = Check::not_negative}}}}}}};

using S = ElementShellCard;
const FieldRules corner{.required = true, .check = Check::positive, .width = 8};
const FieldRules mid_side{.honour = Honour::no, .width = 8};
const RegisterKeyword<S> element_shell{
    {.names = {"ELEMENT_SHELL"},
     .purpose = "shells of 3 (N4 = N3 or 0) or 4 nodes",
     .cards = {{.fields = {{"EID", &S::eid, "-", "element id", corner},
                           {"PID", &S::pid, "-", "part id", corner},
                           {"N1", &S::n1, "-", "corner node 1", corner},
                           {"N2", &S::n2, "-", "corner node 2", corner},
                           {"N3", &S::n3, "-", "corner node 3", corner},
                           {"N4", &S::n4, "-", "corner node 4", {.check = Check::not_negative, .width = 8}},
                           {"N5", &S::n5, "-", "mid-side node", mid_side},
                           {"N6", &S::n6, "-", "mid-side node", mid_side},
                           {"N7", &S::n7, "-", "mid-side node", mid_side},
                           {"N8", &S::n8, "-", "mid-side node", mid_side}}}}}};

const FieldRules required_id{.required = true, .check = Check::positive};
const FieldRules optional_id{.check = Check::not_negative};
const FieldRules unsupported{.honour = Honour::no};
const FieldRules no_effect{.honour = Honour::ignored};

using P = PartCard;
const RegisterKeyword<P> part{
    {.names = {"PART"},
     .purpose = "parts: elements of one section and material",
     .heading = true,
     .title = &P::title,
     .cards = {{.fields = {{"PID", &P::pid, "-", "part id", required_id},
                           {"SECID", &P::secid, "-", "section id", required_id},
                           {"MID", &P::mid, "-", "material id", required_id},
                           {"EOSID", &P::eosid, "-", "equation of state id", optional_id},
                           {"HGID", &P::hgid, "-", "hourglass and bulk viscosity id", optional_id},
                           {"GRAV", &P::grav, "-", "gravity preload", unsupported},
                           {"ADPOPT", &P::adpopt, "-", "adaptivity", unsupported},
                           {"TMID", &P::tmid, "-", "thermal material id", unsupported}}}}}};

using C = DefineCurveCard;
const RegisterKeyword<C> define_curve{
    {.names = {"DEFINE_CURVE"},
     .purpose =
         "piecewise linear curve: SFO (ordinate + OFFO) at SFA (abscissa + OFFA); constant beyond its ends; "
         "two points with one abscissa are a jump, at which the later one holds",
     .title_option = true,
     .title = &C::title,
     .cards = {
         {.fields =
              {{"LCID", &C::lcid, "-", "curve id", required_id},
               {"SIDR", &C::sidr, "-", "phase: 0 transient, 2 transient and relaxation", {.allowed = {0, 2}}},
               {"SFA", &C::sfa, "-", "scale of the abscissa", {.standard = 1}},
               {"SFO", &C::sfo, "-", "scale of the ordinate", {.standard = 1}},
               {"OFFA", &C::offa, "-", "offset of the abscissa"},
               {"OFFO", &C::offo, "-", "offset of the ordinate"},
               {"DATTYP",
                &C::dattyp,
                "-",
                "kind of data: 0 over time, 1 pairs (x, y); the same here, as x may not decrease",
                {.allowed = {0, 1}}},
               {"LCINT", &C::lcint, "-", "number of points for resampling", no_effect}}},
         {.fields = {{"A1", &C::a, "-", "abscissa", {.width = 20}},
                     {"O1", &C::o, "-", "ordinate", {.width = 20}}},
          .repeat = true}}}};

using B = DefineBoxCard;
const RegisterKeyword<B> define_box{{.names = {"DEFINE_BOX"},
                                     .purpose = "box with sides along the axes",
                                     .title_option = true,
                                     .title = &B::title,
                                     .cards = {{.fields = {{"BOXID", &B::boxid, "-", "box id", required_id},
                                                           {"XMN", &B::xmn, "L", "lowest x"},
                                                           {"XMX", &B::xmx, "L", "highest x"},
                                                           {"YMN", &B::ymn, "L", "lowest y"},
                                                           {"YMX", &B::ymx, "L", "highest y"},
                                                           {"ZMN", &B::zmn, "L", "lowest z"},
                                                           {"ZMX", &B::zmx, "L", "highest z"}}}}}};

}  // namespace

}  // namespace courant
