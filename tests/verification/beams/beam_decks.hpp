#pragma once
// Decks of beams, written by tests.
#include <functional>
#include <string>

#include <fmt/format.h>

#include "base/real.hpp"

namespace courant::test::beams {

inline const std::string steel_of_beams = "*MAT_ELASTIC\n         1    7850.0   2.1E+11       0.3\n";
/// 10 mm x 10 mm: A = 1e-4, I = 8.3333e-10; ELFORM 1 and 2.
inline const std::string square_1 =
    "         1       1.0         2         0\n      0.01      0.01      0.01      0.01\n";
inline const std::string square_2 = "         2\n    1.0E-48.3333E-108.3333E-10 1.6667E-9\n";

struct BeamDeck {
  std::string nodes, elements, cards;
  int node = 0, element = 0;

  int at(const Vec& x, const char* codes = "") {
    nodes += fmt::format("{},{:.16g},{:.16g},{:.16g}{}\n", ++node, x[0], x[1], x[2], codes);
    return node;
  }
  void beam(int part, int a, int b, int third = 0) {
    elements += fmt::format("{:8}{:8}{:8}{:8}{:8}\n", ++element, part, a, b, third);
  }
  /// `section`: ELFORM and what follows.
  void part(int id, const std::string& section, const std::string& material) {
    cards +=
        fmt::format("*PART\nbeams\n{0:10}{0:10}         1\n*SECTION_BEAM\n{0:10}", id) + section + material;
  }
  /// n beams of part 1 on [0, L] of the x axis; the nodes are 1 ... n + 1.
  void line(int n, Real L, const std::function<const char*(int)>& codes) {
    for (int k = 0; k <= n; ++k) at({L * k / n, 0, 0}, codes(k));
    const int third = at({0, 1, 0}, ",7,7");
    for (int k = 0; k < n; ++k) beam(1, k + 1, k + 2, third);
  }
  void velocity(const std::function<Vec(int)>& of_node) {
    cards += "*INITIAL_VELOCITY_NODE\n";
    for (int n = 1; n <= node; ++n)
      if (const Vec v = of_node(n); v.norm() > 0)
        cards += fmt::format("{},{:.12g},{:.12g},{:.12g}\n", n, v[0], v[1], v[2]);
  }
  std::string text(Real endtim) const {
    return fmt::format("*KEYWORD\n*CONTROL_TERMINATION\n{:.16g}\n", endtim) + cards + "*NODE\n" + nodes +
           "*ELEMENT_BEAM\n" + elements + "*END\n";
  }
};

}  // namespace courant::test::beams
