// Tables of *DEFINE_TABLE, local boxes, coordinate systems and vectors.
#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"
#include "model/definitions/define_cards.hpp"
#include "model/transforms/transformation.hpp"

namespace courant {

namespace {

using namespace rules;

const FieldRules cartesian{.allowed = {0}};

/// The sides stand along the axes as lengths: they can be turned and shifted, not stretched.
std::string refuse_stretching(DefineBoxLocalCard&, const Affine& motion) {
  const Matrix turn = motion.linear();
  const bool rigid = (turn.transpose() * turn).isIdentity(1e-9) && turn.determinant() > 0;
  return rigid ? "" : "a local box can be turned and shifted, but not stretched or mirrored";
}

/// Places in a system of the file are told by its axes, which have length 1 whatever the file does.
template <class T, Id T::*Local>
std::string refuse_scaling(T& card, const Affine& motion) {
  if (card.*Local == 0) return {};
  if (motion.linear().determinant() < 0) return "the file is mirrored, and a system is right-handed";
  return refuse_stretch(motion, "places in a system");
}

using B = DefineBoxLocalCard;
const RegisterKeyword<B> define_box_local{
    {.names = {"DEFINE_BOX_LOCAL"},
     .purpose = "box with axes and an origin of its own; its sides are given along these axes",
     .id_space = IdSpace::box,
     .title_option = true,
     .title = &B::title,
     .cards = {{.fields = {{"BOXID", &B::boxid, "-", "box id", required_id},
                           {"XMN", &B::xmn, "L", "lowest local x"},
                           {"XMX", &B::xmx, "L", "highest local x"},
                           {"YMN", &B::ymn, "L", "lowest local y"},
                           {"YMX", &B::ymx, "L", "highest local y"},
                           {"ZMN", &B::zmn, "L", "lowest local z"},
                           {"ZMX", &B::zmx, "L", "highest local z"}}},
               {.fields = {{"XX", &B::xx, "-", "local x axis, x", direction},
                           {"YX", &B::yx, "-", "local x axis, y"},
                           {"ZX", &B::zx, "-", "local x axis, z"},
                           {"XV", &B::xv, "-", "a vector in the local xy plane, x", direction},
                           {"YV", &B::yv, "-", "a vector in the local xy plane, y"},
                           {"ZV", &B::zv, "-", "a vector in the local xy plane, z"}}},
               {.fields = {{"CX", &B::cx, "L", "origin, x", point},
                           {"CY", &B::cy, "L", "origin, y"},
                           {"CZ", &B::cz, "L", "origin, z"}}}},
     .move = refuse_stretching}};

using S = CoordinateSystemCard;
const RegisterKeyword<S> coordinate_system{
    {.names = {"DEFINE_COORDINATE_SYSTEM"},
     .purpose = "coordinate system by three points: origin, on the x axis, in the xy plane",
     .id_space = IdSpace::coordinate_system,
     .title_option = true,
     .title = &S::title,
     .local = &S::cidl,
     .cards = {{.fields = {{"CID", &S::cid, "-", "system id", required_id},
                           {"XO", &S::xo, "L", "origin, x", point},
                           {"YO", &S::yo, "L", "origin, y"},
                           {"ZO", &S::zo, "L", "origin, z"},
                           {"XL", &S::xl, "L", "point on the local x axis, x", point},
                           {"YL", &S::yl, "L", "point on the local x axis, y"},
                           {"ZL", &S::zl, "L", "point on the local x axis, z"},
                           {"CIDL", &S::cidl, "-", "system in which the points are given, 0 global",
                            optional_id_of(IdSpace::coordinate_system)}}},
               {.fields = {{"XP", &S::xp, "L", "point in the local xy plane, x", point},
                           {"YP", &S::yp, "L", "point in the local xy plane, y"},
                           {"ZP", &S::zp, "L", "point in the local xy plane, z"},
                           {"TYPE", &S::type, "-", "0 Cartesian", cartesian}}}},
     .move = refuse_scaling<S, &S::cidl>}};

using N = CoordinateNodesCard;
const RegisterKeyword<N> coordinate_nodes{
    {.names = {"DEFINE_COORDINATE_NODES", "DEFINE_COORDINATE_NODE"},
     .purpose = "coordinate system by three nodes",
     .id_space = IdSpace::coordinate_system,
     .title_option = true,
     .title = &N::title,
     .cards = {{.fields = {{"CID", &N::cid, "-", "system id", required_id},
                           {"N1", &N::n1, "-", "node at the origin", required_id_of(IdSpace::node)},
                           {"N2", &N::n2, "-", "node on the axis DIR", required_id_of(IdSpace::node)},
                           {"N3", &N::n3, "-", "node in the plane of DIR and the axis behind it (xy, yz, zx)",
                            required_id_of(IdSpace::node)},
                           {"FLAG", &N::flag, "-", "1: turns with the nodes", {.allowed = {0, 1}}},
                           {"DIR", &N::dir, "-", "axis from N1 to N2: X, Y or Z; blank X"},
                           {"TYPE", &N::type, "-", "0 Cartesian", cartesian}}}}}};

using V = CoordinateVectorCard;
const RegisterKeyword<V> coordinate_vector{
    {.names = {"DEFINE_COORDINATE_VECTOR"},
     .purpose = "coordinate system by two vectors; its origin is (0, 0, 0)",
     .id_space = IdSpace::coordinate_system,
     .title_option = true,
     .title = &V::title,
     .cards = {{.fields = {{"CID", &V::cid, "-", "system id", required_id},
                           {"XX", &V::xx, "-", "local x axis, x", direction},
                           {"YX", &V::yx, "-", "local x axis, y"},
                           {"ZX", &V::zx, "-", "local x axis, z"},
                           {"XV", &V::xv, "-", "a vector in the local xy plane, x", direction},
                           {"YV", &V::yv, "-", "a vector in the local xy plane, y"},
                           {"ZV", &V::zv, "-", "a vector in the local xy plane, z"},
                           {"NID", &V::nid, "-", "the system turns with this node",
                            optional_id_of(IdSpace::node)}}}}}};

using D = DefineVectorCard;
const RegisterKeyword<D> define_vector{
    {.names = {"DEFINE_VECTOR"},
     .purpose = "vector from tail to head",
     .id_space = IdSpace::vector,
     .title_option = true,
     .title = &D::title,
     .local = &D::cid,
     .cards = {{.fields = {{"VID", &D::vid, "-", "vector id", required_id},
                           {"XT", &D::xt, "L", "tail, x", point},
                           {"YT", &D::yt, "L", "tail, y"},
                           {"ZT", &D::zt, "L", "tail, z"},
                           {"XH", &D::xh, "L", "head, x", point},
                           {"YH", &D::yh, "L", "head, y"},
                           {"ZH", &D::zh, "L", "head, z"},
                           {"CID", &D::cid, "-", "system in which they are given, 0 global",
                            optional_id_of(IdSpace::coordinate_system)}}}},
     .move = refuse_scaling<D, &D::cid>}};

using DN = DefineVectorNodesCard;
const RegisterKeyword<DN> define_vector_nodes{
    {.names = {"DEFINE_VECTOR_NODES"},
     .purpose = "vector from one node to another",
     .id_space = IdSpace::vector,
     .title_option = true,
     .title = &DN::title,
     .cards = {{.fields = {{"VID", &DN::vid, "-", "vector id", required_id},
                           {"NODET", &DN::nodet, "-", "node at the tail", required_id_of(IdSpace::node)},
                           {"NODEH", &DN::nodeh, "-", "node at the head", required_id_of(IdSpace::node)}}}}}};

template <class T>
CardOf<T> table_card() {
  return {.fields = {{"TBID", &T::tbid, "-", "table id", required_id},
                     {"SFA", &T::sfa, "-", "scale of VALUE", {.standard = 1}},
                     {"OFFA", &T::offa, "-", "offset of VALUE"}}};
}

using T = DefineTableCard;
const RegisterKeyword<T> define_table{
    {.names = {"DEFINE_TABLE"},
     .purpose = "curves over a parameter: one *DEFINE_CURVE for each VALUE must follow, in the same order",
     .id_space = IdSpace::curve,
     .title_option = true,
     .title = &T::title,
     .cards = {
         table_card<T>(),
         {.fields = {{"VALUE", &T::value, "-", "value of the parameter, increasing", {.width = 20}}, {}},
          .repeat = true}}}};

template <class C>
KeywordOf<C> table_of_ids(std::string name, std::string purpose, const char* field) {
  return {
      .names = {std::move(name)},
      .purpose = std::move(purpose),
      .id_space = IdSpace::curve,
      .title_option = true,
      .title = &C::title,
      .cards = {table_card<C>(),
                {.fields = {{"VALUE", &C::value, "-", "value of the parameter, increasing", {.width = 20}},
                            {field,
                             &C::curveid,
                             "-",
                             "id of what holds there",
                             {.check = Check::not_negative, .width = 20, .refers = IdSpace::curve}}},
                 .repeat = true}}};
}
const RegisterKeyword<DefineTable2dCard> define_table_2d{
    table_of_ids<DefineTable2dCard>("DEFINE_TABLE_2D", "curves over a parameter, by their ids", "CURVEID")};
const RegisterKeyword<DefineTable3dCard> define_table_3d{
    table_of_ids<DefineTable3dCard>("DEFINE_TABLE_3D", "tables over a parameter, by their ids", "TABLEID")};

}  // namespace

}  // namespace courant
