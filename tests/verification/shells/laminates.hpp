#pragma once
// Laminates for tests: decks with layers, stiffness by laminate theory (Jones 1975, chapters 2 and 4), and
// what a shell answers to strains and curvatures.
#include <cmath>
#include <Eigen/Dense>
#include <string>
#include <vector>

#include "shell_decks.hpp"
#include "solid_decks.hpp"
#include "state/reports.hpp"
#include "state/shared_fields.hpp"

namespace courant::test::laminates {

inline constexpr Real EA = 130e9, EB = 9e9, PRBA = 0.02, GAB = 4.8e9, GBC = 3.2e9, GCA = 4.8e9, RO = 1550;

struct LaminatePly {
  int mid;
  Real thickness, angle;
};
using Laminate = std::vector<LaminatePly>;

/// *MAT_002 with AOPT (0: along side 1-2), its third and fourth card.
inline std::string orthotropic(int mid, const std::string& aopt = "0.0", const std::string& a = "0.0,0.0,0.0",
                               const std::string& v = "0.0,0.0,0.0", Real beta = 0) {
  return fmt::format(
      "*MAT_ORTHOTROPIC_ELASTIC\n{},{},{},{},{},{},0.0,0.0\n{},{},{},{}\n0.0,0.0,0.0,{}\n{},0.0,0.0,0.0,{}\n",
      mid, RO, EA, EB, EB, PRBA, GAB, GBC, GCA, aopt, a, v, beta);
}

inline std::string composite_part(const Laminate& plies, bool one_a_card = false, Real shear_factor = 1) {
  std::string out =
      fmt::format("*PART_COMPOSITE{}\nlaminate\n1,2,{}\n", one_a_card ? "_LONG" : "", shear_factor);
  for (std::size_t k = 0; k < plies.size(); ++k) {
    const LaminatePly& p = plies[k];
    const bool last = one_a_card || k % 2 == 1 || k + 1 == plies.size();
    out += fmt::format("{},{},{},0{}", p.mid, p.thickness, p.angle, last ? "\n" : ",");
  }
  return out;
}

/// Stiffness of a ply of the material above in the axes of the laminate: xx, yy, 2 xy.
inline Eigen::Matrix3d turned_stiffness(Real degrees) {
  const Real c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
  const Real f = 1 / (1 - PRBA * PRBA * EA / EB);
  Eigen::Matrix3d Q, T;  // strain xx yy gamma -> aa bb gamma
  Q << f * EA, f * PRBA * EA, 0, f * PRBA * EA, f * EB, 0, 0, 0, GAB;
  T << c * c, s * s, c * s, s * s, c * c, -c * s, -2 * c * s, 2 * c * s, c * c - s * s;
  return T.transpose() * Q * T;
}

/// [A B; B D] of the laminate. [M/T2], [ML/T2], [ML2/T2]
inline Eigen::Matrix<Real, 6, 6> laminate_stiffness(const Laminate& plies) {
  Eigen::Matrix<Real, 6, 6> out = Eigen::Matrix<Real, 6, 6>::Zero();
  Real t = 0, z = 0;
  for (const LaminatePly& p : plies) t += p.thickness;
  z = -t / 2;
  for (const LaminatePly& p : plies) {
    const Real up = z + p.thickness;
    const Eigen::Matrix3d Q = turned_stiffness(p.angle);
    out.topLeftCorner<3, 3>() += p.thickness * Q;
    out.topRightCorner<3, 3>() += (up * up - z * z) / 2 * Q;
    out.bottomLeftCorner<3, 3>() += (up * up - z * z) / 2 * Q;
    out.bottomRightCorner<3, 3>() += (up * up * up - z * z * z) / 3 * Q;
    z = up;
  }
  return out;
}

/// Each ply as `count` of a part of its thickness.
inline Laminate divided(const Laminate& plies, int count) {
  Laminate out;
  for (const LaminatePly& p : plies)
    for (int k = 0; k < count; ++k) out.push_back({p.mid, p.thickness / count, p.angle});
  return out;
}

inline Real worst(const Eigen::Matrix<Real, 6, 6>& a, const Eigen::Matrix<Real, 6, 6>& b) {
  // of blocks, each against its own largest entry
  Real most = 0;
  for (const int i : {0, 3})
    for (const int j : {0, 3}) {
      const Eigen::Matrix3d difference = a.block<3, 3>(i, j) - b.block<3, 3>(i, j);
      const Real size =
          std::sqrt(b.block<3, 3>(i, i).cwiseAbs().maxCoeff() * b.block<3, 3>(j, j).cwiseAbs().maxCoeff());
      most = std::max(most, difference.cwiseAbs().maxCoeff() / size);
    }
  return most;
}

/// One square shell on [0, 1]^2 with what is in `cards`.
inline ShellDeck one_shell(const std::string& cards) {
  ShellDeck deck;
  deck.plate(1, 1, 1, 1, 1);
  deck.cards = cards;
  return deck;
}

/// What the first shell answers to each of the strains xx yy 2xy and curvatures xx yy 2xy: its resultants
/// over the strain.
inline Eigen::Matrix<Real, 6, 6> measured_stiffness(const std::string& deck) {
  constexpr Real rate = 1e-3;  // so that the shell stays what it is
  Eigen::Matrix<Real, 6, 6> out;
  std::string shown = deck;
  shown.insert(shown.rfind("*END"), "*DATABASE_BINARY_D3PLOT\n1.0\n");
  for (int mode = 0; mode < 6; ++mode) {
    auto s = simulation_of(shown);
    World& world = s->world();
    Field<Real>& w = *shared_fields::angular_velocity.find(world.nodes.fields);
    std::string who;
    s->evaluate(who);
    for (Index n = 0; n < world.nodes.size(); ++n) {
      const Vec x = world.nodes.x.vec(n);
      const Real a = rate * (mode % 3 == 0), b = rate * (mode % 3 == 1), g = rate * (mode % 3 == 2);
      const Vec slope(a * x[0] + 0.5 * g * x[1], b * x[1] + 0.5 * g * x[0], 0);
      if (mode < 3)
        world.nodes.v.set(n, slope);
      else  // D xx = z dwy/dx, D yy = -z dwx/dy
        w.set(n, Vec(-slope[1], slope[0], 0)), world.nodes.v.set(n, Vec(0, 0, 0));
    }
    s->step(do_nothing);
    const Real dt = s->clock().dt_old;
    s->evaluate(who);
    const ElementGroup& group = *world.groups[0];
    for (auto* filler : world.passes.all<FieldFiller>()) filler->fill_fields(world);
    for (int k = 0; k < 6; ++k) {
      const auto* found =
          dynamic_cast<const Field<Real>*>(group.fields.find(k < 3 ? "membrane_force" : "bending_moment"));
      out(k, mode) = found->data(k % 3)[0] / (rate * dt);
    }
  }
  return out;
}

}  // namespace courant::test::laminates
