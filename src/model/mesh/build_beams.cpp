// Beam elements.
#include <fmt/format.h>
#include <algorithm>
#include <unordered_map>

#include "keyword/registry.hpp"
#include "model/mesh/cards_beam.hpp"
#include "model/model_builder.hpp"

namespace courant {

namespace {

const RegisterKeyword<ElementBeamCard> element_beam{element_beam_table()};

}  // namespace

/// Lengths, areas or moments of area, as the section has it.
std::string convert_measures(ElementBeamFields& card, const Conversion& conversion) {
  return static_cast<const ElementBeamCard&>(card).has_thickness() && conversion.units.any()
             ? "what _THICKNESS gives has other dimensions with each formulation"
             : "";
}

void ModelBuilder::build_beams() {
  std::unordered_map<Id, const ElementBeamCard*> first;
  for (const ElementBeamCard& card : deck_.all<ElementBeamCard>()) {
    const auto [it, is_new] = first.try_emplace(card.eid, &card);
    if (!is_new) duplicate(card, "EID", "beam", card.eid, deck_.where(*it->second));
    ModelBeam beam;
    beam.id = card.eid, beam.card = card;
    beam.part = part(card, "PID", card.pid);
    beam.node = {node(card, "N1", card.n1), node(card, "N2", card.n2)};
    if (card.n3 != 0) beam.third = node(card, "N3", card.n3);
    beam.direction = Vec(card.vx, card.vy, card.vz);
    if (card.has_thickness()) beam.measures = {card.parm1, card.parm2, card.parm3, card.parm4, card.parm5};
    beam.released = {card.rt1, card.rr1, card.rt2, card.rr2}, beam.released_globally = card.local == 1;
    if (beam.part < 0 || beam.node[0] < 0 || beam.node[1] < 0) continue;
    ModelPart& p = model_.parts[static_cast<std::size_t>(beam.part)];
    if ((p.has_sph || p.has_shell || p.has_solid) && !p.has_beam)
      error(card, "PID", fmt::format("part {} has other elements already", p.id),
            "give the beams a part of their own");
    p.has_beam = true;
    model_.beams.push_back(beam);
  }
}

/// Once nodes are where the run starts.
void ModelBuilder::check_beams() {
  std::vector<bool> particle(model_.beams.empty() ? 0 : model_.nodes.size(), false);
  if (!model_.beams.empty())
    for (const ModelSph& s : model_.sph) particle[static_cast<std::size_t>(s.node)] = true;
  for (const ModelBeam& beam : model_.beams) {
    for (const Index n : beam.node)
      if (particle[static_cast<std::size_t>(n)])
        error(beam.card, "N1",
              fmt::format("node {} of beam {} carries a particle",
                          model_.nodes[static_cast<std::size_t>(n)].id, beam.id),
              "give the beam nodes of its own");
  }
}

}  // namespace courant
