#pragma once
// A group of hexahedra outside any world, with a linear law, for tests of its loops.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "cell_shapes.hpp"
#include "elements/solid/solid_loops.hpp"

namespace courant::test {

struct Hexahedra {
  using Numbers = std::vector<Real>;
  static constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};

  std::vector<Vec> x, v, reference;
  std::vector<char> inside;  ///< nodes that are not on the surface
  std::array<std::vector<Index>, 8> corner;
  std::array<Numbers, 6> stress;
  std::array<Numbers, 24> corner_force;
  std::array<Numbers, 12> hourglass_force;
  Numbers V0, rho0, internal_energy, hourglass_energy, bulk_viscosity_energy, viscous_pressure, limit;
  Real lambda = 1, shear = 1;
  SolidControl control;
  SolidScratch scratch;
  OnePointLoops loops = hexahedron_loops();

  std::size_t size() const { return V0.size(); }
  static Vec sign(int c) {
    const int x = (c % 4 == 1 || c % 4 == 2), y = c % 4 >= 2, z = c >= 4;
    return {2.0 * x - 1, 2.0 * y - 1, 2.0 * z - 1};
  }

  /// A brick of cells whose nodes are moved at random by up to `distortion` of a cell.
  static Hexahedra brick(std::array<int, 3> cells, Vec sides, Real distortion) {
    Hexahedra g;
    std::mt19937 random(1);
    std::uniform_real_distribution<Real> number(-distortion, distortion);
    const auto node = [&](int i, int j, int k) { return (k * (cells[1] + 1) + j) * (cells[0] + 1) + i; };
    for (int k = 0; k <= cells[2]; ++k)
      for (int j = 0; j <= cells[1]; ++j)
        for (int i = 0; i <= cells[0]; ++i) {
          const Vec shifted(i + number(random), j + number(random), k + number(random));
          g.x.push_back(shifted.cwiseProduct(sides).cwiseQuotient(Vec(cells[0], cells[1], cells[2])));
          g.inside.push_back(i > 0 && j > 0 && k > 0 && i < cells[0] && j < cells[1] && k < cells[2]);
        }
    for (int k = 0; k < cells[2]; ++k)
      for (int j = 0; j < cells[1]; ++j)
        for (int i = 0; i < cells[0]; ++i)
          for (int c = 0; c < 8; ++c) {
            const Vec s = sign(c);
            g.corner[c].push_back(node(i + (s[0] > 0), j + (s[1] > 0), k + (s[2] > 0)));
          }
    if (cells == std::array<int, 3>{1, 1, 1}) g.order_corners();
    g.start();
    return g;
  }
  void start() {
    reference = x;
    v.assign(x.size(), Vec::Zero());
    const std::size_t n = corner[0].size();
    for (auto* a : {&V0, &rho0}) a->assign(n, 1);
    for (auto* a : {&internal_energy, &hourglass_energy, &bulk_viscosity_energy, &viscous_pressure, &limit})
      a->assign(n, 0);
    for (auto& a : stress) a.assign(n, 0);
    for (auto& a : corner_force) a.assign(n, 0);
    for (auto& a : hourglass_force) a.assign(n, 0);
    // the reference volumes come from the loops themselves: V/V0 with V0 = 1
    visit(0, [&](Index begin, Index count) {
      for (Index i = 0; i < count; ++i) V0[begin + i] = scratch.relative_volume[i];
    });
  }

  void split_cells(CellShape shape) {
    const auto whole = corner;
    for (auto& c : corner) c.clear();
    for (std::size_t e = 0; e < whole[0].size(); ++e) {
      std::array<Index, 8> n;
      Vec middle = Vec::Zero();
      for (std::size_t c = 0; c < 8; ++c) n[c] = whole[c][e], middle += 0.125 * x[n[c]];
      const Index at = static_cast<Index>(x.size());
      if (shape == CellShape::pyramids) x.push_back(middle), inside.push_back(1);
      for (const auto& cell : split(shape, n, at))
        for (std::size_t c = 0; c < 8; ++c) corner[c].push_back(cell[c]);
    }
    start();
  }
  /// Nodes of a single element in the order of its corners.
  void order_corners() {
    std::vector<Vec> sorted;
    for (int c = 0; c < 8; ++c) sorted.push_back(x[corner[c][0]]), corner[c][0] = c;
    x = reference = sorted;
  }

