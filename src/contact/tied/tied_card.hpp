#pragma once
#include "contact/cards.hpp"

namespace courant {

/// How a tied contact holds its nodes.
enum class TieForm {
  exact,   ///< nodes go with faces, their masses and forces to the corners
  spring,  ///< penalty springs (_OFFSET)
  beam,    ///< exact where that can be, else springs, of rotations, too (_BEAM_OFFSET)
};

/// *CONTACT_TIED_...; field names and units as in the keywords' table.
struct TiedCard : ContactCard {};

struct TiedKind {
  TieForm form = TieForm::exact;
  bool turns = false;  ///< shell edges, welds: rotations go with the face, too
  bool welds = false;  ///< SURFA are nodes of elements of any kind, as of beams
  bool fails = false;  ///< at the stresses FS and FD
};
TiedKind kind_of(const TiedCard& card);

}  // namespace courant
