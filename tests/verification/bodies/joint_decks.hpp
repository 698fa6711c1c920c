#pragma once
// Decks of rigid bodies with given inertia and of joints between them, written by tests.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <fmt/format.h>

#include "../structures/solid_decks.hpp"
#include "rigid/bodies/rigid.hpp"
#include "rigid/joints/joints.hpp"

namespace courant::test {

struct GivenBody {
  Vec x = Vec::Zero();  ///< centre
  Real m = 1;
  Matrix J = Matrix::Identity();  ///< about the centre, global axes
  Vec v = Vec::Zero(), omega = Vec::Zero();
  int con1 = 0, con2 = 0;  ///< what holds it
};

struct JointDeck {
  std::string parts, nodes, elements, extra, joints, more;
  int bodies = 0, node = 0;

  /// A cube of no meaning around the centre represents it. Returns its part.
  int body(const GivenBody& b) {
    const int part = ++bodies, first = node + 1;
    for (int k = 0; k < 8; ++k)
      add_node(b.x + 0.01 * Vec((k & 1) != ((k & 2) >> 1) ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1));
    elements += fmt::format("{:8}{:8}{:8}{:8}{:8}{:8}{:8}{:8}{:8}{:8}\n", part, part, first, first + 1,
                            first + 2, first + 3, first + 4, first + 5, first + 6, first + 7);
    parts += fmt::format("*PART_INERTIA\nbody\n{0:10}         1{0:10}\n{1:.16g},{2:.16g},{3:.16g},{4:.16g}\n",
                         part, b.x[0], b.x[1], b.x[2], b.m);
    parts += fmt::format("{:.16g},{:.16g},{:.16g},{:.16g},{:.16g},{:.16g}\n", b.J(0, 0), b.J(0, 1), b.J(0, 2),
                         b.J(1, 1), b.J(1, 2), b.J(2, 2));
    parts += fmt::format("{:.16g},{:.16g},{:.16g},{:.16g},{:.16g},{:.16g}\n", b.v[0], b.v[1], b.v[2],
                         b.omega[0], b.omega[1], b.omega[2]);
    parts += fmt::format("*MAT_RIGID\n{:10}    1000.0     1.0E9       0.3\n{:10}{:10}{:10}\n", part,
                         b.con1 + b.con2 > 0 ? 1.0 : 0.0, b.con1, b.con2);
    return part;
  }
  int ground() { return body({.con1 = 7, .con2 = 7}); }

  /// A joint between bodies at the given places, a node of each body at each of them; universal: the second
  /// place of B is the third one.
  /// `penalty`: fields RPS and DAMP.
  void joint(const std::string& kind, int a, int b, const std::vector<Vec>& places, Real parm = 0,
             const std::string& penalty = "") {
    std::string ids;
    const bool cross = kind == "UNIVERSAL";
    for (std::size_t k = 0; k < (cross ? 2 : places.size()); ++k)
      for (const int part : {a, b}) {
        add_node(places[cross && k == 1 && part == b ? 2 : k]);
        extra += fmt::format("{:10}{:10}\n", part, node);
        ids += fmt::format("{:10}", node);
      }
    joints += fmt::format("*CONSTRAINED_JOINT_{}_ID\n{:10}joint\n{:60}{}\n", kind, ++joint_, ids, penalty);
    if (kind == "SCREW") joints += fmt::format("{:.16g}\n", parm);
  }
  /// Motors and gears: places of N1 to N4, or N6, on A and B in turn, and the second card.
  void joint_at(const std::string& kind, int a, int b, const std::vector<Vec>& places,
                const std::string& card) {
    std::string ids;
    for (std::size_t k = 0; k < places.size(); ++k) {
      add_node(places[k]);
      extra += fmt::format("{:10}{:10}\n", k % 2 == 0 ? a : b, node);
      ids += fmt::format("{:10}", node);
    }
    joints += fmt::format("*CONSTRAINED_JOINT_{}_ID\n{:10}joint\n{}\n{}\n", kind, ++joint_, ids, card);
  }
  /// A motor about, or along, an axis through a position; `type`: 0 velocities, 1 accelerations, 2
  /// displacements.
  void motor(const std::string& kind, int a, int b, const Vec& x, const Vec& axis, int curve, int type) {
    joint_at(kind + "_MOTOR", a, b, {x, x, x + axis, x + axis}, fmt::format(",{},{}", curve, type));
  }
  void curve(int id, const std::string& points) {
    more += fmt::format("*DEFINE_CURVE\n{:10}\n{}", id, points);
  }
  /// g along -z.
  void gravity(Real g) {
    more +=
        fmt::format("*LOAD_BODY_Z\n         1{:10.6f}\n*DEFINE_CURVE\n         1\n0.0,1.0\n1000.0,1.0\n", g);
  }
  std::string text(Real endtim) const {
    return fmt::format("*KEYWORD\n*CONTROL_TERMINATION\n{:.16g}\n*SECTION_SOLID\n         1         1\n",
                       endtim) +
           parts + more + joints + (extra.empty() ? "" : "*CONSTRAINED_EXTRA_NODES_NODE\n" + extra) +
           "*NODE\n" + nodes + "*ELEMENT_SOLID\n" + elements + "*END\n";
  }

 private:
  void add_node(const Vec& x) {
    nodes += fmt::format("{},{:.16g},{:.16g},{:.16g}\n", ++node, x[0], x[1], x[2]);
  }
  int joint_ = 0;
};

inline const Joints& joints_of(const Simulation& s) {
  return *const_cast<Simulation&>(s).world().passes.all<Joints>().front();
}

/// The largest |c| of all equations of all joints.
inline Real largest_gap(const Simulation& s) {
  Real gap = 0;
  const auto& bodies = s.bodies()->bodies();
  for (const Joint& joint : joints_of(s).all()) {
    std::vector<JointRow> rows;
    add_rows(joint, {bodies[joint.a].x, bodies[joint.a].q}, {bodies[joint.b].x, bodies[joint.b].q}, rows);
    for (const JointRow& row : rows) gap = std::max(gap, std::abs(row.c));
  }
  return gap;
}

inline Real kinetic(const Simulation& s) {
  return s.bodies()->kinetic_energy();
}

/// m g z of all that can move.
inline Real height_energy(const Simulation& s, Real g) {
  Real out = 0;
  for (const RigidBody& b : s.bodies()->bodies())
    if (!b.fixed()) out += b.m * g * b.x[2];
  return out;
}

}  // namespace courant::test
