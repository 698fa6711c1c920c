#pragma once
// Cards of the keywords that belong to no single physics. Field names, columns and meanings: the tables in
// cards_*.cpp.
#include <string>
#include <vector>

#include "keyword/card.hpp"
#include "model/conditions/condition_cards.hpp"
#include "model/mesh/mesh_cards.hpp"
#include "model/requests/request_cards.hpp"

namespace courant {

struct ElementShellCard : ElementShellFields {
  bool has_thickness() const { return name % 3 != 0; }
  bool has_beta() const { return name % 3 == 2 || beta != 0; }
  bool has_offset() const { return name >= 3; }
};

struct PartContactCard : PartCard {};

struct BoundarySpcNodeCard : BoundarySpcCard {};
struct BoundarySpcSetCard : BoundarySpcCard {};
/// Whether it does not hold from the start to the end of the run.
inline bool holds_for_a_time(const BoundarySpcCard& card, Real endtim) {
  return card.birth > 0 || card.death < endtim;
}

struct LoadBodyRotationCard : LoadBodyCard {};  ///< Entry::name is the axis
struct LoadBodyVectorCard : LoadBodyCard {};

struct LoadGravityPartCard : LoadGravityPartFields {
  bool of_sets() const { return name == 1; }
};

}  // namespace courant
