#pragma once
// What the cards of materials of discrete beams share: stiffness and damping, preload, failure.
#include <string>
#include <vector>

#include "elements/beam/discrete_beam_law.hpp"
#include "keyword/common_rules.hpp"

namespace courant {

/// Every card of them.
struct DiscreteBeamCard : Entry {
  std::string title;
  Id mid = 0;
  Real ro = 0;
  Real for_ = 0, fos = 0, fot = 0, mor = 0, mos = 0, mot = 0;

  void put_shared(DiscreteBeamLaw& law) const {
    law.ro = ro;
    const SixOfBeam start{for_, fos, fot, mor, mos, mot};
    for (std::size_t d = 0; d < 6; ++d) law.springs[d].preload = start[d];
  }
};
struct LinearBeamFields {
  Real tkr = 0, tks = 0, tkt = 0, rkr = 0, rks = 0, rkt = 0;
  Real tdr = 0, tds = 0, tdt = 0, rdr = 0, rds = 0, rdt = 0;

  void put_linear(DiscreteBeamLaw& law) const {
    const SixOfBeam k{tkr, tks, tkt, rkr, rks, rkt}, c{tdr, tds, tdt, rdr, rds, rdt};
    for (std::size_t d = 0; d < 6; ++d) law.springs[d].k = k[d], law.springs[d].c = c[d];
  }
};
struct BeamFailureFields {
  Real ffailr = 0, ffails = 0, ffailt = 0, mfailr = 0, mfails = 0, mfailt = 0;
  Real ufailr = 0, ufails = 0, ufailt = 0, tfailr = 0, tfails = 0, tfailt = 0;

  void put_limits(DiscreteBeamLaw& law) const {
    law.limits.force = {ffailr, ffails, ffailt, mfailr, mfails, mfailt};
    law.limits.displacement = law.limits.negative = {ufailr, ufails, ufailt, tfailr, tfails, tfailt};
  }
};

/// MID and RO in front of six more fields.
template <class Card>
CardOf<Card> first_card_of_beams(std::vector<FieldOf<Card>> six) {
  CardOf<Card> out{
      .fields = {{"MID", &Card::mid, "-", "id that *PART refers to", rules::required_id},
                 {"RO", &Card::ro, "M/L3", "density, of VOL of *SECTION_BEAM", rules::required_positive}}};
  out.fields.insert(out.fields.end(), six.begin(), six.end());
  return out;
}
template <class Card>
CardOf<Card> stiffness_of_beams() {
  return first_card_of_beams<Card>(
      {{"TKR", &Card::tkr, "M/T2", "stiffness along r", beam_at_least_0},
       {"TKS", &Card::tks, "M/T2", "along s", beam_at_least_0},
       {"TKT", &Card::tkt, "M/T2", "along t", beam_at_least_0},
       {"RKR", &Card::rkr, "ML2/T2", "stiffness about r, moment per radian", beam_at_least_0},
       {"RKS", &Card::rks, "ML2/T2", "about s", beam_at_least_0},
       {"RKT", &Card::rkt, "ML2/T2", "about t", beam_at_least_0}});
}
template <class Card>
CardOf<Card> damping_of_beams() {
  return {.fields = {{"TDR", &Card::tdr, "M/T", "damping along r", beam_at_least_0},
                     {"TDS", &Card::tds, "M/T", "along s", beam_at_least_0},
                     {"TDT", &Card::tdt, "M/T", "along t", beam_at_least_0},
                     {"RDR", &Card::rdr, "ML2/T", "damping about r", beam_at_least_0},
                     {"RDS", &Card::rds, "ML2/T", "about s", beam_at_least_0},
                     {"RDT", &Card::rdt, "ML2/T", "about t", beam_at_least_0}}};
}
template <class Card>
CardOf<Card> preload_of_beams() {
  return {.fields = {{"FOR", &Card::for_, "ML/T2", "force along r without displacement, > 0 pulls"},
                     {"FOS", &Card::fos, "ML/T2", "along s"},
                     {"FOT", &Card::fot, "ML/T2", "along t"},
                     {"MOR", &Card::mor, "ML2/T2", "moment about r without rotation"},
                     {"MOS", &Card::mos, "ML2/T2", "about s"},
                     {"MOT", &Card::mot, "ML2/T2", "about t"}},
          .optional = true};
}
template <class Card>
CardOf<Card> failure_forces_of_beams() {
  return {.fields = {{"FFAILR", &Card::ffailr, "ML/T2",
                      "force along r that alone makes it fail; squares of shares sum up to 1; 0: none",
                      beam_at_least_0},
                     {"FFAILS", &Card::ffails, "ML/T2", "along s", beam_at_least_0},
                     {"FFAILT", &Card::ffailt, "ML/T2", "along t", beam_at_least_0},
                     {"MFAILR", &Card::mfailr, "ML2/T2", "moment about r", beam_at_least_0},
                     {"MFAILS", &Card::mfails, "ML2/T2", "about s", beam_at_least_0},
                     {"MFAILT", &Card::mfailt, "ML2/T2", "about t", beam_at_least_0}},
          .optional = true};
}
template <class Card>
CardOf<Card> failure_displacements_of_beams() {
  return {.fields = {{"UFAILR", &Card::ufailr, "L",
                      "displacement along r that alone makes it fail; squares of shares sum up to 1; 0: none",
                      beam_at_least_0},
                     {"UFAILS", &Card::ufails, "L", "along s", beam_at_least_0},
                     {"UFAILT", &Card::ufailt, "L", "along t", beam_at_least_0},
                     {"TFAILR", &Card::tfailr, "-", "angle about r", beam_at_least_0},
                     {"TFAILS", &Card::tfails, "-", "about s", beam_at_least_0},
                     {"TFAILT", &Card::tfailt, "-", "about t", beam_at_least_0}},
          .optional = true};
}

}  // namespace courant