  /// A step that led to x with v; `body(begin, count)` looks at the scratch of each block.
  template <class Body>
  StableStep visit(Real dt, const Body& body) {
    std::array<Numbers, 3> px, pv;
    for (std::size_t n = 0; n < x.size(); ++n)
      for (int d = 0; d < 3; ++d) px[d].push_back(x[n][d]), pv[d].push_back(v[n][d]);
    SolidMesh mesh;
    for (int d = 0; d < 3; ++d) mesh.x[d] = px[d].data(), mesh.v[d] = pv[d].data();
    for (int c = 0; c < 8; ++c) mesh.corner[c] = corner[c].data();
    SolidState state{};
    for (int k = 0; k < 6; ++k) state.stress[k] = stress[k].data();
    for (int k = 0; k < 24; ++k) state.corner_force[k] = corner_force[k].data();
    for (int k = 0; k < 12; ++k) state.hourglass_force[k] = hourglass_force[k].data();
    state.V0 = V0.data(), state.rho0 = rho0.data(), state.internal_energy = internal_energy.data();
    state.hourglass_energy = hourglass_energy.data();
    state.bulk_viscosity_energy = bulk_viscosity_energy.data();
    state.viscous_pressure = viscous_pressure.data();
    StableStep all{};
    const Index n = static_cast<Index>(size());
    for (Index begin = 0; begin < n; begin += block_size) {
      const ElementBlock block{begin, std::min(block_size, n - begin), dt};
      loops.strain(block, mesh, control, state, scratch);
      law(block);
      loops.work(block, state, scratch);
      const auto found = loops.forces(block, control, state, scratch);
      const auto less = [&](Real a, Real b) { return begin == 0 || (!(a >= b) && b == b); };
      if (less(found.step, all.step)) all.step = found.step, all.shortest = found.shortest;
      if (less(found.least_volume, all.least_volume))
        all.least_volume = found.least_volume, all.smallest = found.smallest;
      std::copy(scratch.step_limit, scratch.step_limit + block.count, limit.begin() + begin);
      body(begin, block.count);
    }
    return all;
  }
  template <class Body>
  void each_block(Real dt, const Body& body) {
    visit(dt, body);
  }
  StableStep advance(Real dt) {
    return visit(dt, [](Index, Index) {});
  }

  void law(const ElementBlock& block) {
    for (Index i = 0; i < block.count; ++i) {
      const auto& d = scratch.rate;
      const Real volumetric = lambda * block.dt * (d[0][i] + d[1][i] + d[2][i]);
      for (int k = 0; k < 6; ++k)
        stress[k][block.begin + i] += 2 * shear * block.dt * d[k][i] + (k < 3 ? volumetric : 0);
      const Real rho = rho0[block.begin + i] * (1 + scratch.compression[i]);
      scratch.sound_speed[i] = std::sqrt((lambda + 2 * shear) / rho);
    }
  }

  std::vector<Vec> nodal_forces() const {
    std::vector<Vec> f(x.size(), Vec::Zero());
    for (std::size_t e = 0; e < size(); ++e)
      for (int c = 0; c < 8; ++c)
        for (int k = 0; k < 3; ++k) f[corner[c][e]][k] += corner_force[3 * c + k][e];
    return f;
  }
  Real total_energy() const {
    Real sum = 0;
    for (const Numbers* a : {&internal_energy, &hourglass_energy, &bulk_viscosity_energy})
      for (const Real e : *a) sum += e;
    return sum;
  }
};

}  // namespace courant::test
