#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "elements/beam/beam_cards.hpp"
#include "elements/beam/section_beam.hpp"
#include "elements/discrete_beam/cables.hpp"
#include "laws/discrete/discrete_beam_law.hpp"
#include "laws/discrete/discrete_law_cards.hpp"
#include "model/conditions/relaxation.hpp"

namespace courant {

namespace {

template <class Card>
const Card* card_with_id(const Deck& deck, Id Card::*id, Id wanted) {
  const std::vector<Card>& cards = deck.all<Card>();
  const auto found = std::find_if(cards.begin(), cards.end(), [&](const Card& c) { return c.*id == wanted; });
  return found == cards.end() ? nullptr : &*found;
}

class CableReader {
 public:
  CableReader(const Deck& deck, const Model& model, Diagnostics& diagnostics)
      : deck_(deck), model_(model), diagnostics_(diagnostics) {}

  void read(std::size_t index, std::vector<CablePart>& out) {
    const ModelPart& part = model_.parts[index];
    const auto* section = card_with_id(deck_, &SectionBeam::secid, part.secid);
    if (!section || section->used() != 6 || part.rigid) return;
    const auto* card = card_with_id(deck_, &MatCableDiscreteBeam::mid, part.mid);
    if (!card && is_discrete_beam_material(deck_, part.mid)) return;  // read elsewhere
    if (!card)
      return error(
          part.card, "MID",
          fmt::format("the beams of part {} with ELFORM 6 need a material of discrete beams with id {}; {}",
                      part.id, part.mid, deck_.found_instead(IdSpace::material, part.mid)),
          "*MAT_CABLE_DISCRETE_BEAM, *MAT_LINEAR_ELASTIC_DISCRETE_BEAM, "
          "*MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM, "
          "*MAT_NONLINEAR_PLASTIC_DISCRETE_BEAM");
    const auto law = law_of(*card);
    if (!law) return;
    warn_of_section(*section);
    CablePart cables{static_cast<Index>(index), *law};
    for (const ModelBeam& beam : model_.beams)
      if (beam.part == cables.part) add(beam, *section, *card, cables);
    out.push_back(std::move(cables));
  }

 private:
  void error(const Entry& card, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
  }

  /// Nothing, and an error, where the card does not make one.
  std::optional<CableLaw> law_of(const MatCableDiscreteBeam& card) {
    CableLaw law{.F0 = card.f0, .ro = card.ro};
    if (card.lcid != 0) {
      const auto curve = model_.curves.find(card.lcid);
      if (curve == model_.curves.end()) return std::nullopt;  // told with the references
      if (!take_curve(card, curve->second, law)) return std::nullopt;
    } else if (card.e == 0 && card.f0 == 0) {
      error(card, "E", "the cable has neither a modulus, nor a curve, nor a tension: it would carry nothing",
            "give E or LCID");
      return std::nullopt;
    } else {
      (card.e > 0 ? law.E : law.stiffness) = std::abs(card.e);
    }
    if (card.mxeps < 1e20) law.most_strain = card.mxeps;
    if (card.mxfrc < 1e20) law.most_force = card.mxfrc;
    if (card.tramp > 0) law.ramp_from = card.tstart, law.ramp = card.tramp;
    if (card.tmaxf0 > 0 || card.tramp > 0) law.held_until = std::max(card.tmaxf0, law.ramp_from + law.ramp);
    if (card.tstart > 0 && card.tramp == 0)
      deck_.warning(diagnostics_, card, "TSTART", "has no effect without TRAMP", "leave it blank");
    Diagnostics unused;
    if (law.held_until > 0 && relaxation_of(deck_, model_, false, unused).asked) {
      error(card, "TMAXF0",
            "a tension that is held or rises is not supported in a deck that is brought to rest first",
            "leave TMAXF0 and TRAMP blank: the relaxation brings F0 and its load to rest");
      return std::nullopt;
    }
    return law;
  }

  bool take_curve(const MatCableDiscreteBeam& card, const Curve& curve, CableLaw& law) {
    const std::vector<Real>& strain = curve.abscissa;
    for (std::size_t k = 1; k < strain.size(); ++k) {
      if (strain[k] > strain[k - 1]) continue;
      error(card, "LCID", fmt::format("curve {} jumps: a cable would be infinitely stiff there", card.lcid),
            "give its points increasing abscissae");
      return false;
    }
    if (strain.size() < 2) {
      error(card, "LCID", fmt::format("curve {} has one point", card.lcid), "a cable needs two or more");
      return false;
    }
    law.curve = {strain, curve.ordinate};
    return true;
  }

