#pragma once
#include <string>
#include <vector>

#include <map>

#include "keyword/card.hpp"
#include "keyword/deck.hpp"
#include "model/model.hpp"

namespace courant {

/// *SECTION_SHELL; thickness at the corners [L]
struct SectionShell : Entry {
  std::string title;
  Id secid = 0;
  int elform = 0, nip = 2, irid = 0, icomp = 0, setyp = 1, edgset = 0;
  Real shrf = 1, propt = 1;
  std::vector<std::string> user{};  ///< cards of what is not supported
  bool user_defined() const { return elform >= 101 && elform <= 105; }
  bool of_plane_solids() const { return elform >= 13 && elform <= 15; }
  Real t1 = 0, t2 = 0, t3 = 0, t4 = 0, nloc = 0, marea = 0, idof = 0;
  static constexpr int angles_on_card = 8, most_angle_cards = 5;
  std::vector<Real> b1{}, b2{}, b3{}, b4{}, b5{}, b6{}, b7{}, b8{};  ///< ICOMP 1: of each card [degrees]
  int layers() const { return nip == 0 ? 2 : nip; }
  Real angle(int layer) const;  ///< ICOMP 1 [degrees]
};

/// The sections of shells, or *PART_COMPOSITE instead of one.
class ShellSections {
 public:
  ShellSections(const Deck& deck, const Model& model);
  /// Null: the part names none that is there.
  const SectionShell* of(const ModelPart& part) const;

 private:
  std::map<Id, const SectionShell*> sections_;
  std::map<Id, SectionShell> of_composite_;  ///< by part
};

/// Of each part, whether some of its shells have no layers of their own.
std::vector<bool> parts_with_own_layers(const Model& model);

/// Of each of the model's layups the first of that part with the same materials and thicknesses: they differ
/// in angles alone, and their shells are computed together.
std::vector<Index> layups_of_groups(const Model& model);

}  // namespace courant
