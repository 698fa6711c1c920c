#pragma once
// What ids number. An id is unique within its space: node 5 and part 5 are unrelated.
#include <cstdint>

namespace courant {

/// No id is larger: the number of digits that fields of 20 columns hold exactly in other programs, and far
/// enough from the limit of its type for offsets of many nested includes.
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
  definition,  ///< all other ids of *DEFINE_
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
