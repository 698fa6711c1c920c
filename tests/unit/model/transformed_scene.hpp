#pragma once
// One scene, written in any units, with any ids, and moved.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>

#include "keyword/conversion.hpp"

namespace courant {

/// How a file writes what the scene means: numbers divided by `units`, ids less `offsets`, points and
/// directions before `moved` was done to them.
struct Writing {
  UnitFactors units{};
  IdOffsets offsets{};
  Affine moved = Affine::Identity();
  bool along_axes = true;  ///< with what a file that is turned by any angle cannot hold

  std::string id(IdSpace space, Id n) const { return fmt::format("{}", n - offsets.of(space)); }
  std::string number(Real value, const char* dimension) const {
    return fmt::format("{:.17g}", value / units.of(dimension));
  }
  std::string vector(const Vec& v, const char* dimension) const {
    return number(v[0], dimension) + ", " + number(v[1], dimension) + ", " + number(v[2], dimension);
  }
  std::string point(const Vec& x) const { return vector(moved.inverse() * x, "L"); }
  std::string velocity(const Vec& v) const { return vector(moved.linear().inverse() * v, "L/T"); }
  /// low x, high x, low y, ...
  std::string box(const Vec& low, const Vec& high) const {
    const Vec a = moved.inverse() * low, b = moved.inverse() * high;
    std::string out;
    for (int k = 0; k < 3; ++k)
      out +=
          (k > 0 ? ", " : "") + number(std::min(a[k], b[k]), "L") + ", " + number(std::max(a[k], b[k]), "L");
    return out;
  }
  std::array<bool, 3> before(const std::array<bool, 3>& held) const;
  std::string code(const std::array<bool, 3>& held) const;
  std::string flags(const std::array<bool, 3>& held) const;
};

/// Which axes of the file become the axes that are held in the scene.
inline std::array<bool, 3> Writing::before(const std::array<bool, 3>& held) const {
  std::array<bool, 3> out{};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t l = 0; l < 3; ++l) {
      const Vec axis = moved.linear().inverse() * Vec::Unit(static_cast<Eigen::Index>(k));
      out[l] = out[l] || (held[k] && std::abs(axis[static_cast<Eigen::Index>(l)]) > 0.5);
    }
  return out;
}

inline std::string Writing::code(const std::array<bool, 3>& held) const {
  const std::array<bool, 3> codes[] = {{false, false, false}, {true, false, false}, {false, true, false},
                                       {false, false, true},  {true, true, false},  {false, true, true},
                                       {true, false, true},   {true, true, true}};
  int out = 0;
  while (codes[out] != before(held)) ++out;
  return fmt::format("{}", out);
}

inline std::string Writing::flags(const std::array<bool, 3>& held) const {
  const std::array<bool, 3> in_file = before(held);
  return fmt::format("{:d}, {:d}, {:d}", in_file[0], in_file[1], in_file[2]);
}

inline std::string mesh(const Writing& w) {
  std::string text = "*NODE\n", particles = "*ELEMENT_SPH\n";
  for (int k = 0; k < 8; ++k) {
    const Vec x(2 + 0.1 * (k % 2), 1 + 0.1 * (k / 2 % 2), 0.3 + 0.1 * (k / 4));
    const std::array<bool, 3> held = {k == 3, false, k == 3 || k == 5};
    text += fmt::format("{}, {}, {}\n", w.id(IdSpace::node, 9001 + k), w.point(x),
                        w.along_axes ? w.code(held) : std::string(k == 6 ? "7" : "0"));
    particles += fmt::format("{}, {}, {}\n", w.id(IdSpace::node, 9001 + k), w.id(IdSpace::part, 801),
                             k < 4 ? w.number(1.01, "M") : w.number(-1e-3, "L3"));
  }
  const Vec corners[] = {{1.5, 0.5, 0}, {2.5, 0.5, 0}, {2.5, 1.5, 0.1}, {1.5, 1.5, 0.2}};
  for (int k = 0; k < 4; ++k)
    text += fmt::format("{}, {}\n", w.id(IdSpace::node, 9011 + k), w.point(corners[k]));
  text += particles;
  text += fmt::format("*ELEMENT_SHELL\n{}, {}, {}, {}, {}, {}\n", w.id(IdSpace::shell, 7001),
                      w.id(IdSpace::part, 802), w.id(IdSpace::node, 9011), w.id(IdSpace::node, 9012),
                      w.id(IdSpace::node, 9013), w.id(IdSpace::node, 9014));
  return text;
}

