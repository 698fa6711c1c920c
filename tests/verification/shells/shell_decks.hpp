#pragma once
// Decks of shells that deform, written by tests.
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/real.hpp"

namespace courant::test {

struct ShellDeck {
  std::vector<Vec> nodes;
  std::string elements, cards, particles;

  /// nx x ny quadrilaterals on [0, a] x [0, b] of the plane z = 0, or twice as many triangles; `shape` moves
  /// the nodes before they are written. Returns the first node.
  std::size_t plate(Real a, Real b, int nx, int ny, int part,
                    const std::function<Vec(const Vec&)>& shape = nullptr, bool triangles = false) {
    const std::size_t first = nodes.size() + 1;
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i) {
        const Vec x(a * i / nx, b * j / ny, 0);
        nodes.push_back(shape ? shape(x) : x);
      }
    const auto add = [&](std::size_t n1, std::size_t n2, std::size_t n3, std::size_t n4) {
      elements += fmt::format("{:8}{:8}{:8}{:8}{:8}{:8}\n", ++element_, part, n1, n2, n3, n4);
    };
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const std::size_t n1 = first + static_cast<std::size_t>(i + (nx + 1) * j), n2 = n1 + 1,
                          n4 = n1 + static_cast<std::size_t>(nx) + 1, n3 = n4 + 1;
        if (!triangles) {
          add(n1, n2, n3, n4);
        } else if ((i + j) % 2 == 0) {
          add(n1, n2, n3, n3), add(n3, n4, n1, n1);
        } else {
          add(n2, n3, n4, n4), add(n4, n1, n2, n2);
        }
      }
    return first;
  }
  /// *PART, *SECTION_SHELL and what is in `material` with the part's number as id.
  void part(int id, Real thickness, const std::string& material, int points = 2, Real shear_factor = 5.0 / 6,
            int hourglass = 0) {
    cards += fmt::format(
        "*PART\nplate\n{0:10}{0:10}{0:10}         0{4:10}\n*SECTION_SHELL\n{0:10}         2{1:10.6f}{2:10}\n"
        "{3:10.3e}\n",
        id, shear_factor, points, thickness, hourglass);
    cards += material;
  }
  /// *BOUNDARY_SPC_SET on the nodes for which `wanted` holds; `axes` such as "zXY": capital letters are
  /// rotations.
  void hold(int id, const std::string& axes, const std::function<bool(const Vec&)>& wanted) {
    node_set(id, wanted);
    cards += fmt::format("*BOUNDARY_SPC_SET\n{:10}         0", id);
    for (const char axis : {'x', 'y', 'z', 'X', 'Y', 'Z'})
      cards += axes.find(axis) == std::string::npos ? "         0" : "         1";
    cards += "\n";
  }
  void node_set(int id, const std::function<bool(const Vec&)>& wanted) {
    cards += fmt::format("*SET_NODE_LIST\n{:10}\n", id);
    int column = 0;
    for (std::size_t n = 0; n < nodes.size(); ++n)
      if (wanted(nodes[n])) cards += fmt::format("{:10}{}", n + 1, ++column % 8 == 0 ? "\n" : "");
    if (column % 8 != 0) cards += "\n";
  }
  /// *INITIAL_VELOCITY_NODE
  void velocity(const std::function<Vec(const Vec&)>& of_place) {
    cards += "*INITIAL_VELOCITY_NODE\n";
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const Vec v = of_place(nodes[n]);
      if (v.squaredNorm() > 0)
        cards += fmt::format("{:10}{:10.3e}{:10.3e}{:10.3e}\n", n + 1, v[0], v[1], v[2]);
    }
  }
  std::string text(Real endtim) const {
    std::string out = fmt::format("*KEYWORD\n*CONTROL_TERMINATION\n{:10.4g}\n", endtim) + cards + "*NODE\n";
    for (std::size_t n = 0; n < nodes.size(); ++n)
      out += fmt::format("{:8}{:16.9e}{:16.9e}{:16.9e}\n", n + 1, nodes[n][0], nodes[n][1], nodes[n][2]);
    return out + "*ELEMENT_SHELL\n" + elements + particles + "*END\n";
  }

 private:
  int element_ = 0;
};

}  // namespace courant::test
