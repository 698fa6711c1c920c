#pragma once
// *DEFINE_TRANSFORMATION: what its operations make of a point.
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "keyword/deck.hpp"
#include "model/transforms/transform_cards.hpp"

namespace courant {

/// Row k of the table below the first card: operation `option[k]` with the numbers a[0][k] to a[6][k].
struct DefineTransformationCard : DefineTransformationCardFields {
  Affine motion = Affine::Identity();  ///< all operations together, once evaluate_transformations() ran

  std::size_t rows() const;
  bool names_nodes() const;                      ///< some operation does
  Real a(std::size_t k, std::size_t row) const;  ///< A1 is k = 1
};

/// Sets `motion` of every transformation: the operations act in the order in which they are listed. POINTs
/// take part in all of them. Nodes that an operation names count where their file puts them, before any file
/// or node is moved.
void evaluate_transformations(Deck& deck, Diagnostics& diagnostics);

/// The motion of an evaluated transformation; null if there is none with this id.
const Affine* find_transformation(const Deck& deck, Id tranid);

/// What the entries of a file undergo, its own transformation first, those of the including files after it.
Affine motion_of_file(const Deck& deck, const DeckFile& file);

/// A rotation about an axis through the origin, angle in degrees; exact for multiples of 90.
Matrix rotation(const Vec& axis, Real degrees);

/// Neither stretches nor shears: distances stay what they are.
bool keeps_lengths(const Affine& motion);

/// Turns each axis into one of the axes, in one direction or the other.
bool maps_axes(const Affine& motion);

/// The axes that a code holds: 0 none, 1 x, 2 y, 3 z, 4 xy, 5 yz, 6 zx, 7 all; and the code of such axes.
std::array<bool, 3> axes_of_code(int code);
int code_of_axes(const std::array<bool, 3>& held);

// For KeywordOf::move; each returns why it cannot be done, else nothing.

/// What is held along axes must be along axes after the motion, too.
std::string move_held_axes(std::array<bool, 3>& held, const Affine& motion);
/// A stretched file leaves open whether `what` it tells in lengths (velocities, places in a system) is
/// stretched, too.
std::string refuse_stretch(const Affine& motion, std::string_view what);
/// A velocity turns with its file. Under a scaling it could mean two things.
std::string move_velocity(Real& x, Real& y, Real& z, const Affine& motion);

/// A mirror turns the normals of shells round, and so what a card counts along them.
template <auto height, typename Table>
std::string turn_height(Table& card, const Affine& motion) {
  if (motion.linear().determinant() < 0) card.*height = -(card.*height);
  return {};
}

/// Layers of shells, told from the lower face up, would lie reversed.
template <typename Table>
std::string refuse_mirror(Table&, const Affine& motion) {
  if (motion.linear().determinant() > 0) return {};
  return "the file is mirrored, and layers of shells would be reversed";
}

}  // namespace courant