inline std::string parts(const Writing& w) {
  std::string text =
      fmt::format("*PART\nwater\n{}, {}, {}, {}, {}\n", w.id(IdSpace::part, 801), w.id(IdSpace::section, 601),
                  w.id(IdSpace::material, 501), w.id(IdSpace::eos, 502), w.id(IdSpace::hourglass, 602));
  text += fmt::format("*PART\nplate\n{}, {}, {}\n", w.id(IdSpace::part, 802), w.id(IdSpace::section, 603),
                      w.id(IdSpace::material, 503));
  text += fmt::format("*SECTION_SPH\n{}, , , , {}\n", w.id(IdSpace::section, 601), w.number(0.13, "L"));
  text += fmt::format("*SECTION_SHELL\n{}\n{},\n", w.id(IdSpace::section, 603), w.number(0.02, "L"));
  text += fmt::format("*MAT_NULL\n{}, {}, {}, {}\n", w.id(IdSpace::material, 501), w.number(1000, "M/L3"),
                      w.number(-1e6, "M/LT2"), w.number(1e-3, "M/LT"));
  text += fmt::format("*EOS_MURNAGHAN\n{}, 7.0, {}\n", w.id(IdSpace::eos, 502), w.number(1e6, "M/LT2"));
  text += fmt::format("*MAT_RIGID\n{}, {}, {}, 0.3\n1, {}, 7\n", w.id(IdSpace::material, 503),
                      w.number(7850, "M/L3"), w.number(2.1e11, "M/LT2"),
                      w.along_axes ? w.code({true, false, false}) : std::string("7"));
  text += fmt::format("*HOURGLASS\n{}, , , , 1.2, 0.1\n", w.id(IdSpace::hourglass, 602));
  return text;
}

inline std::string conditions(const Writing& w) {
  std::string text = fmt::format("*SET_NODE_LIST\n{}\n{}, {}\n", w.id(IdSpace::node_set, 401),
                                 w.id(IdSpace::node, 9002), w.id(IdSpace::node, 9005));
  text += fmt::format("*SET_NODE_GENERATE\n{}\n{}, {}\n", w.id(IdSpace::node_set, 402),
                      w.id(IdSpace::node, 9001), w.id(IdSpace::node, 9008));
  text += fmt::format("*SET_PART\n{}\n{}\n", w.id(IdSpace::part_set, 403), w.id(IdSpace::part, 801));
  text +=
      fmt::format("*INITIAL_VELOCITY\n{}, {}{}\n{}\n{}\n", w.id(IdSpace::node_set, 402),
                  w.id(IdSpace::node_set, 401), w.along_axes ? ", " + w.id(IdSpace::box, 301) : std::string(),
                  w.velocity({1, 2, 3}), w.velocity({-1, 0, 0.5}));
  if (w.along_axes)
    text +=
        fmt::format("*DEFINE_BOX\n{}, {}\n", w.id(IdSpace::box, 301), w.box({1.9, 0.9, 0.25}, {2.05, 3, 3}));
  const Real hand = w.moved.linear().determinant() < 0 ? -1 : 1;
  text += fmt::format("*INITIAL_VELOCITY_GENERATION\n{}, 3, {}, {}\n{}, {}\n", w.id(IdSpace::node_set, 401),
                      w.number(hand * 4, "1/T"), w.velocity({0, 0, 7}), w.point({2, 1, 0}),
                      w.vector(w.moved.linear().inverse() * Vec(1, 2, 2), "-"));
  text += fmt::format("*INITIAL_VELOCITY_NODE\n{}, {}\n", w.id(IdSpace::node, 9008), w.velocity({9, 8, 7}));
  text += fmt::format("*BOUNDARY_SPC_SET_ID\n{:10}held\n{}, 0, 1, 1, 1\n", 12, w.id(IdSpace::node_set, 401));
  if (w.along_axes)
    text += fmt::format("*BOUNDARY_SPC_NODE\n{}, 0, {}\n", w.id(IdSpace::node, 9007),
                        w.flags({false, true, true}));
  text += fmt::format(
      "*CONTACT_AUTOMATIC_NODES_TO_SURFACE_ID\n{:>10}water on plate\n{}, {}, 2, 3\n0.1, 0.1, {}, {}\n"
      "1.0, 1.0, {}\n",
      w.id(IdSpace::contact, 604), w.id(IdSpace::part_set, 403), w.id(IdSpace::part, 802),
      w.number(0.5, "T/L"), w.number(1e5, "M/LT2"), w.number(0.03, "L"));
  text += fmt::format("*DATABASE_HISTORY_SPH\n{}\n*DATABASE_HISTORY_SPH_SET\n{}\n", w.id(IdSpace::node, 9004),
                      w.id(IdSpace::node_set, 401));
  text += fmt::format("*LOAD_BODY_Z\n{}\n*DEFINE_CURVE\n{}\n{}, {}\n{}, {}\n", w.id(IdSpace::curve, 201),
                      w.id(IdSpace::curve, 201), w.number(0, "T"), w.number(9.81, "L/T2"), w.number(2, "T"),
                      w.number(4, "L/T2"));
  text += fmt::format("*DATABASE_GLSTAT\n{},\n", w.number(0.01, "T"));
  return text;
}

inline std::string scene(const Writing& w) {
  return mesh(w) + parts(w) + conditions(w);
}

}  // namespace courant
