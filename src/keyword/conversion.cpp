#include "keyword/conversion.hpp"

#include <algorithm>

namespace courant {

namespace {

/// Stops short of the end of the type, where adding would begin again at the other one.
Id sum(Id a, Id b) {
  constexpr Id most = Id(1) << 62;
  Id out = 0;
  if (__builtin_add_overflow(a, b, &out)) out = a > 0 ? most : -most;
  return std::clamp(out, -most, most);
}

}  // namespace

const char* id_word(IdSpace space) {
  static constexpr const char* words[] = {"id",
                                          "node",
                                          "solid element",
                                          "shell",
                                          "beam",
                                          "discrete element",
                                          "mass element",
                                          "part",
                                          "material",
                                          "equation of state",
                                          "section",
                                          "hourglass",
                                          "node set",
                                          "part set",
                                          "solid set",
                                          "shell set",
                                          "beam set",
                                          "segment set",
                                          "curve",
                                          "box",
                                          "coordinate system",
                                          "vector",
                                          "transformation",
                                          "definition",
                                          "contact",
                                          "boundary condition",
                                          "rigid wall",
                                          "joint",
                                          "joint stiffness"};
  static_assert(sizeof words / sizeof *words == static_cast<std::size_t>(IdSpace::count));
  return words[static_cast<std::size_t>(space)];
}

Id IdOffsets::of(IdSpace space) const {
  switch (space) {
    case IdSpace::none:
    case IdSpace::count:
      return 0;
    case IdSpace::node:
      return node;
    case IdSpace::solid:
    case IdSpace::shell:
    case IdSpace::beam:
    case IdSpace::discrete:
    case IdSpace::mass:
      return element;
    case IdSpace::part:
    case IdSpace::rigid_wall:
      return part;
    case IdSpace::material:
    case IdSpace::eos:
      return material;
    case IdSpace::node_set:
    case IdSpace::part_set:
    case IdSpace::solid_set:
    case IdSpace::shell_set:
    case IdSpace::beam_set:
    case IdSpace::segment_set:
      return set;
    case IdSpace::curve:
      return curve;
    case IdSpace::box:
    case IdSpace::coordinate_system:
    case IdSpace::vector:
    case IdSpace::transformation:
    case IdSpace::definition:
      return definition;
    case IdSpace::section:
    case IdSpace::hourglass:
    case IdSpace::contact:
    case IdSpace::boundary:
    case IdSpace::joint:
    case IdSpace::joint_stiffness:
      return other;
  }
  return 0;
}

Id IdOffsets::shifted(IdSpace space, Id id) const {
  const Id offset = of(space);
  return id > 0 ? sum(id, offset) : id < 0 ? -sum(-id, offset) : 0;
}

bool IdOffsets::any() const {
  return node != 0 || element != 0 || part != 0 || material != 0 || set != 0 || curve != 0 ||
         definition != 0 || other != 0;
}

Real UnitFactors::of(std::string_view dimension) const {
  if (dimension == "-" || !any()) return 1;  // asked for every field of every entry
  Real above = 1, below = 1;
  bool divided = false;
  for (std::size_t i = 0; i < dimension.size(); ++i) {
    const char c = dimension[i];
    if (c == '/') divided = true;
    if (c != 'M' && c != 'L' && c != 'T') continue;
    const bool power = i + 1 < dimension.size() && dimension[i + 1] >= '2' && dimension[i + 1] <= '9';
    for (int k = power ? dimension[i + 1] - '0' : 1; k > 0; --k)
      (divided ? below : above) *= c == 'M' ? mass : c == 'L' ? length : time;
  }
  return above / below;
}

Conversion Conversion::then(const Conversion& inner) const {
  Conversion out = inner;
  out.offsets.node = sum(out.offsets.node, offsets.node);
  out.offsets.element = sum(out.offsets.element, offsets.element);
  out.offsets.part = sum(out.offsets.part, offsets.part);
  out.offsets.material = sum(out.offsets.material, offsets.material);
  out.offsets.set = sum(out.offsets.set, offsets.set);
  out.offsets.curve = sum(out.offsets.curve, offsets.curve);
  out.offsets.definition = sum(out.offsets.definition, offsets.definition);
  out.offsets.other = sum(out.offsets.other, offsets.other);
  out.units.mass *= units.mass;
  out.units.time *= units.time;
  out.units.length *= units.length;
  const auto joined = [](const std::string& a, const std::string& b) {
    return a.empty() || b.empty() ? a + b : a + "." + b;
  };
  out.prefix = joined(prefix, inner.prefix);
  out.suffix = joined(inner.suffix, suffix);
  out.transformations.insert(out.transformations.end(), transformations.begin(), transformations.end());
  return out;
}

}  // namespace courant
