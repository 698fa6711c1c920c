#pragma once
// Decks of blocks of hexahedra, with particles or without, written by tests.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "../../unit/elements/cell_shapes.hpp"
#include "app/run/simulation.hpp"
#include "model/mesh/solid_edges.hpp"

namespace courant::test {

struct SolidDeck {
  std::vector<Vec> nodes;
  std::string elements, cards;
  CellShape cells = CellShape::hexahedron;  ///< not pyramids
  /// Tetrahedra have ten nodes, hexahedra twenty: straight edges, or the middles of edges before `shape`
  /// moves them.
  bool on_edges = false, curved = false;
  std::string keyword = "*ELEMENT_SOLID";

  /// A block from the origin; `shape` moves its nodes before they are written. Returns its first node.
  std::size_t block(const Vec& size, int nx, int ny, int nz, int part,
                    const std::function<Vec(const Vec&)>& shape = nullptr) {
    const std::size_t first = nodes.size() + 1;
    std::vector<Vec> unmoved;
    for (int k = 0; k <= nz; ++k)
      for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) {
          const Vec x(size[0] * i / nx, size[1] * j / ny, size[2] * k / nz);
          nodes.push_back(shape ? shape(x) : x), unmoved.push_back(x);
        }
    std::map<std::pair<Index, Index>, std::size_t> on_edge;
    const auto middle = [&](Index a, Index b) {
      const auto [known, is_new] = on_edge.try_emplace(std::minmax({a, b}), nodes.size() + 1);
      if (!is_new) return known->second;
      const auto of = [&](const std::vector<Vec>& list, std::size_t from, Index n) {
        return list[static_cast<std::size_t>(n) - from];
      };
      const Vec straight = 0.5 * (of(nodes, 1, a) + of(nodes, 1, b));
      nodes.push_back(curved ? shape(0.5 * (of(unmoved, first, a) + of(unmoved, first, b))) : straight);
      return known->second;
    };
    const auto n = [&](int i, int j, int k) {
      return static_cast<Index>(first) + i + (nx + 1) * (j + (ny + 1) * k);
    };
    for (int k = 0; k < nz; ++k)
      for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i)
          for (const auto& c :
               split(cells, {n(i, j, k), n(i + 1, j, k), n(i + 1, j + 1, k), n(i, j + 1, k), n(i, j, k + 1),
                             n(i + 1, j, k + 1), n(i + 1, j + 1, k + 1), n(i, j + 1, k + 1)}))
            if (on_edges) {
              const bool tetrahedron = cells == CellShape::tetrahedra;
              std::vector<Index> all(c.begin(), c.end());
              if (tetrahedron) all = {c[0], c[1], c[2], c[4]};
              const std::vector<Index> corner = all;
              if (tetrahedron)
                for (const auto& [a, b] : edges_of_tetrahedron) all.push_back(middle(corner[a], corner[b]));
              else
                for (const auto& [a, b] : edges_of_hexahedron) all.push_back(middle(corner[a], corner[b]));
              elements += fmt::format("{:8}{:8}", ++element_, part);
              for (std::size_t m = 0; m < all.size(); ++m)
                elements += fmt::format("{}{:8}", m % 10 == 0 ? "\n" : "", all[m]);
              elements += "\n";
            } else {
              elements += fmt::format("{:8}{:8}{:8}{:8}{:8}{:8}{:8}{:8}{:8}{:8}\n", ++element_, part, c[0],
                                      c[1], c[2], c[3], c[4], c[5], c[6], c[7]);
            }
    return first;
  }
  /// A *SET_NODE_LIST of those nodes for which `wanted` holds.
  void node_set(int id, const std::function<bool(const Vec&)>& wanted) {
    cards += fmt::format("*SET_NODE_LIST\n{:10}\n", id);
    int column = 0;
    for (std::size_t n = 0; n < nodes.size(); ++n)
      if (wanted(nodes[n])) cards += fmt::format("{:10}{}", n + 1, ++column % 8 == 0 ? "\n" : "");
    if (column % 8 != 0) cards += "\n";
  }
  std::string text(Real endtim) const {
    std::string out = fmt::format("*KEYWORD\n*CONTROL_TERMINATION\n{:10.4g}\n", endtim) + cards + "*NODE\n";
    for (std::size_t n = 0; n < nodes.size(); ++n)
      out += fmt::format("{:8}{:16.9e}{:16.9e}{:16.9e}\n", n + 1, nodes[n][0], nodes[n][1], nodes[n][2]);
    return out + (on_edges && cells == CellShape::hexahedron ? "*ELEMENT_SOLID_H20" : keyword) + "\n" +
           elements + particles + "*END\n";
  }
  std::string particles;

 private:
  int element_ = 0;
};

/// What the elements leave for the nodes inside a block of 3 x 3 x 3 cells adds up to nothing.
inline void expect_no_force_inside(const ElementGroup& group, Index nodes, Real tolerance) {
  std::vector<Vec> force(static_cast<std::size_t>(nodes), Vec::Zero());
  for (Index e = 0; e < group.size(); ++e)
    for (int c = 0; c < group.corners(); ++c)
      for (int k = 0; k < 3; ++k)
        force[static_cast<std::size_t>(group.node.data(c)[e])][k] += group.corner_force->data(3 * c + k)[e];
  for (int k = 1; k < 3; ++k)
    for (int j = 1; j < 3; ++j)
      for (int i = 1; i < 3; ++i)
        EXPECT_LT(force[static_cast<std::size_t>((k * 4 + j) * 4 + i)].norm(), tolerance);
}

inline constexpr auto do_nothing = [](World&, const Clock&, const std::string&) {};

/// A simulation of the deck with its ledger at the start.
inline std::unique_ptr<Simulation> simulation_of(const std::string& text) {
  Diagnostics diagnostics;
  ReadOptions options;
  options.open = [text](const std::string&) { return text; };
  auto s = Simulation::build("test.k", options, diagnostics);
  EXPECT_TRUE(s != nullptr) << diagnostics.text();
  return s;
}

/// Forces of the start, and the energy from which the ledger counts.
inline void start_ledger(Simulation& s) {
  std::string who;
  s.evaluate(who);
  sample_energy(s.world(), s.clock());
  s.world().energy.initial = s.world().energy.total();
}

/// A deck as it starts, with its ledger; null, with a failure, where it is wrong.
inline std::unique_ptr<Simulation> started(const std::string& text) {
  auto s = simulation_of(text);
  if (s) start_ledger(*s);
  return s;
}

/// What the ledger cannot explain, of the energy of the start and that from outside.
inline Real energy_error(World& world, const Clock& clock) {
  sample_energy(world, clock);
  const EnergyLedger& e = world.energy;
  return std::abs(e.unexplained()) / (std::abs(e.initial) + std::abs(e.external_work));
}
inline Real energy_error(Simulation& s) {
  return energy_error(s.world(), s.clock());
}
/// Takes one more step: terms belong together at t^n alone.
inline Real energy_error_of_a_step(Simulation& s) {
  Real out = 0;
  s.step([&](World& world, const Clock& clock, const std::string&) { out = energy_error(world, clock); });
  return out;
}

}  // namespace courant::test
