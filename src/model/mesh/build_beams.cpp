// Beam elements.
#include <fmt/format.h>
#include <algorithm>
#include <unordered_map>

#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"
#include "model/mesh/cards_beam.hpp"
#include "model/model_builder.hpp"

namespace courant {

namespace {

using Beam = ElementBeamCard;
constexpr FieldRules beam_id{.required = true, .check = Check::positive, .width = 8};
constexpr FieldRules end_node{
    .required = true, .check = Check::positive, .width = 8, .refers = IdSpace::node};
constexpr FieldRules release_of_end{.allowed = {0, 1, 2, 3, 4, 5, 6, 7}, .width = 8};
constexpr FieldRules measure_of_beam{.check = Check::not_negative, .width = 16};

/// Lengths, areas or moments of area, as the section has it.
std::string convert_measures(Beam& card, const Conversion& conversion) {
  return card.has_thickness() && conversion.units.any()
             ? "what _THICKNESS gives has other dimensions with each formulation"
             : "";
}

const RegisterKeyword<Beam> element_beam{
    {.names = {"ELEMENT_BEAM", "ELEMENT_BEAM_THICKNESS", "ELEMENT_BEAM_ORIENTATION",
               "ELEMENT_BEAM_THICKNESS_ORIENTATION"},
     .purpose = "beams and trusses between two nodes; options add a card",
     .id_space = IdSpace::beam,
     .cards =
         {{.fields = {{"EID", &Beam::eid, "-", "element id", beam_id},
                      {"PID",
                       &Beam::pid,
                       "-",
                       "part id",
                       {.required = true, .check = Check::positive, .width = 8, .refers = IdSpace::part}},
                      {"N1", &Beam::n1, "-", "end 1", end_node},
                      {"N2", &Beam::n2, "-", "end 2", end_node},
                      {"N3",
                       &Beam::n3,
                       "-",
                       "node in the plane of the local axes r (from N1 to N2) and s",
                       {.check = Check::not_negative, .width = 8, .refers = IdSpace::node}},
                      {"RT1", &Beam::rt1, "-",
                       "1: slides along r at end 1; 2 to 7, along other axes, are refused", release_of_end},
                      {"RR1", &Beam::rr1, "-",
                       "hinge at end 1 of ELFORM 2: 1 r, 2 s, 3 t, 4 rs, 5 st, 6 tr, 7 all", release_of_end},
                      {"RT2", &Beam::rt2, "-", "the same at end 2", release_of_end},
                      {"RR2", &Beam::rr2, "-", "the same at end 2", release_of_end},
                      {"LOCAL",
                       &Beam::local,
                       "-",
                       "system of releases: 2 local; 1, global, is refused with one",
                       {.standard = 2, .allowed = {0, 1, 2}, .width = 8}}}},
          {.fields = {{"PARM1", &Beam::parm1, "-", "TS1, or A; of discrete beams VOL", measure_of_beam},
                      {"PARM2", &Beam::parm2, "-", "TS2, or ISS; of discrete beams INER", measure_of_beam},
                      {"PARM3", &Beam::parm3, "-", "TT1, or ITT; of discrete beams CID", measure_of_beam},
                      {"PARM4", &Beam::parm4, "-", "TT2, or J; of cables CA", measure_of_beam},
                      {"PARM5", &Beam::parm5, "-", "SA; of cables OFFSET", {.width = 16}}},
           .when = [](const Beam& b) { return b.has_thickness(); }},
          {.fields = {{"VX", &Beam::vx, "-", "direction in the plane of r and s instead of N3, x",
                       rules::direction},
                      {"VY", &Beam::vy, "-", "the same, y"},
                      {"VZ", &Beam::vz, "-", "the same, z"}},
           .when = [](const Beam& b) { return b.has_orientation(); }}},
     .convert = convert_measures}};

}  // namespace

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
