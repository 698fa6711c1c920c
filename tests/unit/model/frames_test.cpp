// Boxes, coordinate systems, vectors, curves and tables, and who uses them.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "small_deck.hpp"

namespace courant {

namespace {

void expect_near(const Vec& found, const Vec& expected) {
  EXPECT_LT((found - expected).norm(), 1e-14) << found.transpose() << " instead of " << expected.transpose();
}

const Vec e_x(1, 0, 0), e_y(0, 1, 0), e_z(0, 0, 1);

TEST(CoordinateSystems, FromPoints) {
  const SmallModel m =
      small_model("*DEFINE_COORDINATE_SYSTEM_TITLE\nturned\n7,1.,2.,3.,1.,5.,3.\n-4.,9.,3.\n");
  EXPECT_EQ(m.messages, "");
  const CoordinateSystem& s = m.model.coordinate_systems.at(7);
  expect_near(s.origin, {1, 2, 3});
  expect_near(s.axes.col(0), e_y);
  expect_near(s.axes.col(1), -e_x);
  expect_near(s.axes.col(2), e_z);
  EXPECT_FALSE(s.moves);
}

TEST(CoordinateSystems, FromPointsOfAnother) {  // in any order
  const SmallModel m = small_model(
      "*DEFINE_COORDINATE_SYSTEM\n8,1.,0.,0.,1.,0.,1.,7\n2.,0.,0.\n"
      "*DEFINE_COORDINATE_SYSTEM\n7,1.,2.,3.,1.,5.,3.\n-4.,9.,3.\n");
  EXPECT_EQ(m.messages, "");
  const CoordinateSystem& s = m.model.coordinate_systems.at(8);
  expect_near(s.origin, {1, 3, 3});
  expect_near(s.axes.col(0), e_z);  // local z of 7
  expect_near(s.axes.col(1), e_y);  // local x of 7
}

TEST(CoordinateSystems, FromNodes) {
  const SmallModel m = small_model(
      "*DEFINE_COORDINATE_NODES\n7,2,3,5\n*DEFINE_COORDINATE_NODE\n8,2,3,5,1,Y\n"
      "*DEFINE_COORDINATE_NODES\n9,2,3,5,0,z\n");
  EXPECT_EQ(m.messages, "");
  const auto& systems = m.model.coordinate_systems;
  EXPECT_TRUE(systems.at(7).axes.isIdentity());
  expect_near(systems.at(7).origin, e_x);
  expect_near(systems.at(8).axes.col(1), e_x);  // from node 2 to node 3
  expect_near(systems.at(8).axes.col(2), e_y);
  expect_near(systems.at(8).axes.col(0), e_z);
  EXPECT_TRUE(systems.at(8).moves);
  expect_near(systems.at(9).axes.col(2), e_x);
  expect_near(systems.at(9).axes.col(0), e_y);
}

TEST(CoordinateSystems, FromVectors) {
  const SmallModel m = small_model("*DEFINE_COORDINATE_VECTOR\n7,0.,0.,2.,5.,0.,5.\n");
  EXPECT_EQ(m.messages, "");
  const CoordinateSystem& s = m.model.coordinate_systems.at(7);
  expect_near(s.axes.col(0), e_z);
  expect_near(s.axes.col(1), e_x);
  expect_near(s.axes.col(2), e_y);
}

TEST(CoordinateSystems, HaveTitles) {
  const SmallModel m = small_model("*DEFINE_COORDINATE_VECTOR_TITLE\nturned\n7,0.,0.,2.,5.,0.,5.\n");
  EXPECT_EQ(m.messages, "");
  EXPECT_EQ(m.model.coordinate_systems.count(7), 1u);
}

TEST(Vectors, FromPointsAndNodes) {
  const SmallModel m = small_model(
      "*DEFINE_VECTOR\n1,0.,0.,0.,1.,0.,0.,7\n*DEFINE_VECTOR_NODES\n2,1,9\n"
      "*DEFINE_COORDINATE_VECTOR\n7,0.,0.,2.,5.,0.,5.\n");
  EXPECT_EQ(m.messages, "");
  expect_near(m.model.vectors.at(1).head, e_z);
  expect_near(m.model.vectors.at(2).head - m.model.vectors.at(2).tail, {2, 2, 0});
}

TEST(Boxes, WithAxesOfTheirOwn) {
  const SmallModel m = small_model(
      "*DEFINE_BOX_LOCAL\n4,0.,2.,0.,1.,-1.,1.\n0.,1.,0.,-1.,0.,0.\n1.,0.,0.\n"
      "*SET_NODE_GENERAL\n1\nBOX,4\n");
  EXPECT_EQ(m.messages, "");
  const Box& box = m.model.boxes.at(4);
  EXPECT_TRUE(box.contains({0.5, 1.5, 0}));
  EXPECT_FALSE(box.contains({1.5, 0.5, 0}));
  EXPECT_EQ(m.model.node_sets.at(1), (std::vector<Index>{0, 1, 3, 4, 6, 7, 9}));  // 1 2 4 5 7 8 and 11
}

TEST(Velocities, InASystemOfTheirOwn) {
  const SmallModel m = small_model(
      "*DEFINE_COORDINATE_VECTOR\n7,0.,1.,0.,-1.,0.,0.\n"
      "*INITIAL_VELOCITY\n2,3,0,0,7\n1.,2.,3.\n4.,5.,6.\n*SET_NODE\n2\n1,2\n*SET_NODE\n3\n3\n");
  EXPECT_EQ(m.messages, "");
  expect_near(m.model.nodes[0].v, {-2, 1, 3});
  expect_near(m.model.nodes[2].v, {-5, 4, 6});  // NSIDEX
  const SmallModel n = small_model(
      "*DEFINE_COORDINATE_VECTOR\n7,0.,1.,0.,-1.,0.,0.\n*INITIAL_VELOCITY_NODE\n5,1.,2.,3.,0.,0.,0.,7\n");
  EXPECT_EQ(n.messages, "");
  expect_near(n.model.nodes[4].v, {-2, 1, 3});
}

TEST(Velocities, OfARotationInASystemOfItsOwn) {  // the centre stays global
  const SmallModel m = small_model(
      "*DEFINE_COORDINATE_VECTOR\n7,0.,0.,1.,1.,0.,0.\n"
      "*INITIAL_VELOCITY_GENERATION\n1,2,2.,5.,0.,0.,0,7\n.5,0.,1.,1.,0.,0.\n");
  EXPECT_EQ(m.messages, "");
  expect_near(m.model.nodes[9].v, {-1, 0, 5});  // 2 e_z x (0, 0.5, 0) + 5 e_z
}

TEST(Constraints, InASystemAlongTheGlobalAxes) {
  const SmallModel m = small_model(
      "*DEFINE_COORDINATE_VECTOR\n7,0.,0.,-1.,1.,0.,0.\n*BOUNDARY_SPC_NODE\n5,7,1,0,0\n"
      "*DEFINE_COORDINATE_VECTOR\n8,1.,1.,0.,0.,1.,0.\n*BOUNDARY_SPC_NODE\n6,8,1,1,1\n");
  EXPECT_EQ(m.messages, "");
  EXPECT_EQ(m.model.nodes[4].fixed, (std::array<bool, 3>{false, false, true}));
  EXPECT_EQ(m.model.nodes[5].fixed, (std::array<bool, 3>{true, true, true}));
}

TEST(Curves, MayJump) {
  const SmallModel m = small_model("*DEFINE_CURVE\n1,0,0.,0.,0.,0.,1\n0.,1.\n1.,1.\n1.,3.\n2.,4.\n2.,7.\n");
  EXPECT_EQ(m.messages, "");
  const Curve& curve = m.model.curves.at(1);
  EXPECT_EQ(curve(0.5), 1);
  EXPECT_EQ(curve(std::nextafter(1.0, 0.0)), 1);
  EXPECT_EQ(curve(1), 3);  // the later point holds
  EXPECT_EQ(curve(1.5), 3.5);
  EXPECT_EQ(curve(2), 7);
  EXPECT_EQ(curve(9), 7);
}

TEST(Tables, TakeTheCurvesBehindThem) {
  const SmallModel m = small_model(
      "*DEFINE_CURVE\n9\n0.,1.\n*DEFINE_TABLE\n1,2.,1.\n1.\n2.\n*DEFINE_CURVE\n5\n0.,1.\n"
      "*DEFINE_CURVE\n4\n0.,1.\n*DEFINE_CURVE\n6\n0.,1.\n");
  EXPECT_EQ(m.messages, "");
  EXPECT_EQ(m.model.tables.at(1).value, (std::vector<Real>{4, 6}));
  EXPECT_EQ(m.model.tables.at(1).curve, (std::vector<Id>{5, 4}));
}

TEST(Tables, OfCurvesAndOfTables) {
  const SmallModel m = small_model(
      "*DEFINE_TABLE_3D\n3\n0.,2\n*DEFINE_TABLE_2D_TITLE\nrates\n2\n                 1.0                   "
      "9\n"
      "*DEFINE_CURVE\n9\n0.,1.\n");
  EXPECT_EQ(m.messages, "");
  EXPECT_EQ(m.model.tables.at(2).curve, std::vector<Id>{9});
  EXPECT_TRUE(m.model.tables.at(3).of_tables);
}

struct Fault {
  const char* name;
  const char* keywords;
  const char* message;
};
const auto name_of = [](const auto& test) { return std::string(test.param.name); };

class FaultyFrame : public testing::TestWithParam<Fault> {};

TEST_P(FaultyFrame, IsRefused) {
  const SmallModel m = small_model(GetParam().keywords);
  EXPECT_NE(m.messages.find(GetParam().message), std::string::npos) << m.messages;
  EXPECT_EQ(m.messages.find("error"), m.messages.rfind("error")) << m.messages;
}

INSTANTIATE_TEST_SUITE_P(
    Reasons, FaultyFrame,
    testing::Values(
        Fault{"SystemOnALine", "*DEFINE_COORDINATE_SYSTEM\n7,1.,2.,3.,1.,5.,3.\n1.,9.,3.\n",
              "the three points of system 7 are on one line"},
        Fault{"SystemOfNodesOnALine", "*DEFINE_COORDINATE_NODES\n7,1,2,3\n",
              "nodes 1, 2 and 3 are on one line"},
        Fault{"SystemOfUnknownAxis", "*DEFINE_COORDINATE_NODES\n7,1,2,5,0,W\n", "'W' is not an axis"},
        Fault{"SystemOfParallelVectors", "*DEFINE_COORDINATE_VECTOR\n7,1.,0.,0.,2.,0.,0.\n",
              "the two directions are parallel or zero"},
        Fault{"CylindricalSystem", "*DEFINE_COORDINATE_SYSTEM\n7,0.,0.,0.,1.,0.,0.\n0.,1.,0.,1\n",
              "(TYPE, 0 Cartesian [-]): '1' is not supported"},
        Fault{"SystemOfItself", "*DEFINE_COORDINATE_SYSTEM\n7,0.,0.,0.,1.,0.,0.,7\n0.,1.,0.\n",
              "system 7 is given in itself, or in one that is given in it"},
        Fault{"SystemOfNone", "*DEFINE_COORDINATE_SYSTEM\n7,0.,0.,0.,1.,0.,0.,8\n0.,1.,0.\n",
              "coordinate system 8 does not exist"},
        Fault{"VectorWithoutLength", "*DEFINE_VECTOR\n1,1.,1.,1.,1.,1.,1.\n", "vector 1 has no length"},
        Fault{"VectorOfOneNode", "*DEFINE_VECTOR_NODES\n1,2,2\n", "vector 1 has no length: nodes 2 and 2"},
        Fault{"LocalBoxUpsideDown", "*DEFINE_BOX_LOCAL\n4,2.,1.\n1.,0.,0.,0.,1.,0.\n0.,0.,0.\n",
              "expected a number not below the lowest, 2, got '1'"},
        Fault{"LocalBoxWithoutAxes", "*DEFINE_BOX_LOCAL\n4,0.,1.\n0.\n0.,0.,0.\n", "parallel or zero"},
        Fault{"BoxTwice",
              "*DEFINE_BOX_LOCAL\n4,0.,1.\n1.,0.,0.,0.,1.,0.\n0.\n*DEFINE_BOX_LOCAL\n4,0.,1.\n"
              "1.,0.,0.,0.,1.,0.\n0.\n",
              "box 4 is defined twice"},
        Fault{"VelocityWithoutSystem", "*INITIAL_VELOCITY\n0,0,0,0,7\n1.\n",
              "coordinate system 7 does not exist"},
        Fault{"ConstraintThatTurns", "*DEFINE_COORDINATE_NODES\n7,1,2,5,1\n*BOUNDARY_SPC_NODE\n1,7,1\n",
              "system 7 is not supported, as it turns with nodes"},
        Fault{"CurveBackwards", "*DEFINE_CURVE\n1\n0.,1.\n1.,1.\n0.5,3.\n",
              "the abscissas of curve 1 decrease from point 2 to point 3"},
        Fault{"CurveOfAnotherKind", "*DEFINE_CURVE\n1,0,0.,0.,0.,0.,-2\n0.,1.\n",
              "'-2' is not supported\n  hint: supported values: 0, 1"},
        Fault{"TableWithoutCurves", "*DEFINE_TABLE\n1\n1.\n2.\n*DEFINE_CURVE\n5\n0.,1.\n",
              "the table has 2 values, but 1 *DEFINE_CURVE follow"},
        Fault{"TableWithoutValues", "*DEFINE_TABLE\n1\n", "the table has no values"},
        Fault{"TableNotIncreasing", "*DEFINE_TABLE_2D\n1\n1.,5\n1.,5\n*DEFINE_CURVE\n5\n0.,1.\n",
              "the values of table 1 do not increase from row 1 to row 2"},
        Fault{"TableOfNoCurve", "*DEFINE_TABLE_2D\n1\n1.,5\n", "curve 5 does not exist"},
        Fault{"TableOfNoTable", "*DEFINE_TABLE_3D\n1\n1.,5\n*DEFINE_CURVE\n5\n0.,1.\n",
              "table 5 does not exist"}),
    name_of);

}  // namespace

}  // namespace courant
