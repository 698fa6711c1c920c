#include "contact/nodes/measures.hpp"

#include <algorithm>
#include <cmath>

#include "contact/nodes/face.hpp"
#include "surfaces/contact_thickness.hpp"

namespace courant {

ContactMeasures::ContactMeasures(const Deck& deck, const Model& model, Real tssfac, World& world,
                                 Diagnostics& diagnostics)
    : deck_(deck), model_(model), tssfac_(tssfac), world_(world), diagnostics_(diagnostics) {
  if (const ControlContact* control = deck.last<ControlContact>()) control_ = *control;
}

void ContactMeasures::take(const ContactCard& card) {
  card_ = &card;
  const ContactKind kind = kind_of(card);
  if (kind.automatic || kind.single) {
    shells_ = {.limited = kind.single && control_.ssthk == 0};
    return;
  }
  if (kind.forming) {
    shells_ = {.of_rigid = false, .of_others = true, .limited = false, .given = true};
    return;
  }
  const int which = card.thkopt == 2 ? 0 : card.thkopt == 1 ? card.shlthk : control_.shlthk;
  shells_ = {.of_rigid = which == 2, .of_others = which >= 1, .limited = false};
}

Real ContactMeasures::half_thickness(int side, Index s) const {
  const Segments& g = world_.segments;
  const auto a = g.nodes(s);
  if (g.volume[s] > 0) return 0.5 * card_->sldthk;
  const bool rigid = model_.parts[static_cast<std::size_t>(g.part[s])].rigid;
  const Real given = side == 0 ? card_->sast : card_->sbst;
  if (!(rigid ? shells_.of_rigid : shells_.of_others)) return shells_.given ? 0.5 * given : 0;
  const Real scale = side == 0 ? card_->sfsat : card_->sfsbt;
  Real t = given > 0 ? given : contact_thickness(g, s) * scale;
  const bool by_default = !(given > 0) && !(model_.parts[static_cast<std::size_t>(g.part[s])].optt > 0);
  if (shells_.limited && by_default)
    for (std::size_t e = 0; e < 4; ++e) {
      const Index n = a[e], next = a[(e + 1) % 4];
      if (n != next) t = std::min(t, 0.4 * (world_.nodes.x.vec(n) - world_.nodes.x.vec(next)).norm());
    }
  return 0.5 * t;
}

Real ContactMeasures::beam_radius(Index part, Real area) const {
  const Real optt = model_.parts[static_cast<std::size_t>(part)].optt;
  if (!(card_->sast > 0) && optt > 0) return 0.5 * optt * card_->sfsat;
  return card_->sast > 0 ? 0.5 * card_->sast : card_->sfsat * std::sqrt(area / pi);
}

Real ContactMeasures::stiffness(Index s, Real area) const {
  const Segments& g = world_.segments;
  const auto a = g.nodes(s);
  const FaceCorners x{world_.nodes.x.vec(a[0]), world_.nodes.x.vec(a[1]), world_.nodes.x.vec(a[2]),
                      world_.nodes.x.vec(a[3])};
  if (!(g.volume[s] > 0)) return g.K[s] * area / longest_diagonal(x, a[2] == a[3] ? 3 : 4);
  return (card_->sldstf > 0 ? card_->sldstf : g.K[s]) * area * area / g.volume[s];
}

NodeContactLaw ContactMeasures::law() const {
  const ContactCard& c = *card_;
  NodeContactLaw law;
  law.id = c.cid;
  law.title = c.title;
  law.slsfac = control_.slsfac, law.penopt = control_.penopt;
  law.sfs = {c.sfsa, c.sfsb};
  static_cast<FrictionLaw&>(law) = friction_of_card(deck_, model_, c, diagnostics_);
  law.vdc = c.vdc;
  law.birth = c.bt, law.death = c.dt;
  if (SensorBoard* const board = sensors_of(deck_, model_, world_, diagnostics_))
    law.gate = board->gate_of_contact(c.cid);
  law.soft = c.soft, law.sofscl = c.sofscl, law.dtstif = c.dtstif;
  law.tssfac = tssfac_;
  law.enmass = control_.enmass;
  law.with_edges = asks_for_edges(c);
  law.single = kind_of(c).single;
  return law;
}

}  // namespace courant
