#pragma once
// Thickness, stiffness and law of what a *CONTACT names.
#include "contact/cards.hpp"
#include "contact/nodes/law.hpp"
#include "keyword/deck.hpp"
#include "model/model.hpp"
#include "state/world.hpp"

namespace courant {

class ContactMeasures {
 public:
  ContactMeasures(const Deck& deck, const Model& model, Real tssfac, World& world, Diagnostics& diagnostics);
  /// From here on this card counts.
  void take(const ContactCard& card);
  /// Of a face, which belongs to SURFA (0) or SURFB (1). [L]
  Real half_thickness(int side, Index segment) const;
  /// Of a beam of that part and cross section, of SURFA. [L]
  Real beam_radius(Index part, Real area) const;
  /// Of a face, without the scales of the card. [M/T2]
  Real stiffness(Index segment, Real area) const;
  NodeContactLaw law() const;

 private:
  /// The thickness of shells by *CONTROL_CONTACT and the card.
  struct OfShells {
    bool of_rigid = true, of_others = true;
    bool limited = false;  ///< to 0.4 of the shortest edge
    bool given = false;    ///< those without a thickness have that of the card
  };

  const Deck& deck_;
  const Model& model_;
  Real tssfac_;
  World& world_;
  Diagnostics& diagnostics_;
  ControlContact control_;
  const ContactCard* card_ = nullptr;
  OfShells shells_;
};

}  // namespace courant
