#pragma once
// The card that *PART and *PART_CONTACT begin with.
#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"

namespace courant {

template <class P>
CardOf<P> part_card() {
  using namespace rules;
  return {.fields = {
              {"PID", &P::pid, "-", "part id", required_id},
              {"SECID", &P::secid, "-", "section id", optional_id_of(IdSpace::section)},
              {"MID", &P::mid, "-", "material id", optional_id_of(IdSpace::material)},
              {"EOSID", &P::eosid, "-", "equation of state id", optional_id_of(IdSpace::eos)},
              {"HGID", &P::hgid, "-", "hourglass and bulk viscosity id", optional_id_of(IdSpace::hourglass)},
              {"GRAV", &P::grav, "-", "gravity preload", unsupported},
              {"ADPOPT", &P::adpopt, "-", "adaptivity, refused beside *CONTROL_ADAPTIVE", {}},
              {"TMID",
               &P::tmid,
               "-",
               "thermal material id; there are no thermal analyses",
               {.honour = Honour::ignored}}}};
}

}  // namespace courant
