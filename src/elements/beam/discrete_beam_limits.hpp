#pragma once
// Fields that *MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM and _PLASTIC_ share: preload and failure.
#include <vector>

#include "elements/beam/discrete_beam_law.hpp"

namespace courant {

struct NonlinearBeamCard : Entry {
  std::string title;
  Id mid = 0;
  Real ro = 0;
  Real for_ = 0, fos = 0, fot = 0, mor = 0, mos = 0, mot = 0;
  Real ffailr = 0, ffails = 0, ffailt = 0, mfailr = 0, mfails = 0, mfailt = 0;
  Real ufailr = 0, ufails = 0, ufailt = 0, tfailr = 0, tfails = 0, tfailt = 0;

  void put_shared(DiscreteBeamLaw& law) const {
    law.ro = ro;
    const SixOfBeam start{for_, fos, fot, mor, mos, mot};
    for (std::size_t d = 0; d < 6; ++d) law.springs[d].preload = start[d];
    law.limits.force = {ffailr, ffails, ffailt, mfailr, mfails, mfailt};
    law.limits.displacement = {ufailr, ufails, ufailt, tfailr, tfails, tfailt};
  }
};

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
