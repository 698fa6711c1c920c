// *DEFINE_TRANSFORMATION: each operation against its meaning, order, and faults.
#include "model/transforms/transformation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../keyword/decks_in_memory.hpp"
#include "model/transforms/included_entries.hpp"

namespace courant {

namespace {

constexpr Real near = 1e-14;

struct Evaluated {
  Affine motion;
  std::string text;
};

Evaluated evaluated(const std::string& operations, const std::string& more = "") {
  DecksInMemory decks{{{"t.k", "*KEYWORD\n*DEFINE_TRANSFORMATION\n7\n" + operations + more + "*END\n"}}};
  Diagnostics diagnostics;
  Deck deck = decks.read("t.k", diagnostics);
  move_included_entries(deck, diagnostics);
  const Affine* found = find_transformation(deck, 7);
  return {found ? *found : Affine::Identity(), diagnostics.text()};
}

Affine motion(const std::string& operations, const std::string& more = "") {
  const Evaluated out = evaluated(operations, more);
  EXPECT_EQ(out.text, "");
  return out.motion;
}

void expect_moves(const Affine& motion, const Vec& from, const Vec& to) {
  EXPECT_LT((motion * from - to).norm(), near) << (motion * from).transpose();
}

}  // namespace

TEST(Transformation, Translates) {
  expect_moves(motion("TRANSL, 1.0, -2.0, 0.5\n"), {1, 1, 1}, {2, -1, 1.5});
  expect_moves(motion("transl         1.0      -2.0\n"), {1, 1, 1}, {2, -1, 1});
}

TEST(Transformation, ScalesWithBlankAsOne) {
  expect_moves(motion("SCALE, 2.0, , -3.0\n"), {1, 1, 1}, {2, 1, -3});
}

TEST(Transformation, MirrorsAtThePlaneThroughTheFirstPoint) {
  // plane x + y = 2, through (1, 1, 0)
  expect_moves(motion("MIRROR, 1.0, 1.0, 0.0, 2.0, 2.0\n"), {0, 0, 5}, {2, 2, 5});
  EXPECT_NEAR(motion("MIRROR, 1.0, 1.0, 0.0, 2.0, 2.0\n").linear().determinant(), -1, near);
}

TEST(Transformation, RotatesAboutALine) {
  expect_moves(motion("ROTATE, 0.0, 0.0, 2.0, 1.0, 0.0, 0.0, 90.0\n"), {2, 0, 3}, {1, 1, 3});
  const Real c = std::cos(pi / 6), s = std::sin(pi / 6);
  expect_moves(motion("ROTATE, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 30.0\n"), {4, 1, 0}, {4, c, s});
  // about the diagonal by a third of a turn: x to y to z
  expect_moves(motion("ROTATE, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 120.0\n"), {1, 2, 3}, {3, 1, 2});
  expect_moves(motion("ROTATE, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0\n"), {1, 2, 3}, {1, 2, 3});
}

TEST(Transformation, IsExactForQuarterTurns) {
  for (const Real degrees : {90.0, 180.0, 270.0, -90.0, 360.0}) {
    const Matrix m = rotation(Vec(0, 0, 3), degrees);
    EXPECT_EQ(m, m.array().round().matrix()) << degrees;
    EXPECT_TRUE(maps_axes(Affine(m)));
  }
  EXPECT_FALSE(maps_axes(Affine(rotation(Vec(0, 0, 1), 89.999))));
}

TEST(Transformation, RotatesAboutTwoPoints) {
  expect_moves(motion("POINT, 1, 1.0, 0.0, 0.0\nPOINT, 2, 1.0, 0.0, 9.0\nROTATE, 1, 2, 90.0\n"), {2, 0, 3},
               {1, 1, 3});
}

TEST(Transformation, MovesPointsWithAllOperationsAbove) {
  // whether a POINT is above or below the translation, the axis is at x = 11 when it is used
  for (const char* operations :
       {"POINT, 1, 1.0\nPOINT, 2, 1.0, 0.0, 1.0\nTRANSL, 10.0\nROTATE, 1, 2, 90.0\n",
        "TRANSL, 10.0\nPOINT, 1, 1.0\nPOINT, 2, 1.0, 0.0, 1.0\nROTATE, 1, 2, 90.0\n"})
    expect_moves(motion(operations), {2, 0, 0}, {11, 1, 0});
}

TEST(Transformation, AppliesOperationsInTheirOrder) {
  expect_moves(motion("SCALE, 2.0, 2.0, 2.0\nTRANSL, 1.0\n"), {1, 1, 1}, {3, 2, 2});
  expect_moves(motion("TRANSL, 1.0\nSCALE, 2.0, 2.0, 2.0\n"), {1, 1, 1}, {4, 2, 2});
  expect_moves(motion("ROTATE, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 90.0\nTRANSL, 1.0\n"), {1, 0, 0}, {1, 1, 0});
}

TEST(Transformation, PlacesThreePointsOnThreeOthers) {
  // the first onto the first, the others into line and plane: lengths stay
  const Affine m = motion(
      "POINT, 1, 0.0, 0.0, 0.0\nPOINT, 2, 1.0, 0.0, 0.0\nPOINT, 3, 0.0, 1.0, 0.0\n"
      "POINT, 4, 5.0, 5.0, 5.0\nPOINT, 5, 5.0, 5.0, 9.0\nPOINT, 6, 9.0, 5.0, 9.0\nPOS6P, 1, 2, 3, 4, 5, 6\n");
  expect_moves(m, {1, 2, 3}, {7, 8, 6});
  EXPECT_TRUE(keeps_lengths(m));
}

TEST(Transformation, TakesNodes) {
  const std::string nodes =
      "*NODE\n1, 1.0\n2, 1.0, 0.0, 4.0\n3, 1.0, 3.0\n11, 0.0, 0.0, 1.0\n12, 0.0, 5.0, 1.0\n13, -2.0, 0.0, "
      "1.0\n";
  expect_moves(motion("TRANSL2ND, 1, 3, 0.5\n", nodes), {1, 1, 1}, {1, 1.5, 1});
  expect_moves(motion("ROTATE3NA, 11, 12, 1, 90.0\n", nodes), {1, 7, 1},
               {2, 7, 0});  // about y through node 1
  const Affine m = motion("POS6N, 1, 2, 3, 11, 12, 13\n", nodes);
  expect_moves(m, {1, 0, 0}, {0, 0, 1});
  expect_moves(m, {1, 0, 4}, {0, 4, 1});
  expect_moves(m, {1, 3, 0}, {-3, 0, 1});
}

TEST(Transformation, TakesAMatrixForRowVectors) {
  const Affine m =
      motion("MATRIX\n0.0, 1.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0\n0.0, 0.0, 1.0, 0.0, 7.0, 8.0, 9.0, 1.0\n");
  expect_moves(m, {1, 0, 0}, {7, 9, 9});
  expect_moves(m, {0, 1, 0}, {6, 8, 9});
  expect_moves(
      motion("MATRIX\n1.0, 0.0, 0.0, 0.0, 0.0, 1.0\n0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0\nTRANSL, 1.0\n"),
      {1, 0, 0}, {2, 0, 0});
}

TEST(Transformation, TellsTheLineOfAFault) {
  const auto expect = [](const std::string& operations, const std::string& message) {
    const std::string text = evaluated(operations).text;
    EXPECT_EQ(text.substr(0, text.find('\n')), message);
  };
  const std::string a1 =
      "error: *DEFINE_TRANSFORMATION card 2 field 2 (A1, first number of the operation [-]): ";
  const std::string option =
      "error: *DEFINE_TRANSFORMATION card 2 field 1 (OPTION, operation, or M11 and M31 below MATRIX [-]): ";
  expect("TRANSL, 1.0\n$\nTWIST, 1.0\n", "t.k:6:1: " + option + "'TWIST' is no operation");
  expect("TRANSL, 1.0\n, 3.0\n", "t.k:5:1: " + option + "'' is no operation");
  expect("ROTATE, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 90.0\n",
         "t.k:4:9: " + a1 + "the axis of the rotation has no direction");
  expect("ROTATE, 1, , 30.0\n", "t.k:4:9: " + a1 + "POINT 1 is not above this line");
  expect("ROTATE, 1, 2, 90.0\n", "t.k:4:9: " + a1 + "POINT 1 is not above this line");
  expect("POINT, 1.5\n", "t.k:4:8: " + a1 + "expected the number of a point, an integer > 0, got '1.5'");
  expect("TRANSL, 1.0\nPOS6P, 1, 2, 3, 4, 5, 6\n",
         "t.k:5:1: " + option + "POS6P behind other operations is not supported");
  expect("TRANSL2ND, 1, 2, 1.0\n", "t.k:4:1: " + option + "node 1 has no coordinates");
  expect("TRANSL2ND, -1, 2, 1.0\n", "t.k:4:12: " + a1 + "expected a node id, got '-1'");
  expect("MATRIX\n1.0\n", "t.k:4:1: " + option + "the two lines of the matrix are missing");
  expect("MATRIX\n1.0\nx, 0.0, 1.0\n", "t.k:6:1: " + option + "expected a number of the matrix, got 'x'");
  expect(
      "SCALE, 1.0\nMIRROR, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0\n",
      "t.k:5:24: error: *DEFINE_TRANSFORMATION card 2 field 5 (A4, fourth number [-]): the two points of the "
      "mirror are one");
  expect("MIRROR, 1.0, 1.0, 1.0, 2.0, 1.0, 1.0, 1.0\n",
         "t.k:4:39: error: *DEFINE_TRANSFORMATION card 2 field 8 (A7, seventh number [-]): '1' (coordinate "
         "systems "
         "become left-handed) is not supported");
  expect("MATRIX\n1.0\n0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0\n",
         "t.k:4:1: " + option + "the operations press space flat");
}

TEST(Transformation, RefusesNodesThatAreMovedOtherwise) {
  DecksInMemory decks{{{"t.k",
                        "*KEYWORD\n*DEFINE_TRANSFORMATION\n7\nTRANSL2ND, 1, 2, "
                        "1.0\n*INCLUDE_TRANSFORM\na.k\n\n\n\n7\n*END\n"},
                       {"a.k", "*NODE\n1, 1.0\n2, 2.0\n"}}};
  Diagnostics diagnostics;
  Deck deck = decks.read("t.k", diagnostics);
  move_included_entries(deck, diagnostics);
  EXPECT_NE(diagnostics.text().find("node 1 is in a file that is moved otherwise than this one"),
            std::string::npos)
      << diagnostics.text();
}

TEST(HeldAxes, MoveWithTheirFile) {
  const auto moved = [](std::array<bool, 3> held, const Affine& motion) {
    const std::string reason = move_held_axes(held, motion);
    return reason.empty() ? code_of_axes(held) : -1;
  };
  const Affine quarter(rotation(Vec(0, 0, 1), 90)), thirty(rotation(Vec(0, 0, 1), 30));
  for (int code = 0; code < 8; ++code) {
    EXPECT_EQ(code_of_axes(axes_of_code(code)), code);
    EXPECT_EQ(moved(axes_of_code(code), Affine(Eigen::Translation3d(1, 2, 3))), code);
    EXPECT_EQ(moved(axes_of_code(code), Affine(Eigen::Scaling(2.0, 3.0, -1.0))), code);
  }
  const int after_quarter[] = {0, 2, 1, 3, 4, 6, 5, 7};  // x to y, y to -x
  for (int code = 0; code < 8; ++code) EXPECT_EQ(moved(axes_of_code(code), quarter), after_quarter[code]);
  const int after_thirty[] = {0, -1, -1, 3, 4, -1, -1, 7};  // z alone and the plane xy stay
  for (int code = 0; code < 8; ++code) EXPECT_EQ(moved(axes_of_code(code), thirty), after_thirty[code]);
}

}  // namespace courant
