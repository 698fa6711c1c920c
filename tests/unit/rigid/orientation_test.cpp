// *BOUNDARY_PRESCRIBED_ORIENTATION_RIGID: at each time level the body is turned as the curves say.
#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/Geometry>

#include "../app/small_scene.hpp"
#include "rigid/bodies/rigid.hpp"

namespace courant {
namespace {

Matrix about(int axis, Real angle) {
  return Eigen::AngleAxisd(angle, Vec::Unit(axis)).toRotationMatrix();
}

/// A box of 1 x 2 x 3, free in space, and curves 1 to 3 of angles.
std::string box(const std::string& more, const std::string& lco = "") {
  std::string nodes, corners;
  for (int k = 0; k < 8; ++k) {
    const int x = (k % 4 == 1 || k % 4 == 2), y = k % 4 > 1, z = k > 3;
    nodes += fmt::format("{},{},{},{}\n", k + 1, x, 2 * y, 3 * z), corners += fmt::format(",{}", k + 1);
  }
  return "*KEYWORD\n*NODE\n" + nodes + "*ELEMENT_SOLID\n1,1" + corners +
         "\n*PART\nbox\n1,1,1\n*SECTION_SOLID\n1,1\n*MAT_RIGID\n1,1000.,1.E9,0.3\n0.,0,0\n" + lco +
         "\n*CONTROL_TERMINATION\n1.\n*CONTROL_TIMESTEP\n0.,0.9,0,0.,0.,9\n*DEFINE_CURVE\n9\n0.,0.01\n1.,0."
         "01\n"
         "*DEFINE_CURVE\n1\n0.,0.\n1.,2.\n*DEFINE_CURVE\n2\n0.,0.\n1.,-1.\n*DEFINE_CURVE\n3\n0.,0.\n1.,0."
         "7\n" +
         more + "*END\n";
}
void expect_orientation(const std::string& deck, const std::function<Matrix(Real)>& wanted,
                        Real tolerance = 1e-9) {
  const auto s = test::build_deck(deck, false);
  ASSERT_TRUE(s);
  while (s->clock().t < 0.5) {
    s->step([](World&, const Clock&, const std::string&) {});
    const Matrix error = s->bodies()->bodies()[0].q.toRotationMatrix() - wanted(s->clock().t);
    ASSERT_LT(error.norm(), tolerance) << s->clock().t;
  }
}

TEST(PrescribedOrientation, ByAngles) {
  const std::string angles = "*BOUNDARY_PRESCRIBED_ORIENTATION_RIGID_ANGLES\n1,0,1\n1,2,3,";
  expect_orientation(box(angles + "123\n"),
                     [](Real t) { return Matrix(about(2, 0.7 * t) * about(1, -t) * about(0, 2 * t)); });
  expect_orientation(box(angles + "313,1,1\n"),
                     [](Real t) { return Matrix(about(2, 2 * t) * about(0, -t) * about(2, 0.7 * t)); });
}

TEST(PrescribedOrientation, ByCosinesAndParameters) {
  std::string cosines = "*BOUNDARY_PRESCRIBED_ORIENTATION_RIGID_DIRCOS\n1,0,1\n11,12,13,21,22,23,31,32\n33\n";
  std::string parameters = "*BOUNDARY_PRESCRIBED_ORIENTATION_RIGID_EULERP\n1,0,1\n13,13,41,42\n";
  // a turn by 2 t about z, in points 0.02 rad apart: straight lines between them leave 0.02^3/16 at most
  std::string curves;
  const auto curve = [&](int id, const std::function<Real(Real)>& f) {
    curves += fmt::format("*DEFINE_CURVE\n{}\n", id);
    for (int k = 0; k <= 100; ++k) curves += fmt::format("{:.2f},{:.17g}\n", 0.01 * k, f(0.01 * k));
  };
  curve(11, [](Real t) { return std::cos(2 * t); }), curve(12, [](Real t) { return -std::sin(2 * t); });
  curve(21, [](Real t) { return std::sin(2 * t); }), curve(22, [](Real t) { return std::cos(2 * t); });
  for (const int id : {13, 23, 31, 32}) curve(id, [](Real) { return 0.0; });
  curve(33, [](Real) { return 1.0; });
  curve(41, [](Real t) { return std::sin(t); }), curve(42, [](Real t) { return std::cos(t); });
  for (const std::string& card : {cosines, parameters})
    expect_orientation(
        box(card + curves), [](Real t) { return about(2, 2 * t); }, 1e-6);
}

TEST(PrescribedOrientation, StartsAndEnds) {
  const auto s = test::build_deck(
      box("*BOUNDARY_PRESCRIBED_ORIENTATION_RIGID_ANGLES\n1,0,1,0.2,0.4,1\n1,2,3,123\n"), false);
  ASSERT_TRUE(s);
  test::run(*s, 0.199);
  EXPECT_LT((s->bodies()->bodies()[0].q.toRotationMatrix() - Matrix::Identity()).norm(), 1e-12);
  test::run(*s, 0.399);
  const Real t = s->clock().t - 0.2;
  EXPECT_LT(
      (s->bodies()->bodies()[0].q.toRotationMatrix() - about(2, 0.7 * t) * about(1, -t) * about(0, 2 * t))
          .norm(),
      1e-9);
  test::run(*s, 0.6);  // it turns on freely
  const Vec L = s->bodies()->bodies()[0].L;
  test::run(*s, 0.9);
  EXPECT_LT((s->bodies()->bodies()[0].L - L).norm(), 1e-9 * L.norm());
}

TEST(PrescribedOrientation, RefusesByName) {
  const auto refusal = [](const std::string& deck) {
    Diagnostics diagnostics;
    EXPECT_FALSE(Simulation::build("deck.k", in_memory(deck), diagnostics));
    return diagnostics.text();
  };
  const std::string angles = "*BOUNDARY_PRESCRIBED_ORIENTATION_RIGID_ANGLES\n1,0,1\n1,2,3,";
  EXPECT_NE(refusal(box(angles + "122\n")).find("'122' is not supported"), std::string::npos);
  EXPECT_NE(refusal(box(angles + "123\n*BOUNDARY_PRESCRIBED_MOTION_RIGID\n1,5,0,1\n"))
                .find("another prescribed motion"),
            std::string::npos);
  EXPECT_NE(refusal(box("*BOUNDARY_PRESCRIBED_ORIENTATION_RIGID_ANGLES\n1,0,1\n4,2,3,123\n*DEFINE_"
                        "CURVE\n4\n0.,1.\n1.,1.\n"))
                .find("the orientation at the start is 1 rad"),
            std::string::npos);
}

}  // namespace
}  // namespace courant
