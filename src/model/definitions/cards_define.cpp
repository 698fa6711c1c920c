// Tables of *DEFINE_TABLE, local boxes, coordinate systems and vectors.
#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"
#include "model/definitions/define_cards.hpp"
#include "model/definitions/definition_cards.hpp"
#include "model/transforms/transformation.hpp"

namespace courant {

namespace {

using namespace rules;

const FieldRules cartesian{.allowed = {0}};

/// Locations in a system of the file are given along its axes, which have length 1 whatever the file does.
template <class T, Id T::*Local>
std::string refuse_scaling(T& card, const Affine& motion) {
  if (card.*Local == 0) return {};
  if (motion.linear().determinant() < 0) return "the file is mirrored, and a system is right-handed";
  return refuse_stretch(motion, "positions in a system");
}

const RegisterKeyword<DefineBoxLocalCard> define_box_local{define_box_local_table()};

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

const RegisterKeyword<CoordinateNodesCard> coordinate_nodes{define_coordinate_nodes_table()};
const RegisterKeyword<CoordinateVectorCard> coordinate_vector{define_coordinate_vector_table()};

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

const RegisterKeyword<DefineVectorNodesCard> define_vector_nodes{define_vector_nodes_table()};

template <class T>
CardOf<T> table_card() {
  return {.fields = {{"TBID", &T::tbid, "-", "table id", required_id},
                     {"SFA", &T::sfa, "-", "scale of VALUE", {.standard = 1}},
                     {"OFFA", &T::offa, "-", "offset of VALUE"}}};
}

using T = DefineTableCard;
const RegisterKeyword<T> define_table{define_table_table()};

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

/// The sides are along the axes as lengths: they can be turned and shifted, not stretched.
std::string refuse_stretching(DefineBoxLocalCard&, const Affine& motion) {
  const Matrix turn = motion.linear();
  const bool rigid = (turn.transpose() * turn).isIdentity(1e-9) && turn.determinant() > 0;
  return rigid ? "" : "a local box can be turned and shifted, but not stretched or mirrored";
}

}  // namespace courant