  void warn_of_section(const SectionBeam& s) {
    if (s.iner != 0)
      deck_.warning(
          diagnostics_, s, "INER",
          "has no effect on cables, which turn nothing: nodes that they share with shells and beams "
          "turn as without them",
          "leave it blank");
    if (s.scoor != 0 || s.cid != 0 || s.rrcon != 0 || s.srcon != 0 || s.trcon != 0)
      deck_.warning(diagnostics_, s,
                    s.scoor != 0 ? "SCOOR"
                    : s.cid != 0 ? "CID"
                                 : "RRCON",
                    "has no effect on cables, which have no axes", "leave it blank");
    if (s.rule < 0 || s.cst == 2)
      deck_.warning(diagnostics_, s, s.rule < 0 ? "QR/IRID" : "CST", "has no effect on cables",
                    "a rule of *INTEGRATION_BEAM is for ELFORM 1");
    if (s.nsm != 0)
      deck_.warning(diagnostics_, s, "NSM", "has no effect on discrete beams", "VOL and RO give their mass");
  }

  void add(const ModelBeam& beam, const SectionBeam& s, const MatCableDiscreteBeam& card, CablePart& out) {
    for (std::size_t k = 0; k < beam.released.size(); ++k)
      if (beam.released[k] != 0)
        return error(beam.card, std::array{"RT1", "RR1", "RT2", "RR2"}[k],
                     fmt::format("the ends of cable {} cannot be released", beam.id),
                     "cables transmit tension only: leave the field blank");
    const auto own = [&](std::size_t k, Real of_section) {
      return beam.measures[k] != 0 ? beam.measures[k] : of_section;
    };
    const auto x = [&](std::size_t k) { return model_.nodes[static_cast<std::size_t>(beam.node[k])].x; };
    const Real volume = own(0, s.vol), area = own(3, s.ca), offset = own(4, s.offset);
    const Real length = (x(1) - x(0)).norm(), rest = length - offset;
    const bool by_area = out.law.E > 0 || !out.law.curve.empty();
    if (by_area && !(area > 0))
      return error(s, "CA", fmt::format("cable {} has no area, which its stiffness is made of", beam.id),
                   "give CA here, or PARM4 of *ELEMENT_BEAM_THICKNESS");
    if (!(length > 0))
      return error(beam.card, "N2", fmt::format("cable {} has no length", beam.id), "move one of its nodes");
    if (!(rest > 0))
      return error(
          s, "OFFSET",
          fmt::format("cable {}: an offset of {:g} leaves no length of {:g}", beam.id, offset, length),
          "an offset < 0 is slack, > 0 a tension at the start");
    const Real mass = card.ro * (volume > 0 ? volume : area * length);
    if (!(mass > 0))
      return error(s, "VOL", fmt::format("cable {} has neither a volume nor an area: no mass", beam.id),
                   "VOL times RO is its mass");
    out.beams.push_back(&beam), out.area.push_back(area), out.rest.push_back(rest), out.mass.push_back(mass);
  }

  const Deck& deck_;
  const Model& model_;
  Diagnostics& diagnostics_;
};

}  // namespace

Real CableLaw::preload(Real t) const {
  return ramp > 0 ? F0 * std::clamp((t - ramp_from) / ramp, Real(0), Real(1)) : F0;
}

Real CableLaw::answer(Real area, Real rest, Real dL) const {
  if (curve.empty()) return (E > 0 ? E * area / rest : stiffness) * dL;
  return area * curve(dL / rest);
}

Real CableLaw::steepest(Real area, Real rest) const {
  if (curve.empty()) return E > 0 ? E * area / rest : stiffness;
  Real most = 0;
  for (std::size_t k = 0; k < curve.pieces(); ++k) most = std::max(most, curve.slope(k));
  return most * area / rest;
}

std::vector<CablePart> find_cable_parts(const Deck& deck, const Model& model, Diagnostics& diagnostics) {
  std::vector<CablePart> out;
  if (model.beams.empty()) return out;
  CableReader reader(deck, model, diagnostics);
  for (std::size_t k = 0; k < model.parts.size(); ++k)
    if (model.parts[k].has_beam) reader.read(k, out);
  return out;
}

}  // namespace courant
