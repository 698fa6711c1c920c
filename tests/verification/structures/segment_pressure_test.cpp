// *LOAD_SEGMENT and _SET: pressure on rigid and elastic blocks.
#include <gtest/gtest.h>

#include "rigid/bodies/rigid.hpp"
#include "solid_decks.hpp"

using namespace courant;
using test::CellShape;
using test::do_nothing;
using test::simulation_of;
using test::SolidDeck;

namespace {

const char* const section =
    "*PART\nblock\n         1         1         1\n*SECTION_SOLID\n         1         1\n";
const char* const ramp =
    "*DEFINE_CURVE\n         1\n                 0.0                 1.0\n              1000.0               "
    "  "
    "1.0\n";

/// Nodes of a grid of 2 x 2 x 2 cells, counted from 1.
int node(int i, int j, int k) {
  return 1 + i + 3 * (j + 3 * k);
}

/// Faces of the sides of the block across `axis`, normals outwards.
std::string faces(int axis, int side, bool triangles, const std::string& begin) {
  std::string out;
  const auto at = [&](int a, int b) {
    int index[3];
    index[axis] = side, index[(axis + 1) % 3] = a, index[(axis + 2) % 3] = b;
    return node(index[0], index[1], index[2]);
  };
  const auto write = [&](int a, int b, int c, int d) {
    out += begin + (side == 2 ? fmt::format("{:10}{:10}{:10}{:10}\n", a, b, c, d)
                    : d == 0  ? fmt::format("{:10}{:10}{:10}{:10}\n", c, b, a, 0)
                              : fmt::format("{:10}{:10}{:10}{:10}\n", d, c, b, a));
  };
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) {
      const int p = at(a, b), q = at(a + 1, b), r = at(a + 1, b + 1), s = at(a, b + 1);
      if (!triangles) write(p, q, r, s);
      if (triangles) write(p, q, r, 0), write(p, r, s, 0);
    }
  return out;
}

}  // namespace

// v = p A t/m, and the work is the kinetic energy. AT: the curve begins then.
TEST(SegmentPressure, DrivesARigidBlock) {
  for (const bool triangles : {false, true})
    for (const Real at : {0.0, 0.05}) {
      SolidDeck deck;
      deck.block(Vec(0.2, 0.4, 0.6), 2, 2, 2, 1);
      deck.cards = std::string(section) + "*MAT_RIGID\n         1    1000.0     1.0E9       0.3\n" + ramp +
                   "*LOAD_SEGMENT\n" + faces(0, 2, triangles, fmt::format("         1     500.0{:10}", at));
      auto s = simulation_of(deck.text(1));
      std::string who;
      s->evaluate(who);
      sample_energy(s->world(), s->clock());
      s->world().energy.initial = s->world().energy.total();
      Real pushed = 0, before = 0;  // time
      while (s->clock().t < 0.1) {
        const Real from = s->clock().t;
        s->step(do_nothing);
        // a kick takes the half steps around the time level
        if (from >= at) pushed += 0.5 * (before + s->clock().dt);
        before = s->clock().dt;
      }
      const RigidBody& b = s->bodies()->bodies().front();
      const Real force = 500 * 0.4 * 0.6;
      EXPECT_NEAR(b.v[0], -force * pushed / 48, 1e-12);
      EXPECT_LT(Vec(0, b.v[1], b.v[2]).norm() + b.omega.norm(), 1e-12);
      sample_energy(s->world(), s->clock());
      EXPECT_LT(std::abs(s->world().energy.unexplained()), 1e-9 * b.kinetic_energy());
    }
}

// At rest under pressure p from all sides: p = -K ln(V/V0).
TEST(SegmentPressure, SqueezesAnElasticBlock) {
  for (const CellShape shape : {CellShape::hexahedron, CellShape::tetrahedra}) {
    SolidDeck deck;
    deck.cells = shape;
    deck.block(Vec(1, 1, 1), 2, 2, 2, 1);
    deck.cards = std::string(section) + "*MAT_ELASTIC\n         1    1000.0     1.0E6      0.25\n" + ramp +
                 "*DAMPING_GLOBAL\n         0      30.0\n*LOAD_SEGMENT_SET\n         1         1     2.0E4\n"
                 "*SET_SEGMENT\n         1\n";
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {0, 2}) deck.cards += faces(axis, side, shape == CellShape::tetrahedra, "");
    auto s = simulation_of(deck.text(1));
    while (s->clock().t < 0.8) s->step(do_nothing);
    const Nodes& nodes = s->world().nodes;
    const Vec edges = nodes.x.vec(26) - nodes.x.vec(0);
    const Real K = 1e6 / (3 * 0.5);
    EXPECT_NEAR(-K * std::log(edges.prod()) / 2e4, 1, 1e-4) << int(shape);
  }
}

// A square of 1 and a triangle of 1/2 beside it, in the plane z = 0: the pressure acts against their normals.
TEST(SegmentPressure, OnShellsIsThatOnTheirFaces) {
  const std::string plate =
      "*KEYWORD\n*CONTROL_TERMINATION\n1.0\n*PART\nplate\n1,1,1\n*SECTION_SHELL\n1,2\n0.1,0.1,0.1,0.1\n"
      "*MAT_ELASTIC\n1,1000.0,1.0E7,0.3\n*DEFINE_CURVE\n1\n0.0,1.0\n9.0,1.0\n*SET_SHELL_LIST\n4\n2\n"
      "*NODE\n1,0.0,0.0,0.0\n2,1.0,0.0,0.0\n3,1.0,1.0,0.0\n4,0.0,1.0,0.0\n5,2.0,0.0,0.0\n"
      "*ELEMENT_SHELL\n1,1,1,2,3,4\n2,1,2,5,3,3\n";
  const auto after = [&](const std::string& load) {
    auto s = simulation_of(plate + load + "*END\n");
    for (int k = 0; k < 20; ++k) s->step(do_nothing);
    const Nodes& nodes = s->world().nodes;
    std::vector<Real> out{s->clock().t - 0.5 * s->clock().dt_old, 0};  // of the last kick
    for (Index n = 0; n < nodes.size(); ++n) {
      out[1] += nodes.m[n] * nodes.v.vec(n)[2];
      for (int k = 0; k < 3; ++k) out.push_back(nodes.v.vec(n)[k]);
    }
    return out;
  };
  const auto faces = after("*LOAD_SEGMENT\n1,500.0,0.0,1,2,3,4\n1,-200.0,0.0,2,5,3,3\n");
  const auto shells =
      after("*LOAD_SHELL_ELEMENT_ID\n         7push\n1,1,500.0\n*LOAD_SHELL_SET\n4,1,-200.0\n");
  EXPECT_EQ(faces, shells);
  EXPECT_NEAR(shells[1], -(500 * 1 - 200 * 0.5) * shells[0], 1e-4 * 400 * shells[0]);  // the plate bends
  EXPECT_EQ(after("*LOAD_SHELL_ELEMENT\n1,1,500.0,5.0\n")[1], 0) << "before AT";
}
