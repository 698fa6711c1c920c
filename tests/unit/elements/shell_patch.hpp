#pragma once
// A group of shells outside any world, with a linear law, for tests of its loops.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include <Eigen/Geometry>

#include "elements/shell/shell_loops.hpp"

namespace courant::test {

struct ShellPatch {
  using Numbers = std::vector<Real>;
  int corners = 4;
  std::vector<Vec> x, v, w;
  std::vector<char> inside;  ///< nodes that are not on the rim
  std::array<std::vector<Index>, 4> corner;
  std::array<Numbers, 12> force, moment;
  std::array<Numbers, 240> stress;
  std::array<Numbers, 32> resultant;
  std::array<Numbers, ShellState::most_generalised> hourglass;
  Numbers thickness, mass, internal, hourglass_energy, bulk, viscous_force;
  Real E = 2, nu = 0.25, rho = 1;
  ShellControl control;
  ShellState state;
  ShellScratch scratch;
  ShellLoops loops = quadrilateral_loops();

  std::size_t size() const { return thickness.size(); }

  /// nx x ny cells on [0, 1]^2, whose nodes are moved at random by up to `distortion` of a cell in the plane
  /// and by `warp` out of it; two triangles in each cell, or a quadrilateral.
  static ShellPatch plate(int nx, int ny, int corners, Real distortion, Real t, Real warp = 0,
                          int points = 2) {
    ShellPatch g;
    g.corners = corners;
    if (corners == 3) g.loops = triangle_loops();
    std::mt19937 random(3);
    std::uniform_real_distribution<Real> number(-1, 1);
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i) {
        const Real a = i + distortion * number(random), b = j + distortion * number(random);
        g.x.emplace_back(a / nx, b / ny, warp * number(random));
        g.inside.push_back(i > 0 && j > 0 && i < nx && j < ny);
      }
    const auto add = [&](std::array<int, 4> n) {
      for (std::size_t c = 0; c < 4; ++c) g.corner[c].push_back(n[c]);
    };
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const int a = j * (nx + 1) + i, b = a + 1, c = b + nx + 1, d = a + nx + 1;
        if (corners == 4) add({a, b, c, d});
        if (corners == 3) add({a, b, c, c}), add({c, d, a, a});
      }
    const std::size_t n = g.corner[0].size();
    g.v.assign(g.x.size(), Vec::Zero()), g.w = g.v;
    g.thickness.assign(n, t);
    for (auto* a : {&g.internal, &g.hourglass_energy, &g.bulk, &g.viscous_force}) a->assign(n, 0);
    for (auto& a : g.force) a.assign(n, 0);
    for (auto& a : g.moment) a.assign(n, 0);
    for (auto& a : g.stress) a.assign(n, 0);
    for (auto& a : g.resultant) a.assign(n, 0);
    for (auto& a : g.hourglass) a.assign(n, 0);
    for (std::size_t e = 0; e < n; ++e) g.mass.push_back(g.rho * t * g.area(e));
    constexpr Real gauss = 0.57735026918962576;
    g.state.points = points;
    if (points == 1) g.state.zeta[0] = 0, g.state.share[0] = 1;
    if (points == 2)
      g.state.zeta[0] = -gauss, g.state.zeta[1] = gauss, g.state.share[0] = g.state.share[1] = 0.5;
    g.control.E = g.E, g.control.G = g.E / (2 * (1 + g.nu)),
    g.control.plate_modulus = g.E / (1 - g.nu * g.nu);
    return g;
  }
  /// 2 x 2 points in the plane instead of one.
  void make_full(Real drilling = 0) {
    const int layers = state.points;
    loops = full_quadrilateral_loops(), control.drilling = drilling;
    state.points = 4 * layers;
    for (int p = state.points - 1; p >= 0; --p)
      state.zeta[p] = state.zeta[p % layers], state.share[p] = state.share[p % layers];
    for (int p = 0; p < state.points; ++p) state.share[p] /= 4;
  }
  /// One point that respects the warp of the element.
  void make_warped(Real drilling = 0) {
    loops = warped_quadrilateral_loops(), control.drilling = drilling, control.warps = true;
  }
  Vec at(std::size_t e, int c) const { return x[corner[c][e]]; }
  Vec normal(std::size_t e) const {
    const int last = corners - 1;
    return (at(e, 2) - at(e, 0)).cross(at(e, last) - at(e, 1)) * (corners == 4 ? 1 : -1);
  }
  Real area(std::size_t e) const {
    return corners == 4 ? 0.5 * normal(e).norm()
                        : 0.5 * (at(e, 1) - at(e, 0)).cross(at(e, 2) - at(e, 0)).norm();
  }
  /// The axes of an element as columns.
  Matrix axes(std::size_t e) const {
    const Vec n = corners == 4 ? (at(e, 2) - at(e, 0)).cross(at(e, 3) - at(e, 1)).normalized()
                               : (at(e, 1) - at(e, 0)).cross(at(e, 2) - at(e, 0)).normalized();
    const Vec side = at(e, 1) - at(e, 0), e1 = (side - side.dot(n) * n).normalized();
    Matrix out;
    out << e1, n.cross(e1), n;
    return out;
  }
  /// Everything turned.
  void turn(const Matrix& R) {
    for (auto* a : {&x, &v, &w})
      for (Vec& y : *a) y = R * y;
  }

  /// A step that led to x with v and w; `look(begin, count)` sees the scratch of each block.
  ShellLoops::StableStep advance(
      Real dt, const std::function<void(Index, Index)>& look = [](Index, Index) {}) {
    std::array<Numbers, 3> px, pv, pw;
    ShellMesh mesh{};
    for (int k = 0; k < 3; ++k) {
      for (std::size_t n = 0; n < x.size(); ++n)
        px[k].push_back(x[n][k]), pv[k].push_back(v[n][k]), pw[k].push_back(w[n][k]);
      mesh.x[k] = px[k].data(), mesh.v[k] = pv[k].data(), mesh.w[k] = pw[k].data();
    }
    for (int c = 0; c < corners; ++c) mesh.corner[c] = corner[c].data();
    for (int k = 0; k < 240; ++k) state.stress[k] = stress[k].data();
    for (std::size_t k = 0; k < hourglass.size(); ++k) state.hourglass[k] = hourglass[k].data();
    state.thickness = thickness.data(), state.mass = mass.data();
    state.internal_energy = internal.data(), state.hourglass_energy = hourglass_energy.data();
    state.bulk_viscosity_energy = bulk.data(), state.viscous_force = viscous_force.data();
    ShellLoops::StableStep least{1e300, 0};
    for (Index begin = 0; begin < static_cast<Index>(size()); begin += block_size) {
      const ShellLoops::Block block{begin, std::min<Index>(block_size, static_cast<Index>(size()) - begin),
                                    dt};
      loops.strain(block, control, mesh, state, scratch);
      std::fill(scratch.thickening, scratch.thickening + block.count, 0);
      for (int p = 0; p < state.points; ++p) {
        loops.at_point(block, p, state, scratch);
        law(block, p);
      }
      const ShellLoops::StableStep found = loops.forces(block, control, state, scratch);
      const auto keep = [&](const auto& from, auto& to) {
        for (std::size_t k = 0; k < to.size(); ++k)
          std::copy(from[k], from[k] + block.count, to[k].begin() + begin);
      };
      keep(scratch.corner_force, force), keep(scratch.corner_moment, moment);
      keep(scratch.resultant, resultant);
      if (found.step < least.step) least = found;
      look(begin, block.count);
    }
    return least;
  }

  struct Loads {
    std::vector<Vec> force, moment;
  };
  Loads on_nodes() const {
    Loads out{std::vector<Vec>(x.size(), Vec::Zero()), std::vector<Vec>(x.size(), Vec::Zero())};
    for (std::size_t e = 0; e < size(); ++e)
      for (int c = 0; c < corners; ++c)
        for (int k = 0; k < 3; ++k) {
          out.force[corner[c][e]][k] += force[3 * c + k][e];
          out.moment[corner[c][e]][k] += moment[3 * c + k][e];
        }
    return out;
  }

 private:
  void law(const ShellLoops::Block& block, int p) {
    const Real a = E / (1 - nu * nu) * block.dt, G2 = E / (1 + nu) * block.dt;
    for (Index i = 0; i < block.count; ++i) {
      const auto rate = [&](int k) { return scratch.rate[k][i]; };
      const auto s = [&](int k) -> Real& { return stress[6 * p + k][block.begin + i]; };
      s(0) += a * (rate(0) + nu * rate(1)), s(1) += a * (rate(1) + nu * rate(0));
      for (int k = 3; k < 6; ++k) s(k) += G2 * rate(k);
      scratch.thickening[i] -= state.share[p] * nu / (1 - nu) * (rate(0) + rate(1));
    }
  }
};

}  // namespace courant::test
