#pragma once
// What ids number. An id represents one thing within its space: node 5 and part 5 have nothing to do with
// each other.
#include <cstdint>

namespace courant {

/// No id is larger: as many digits as fields of 20 columns keep exactly elsewhere, and far enough from the
/// end of its type that offsets of many nested includes may be added.
inline constexpr std::int64_t largest_id = 9'999'999'999'999'999;

enum class IdSpace : std::uint8_t {
  none,
  node,
  solid,
  shell,
  beam,
  discrete,
  mass,
  part,
  material,
  eos,
  section,
  hourglass,
  node_set,
  part_set,
  solid_set,
  shell_set,
  beam_set,
  segment_set,
  curve,  ///< curves and tables
  box,
  coordinate_system,
  vector,
  transformation,
  definition,  ///< whatever else *DEFINE_ numbers
  contact,
  boundary,  ///< prescribed motions, single-point constraints
  rigid_wall,
  joint,
  joint_stiffness,
  count
};

/// For messages: "node", "equation of state", "node set".
const char* id_word(IdSpace space);

/// Spaces too large for a note per id: the model checks nodes and elements itself.
constexpr bool is_mesh(IdSpace space) {
  return space >= IdSpace::node && space <= IdSpace::mass;
}

/// Ids that nothing refers to: they name an entry in outputs.
constexpr bool may_repeat(IdSpace space) {
  return space == IdSpace::boundary;
}

}  // namespace courant
