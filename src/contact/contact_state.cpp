// What the contact knows from one step to the next. Shortcuts give the same bits as the full search, but on
// which side of a wall a particle is may have been learned many steps ago.
#include <algorithm>

#include "contact/contact.hpp"

namespace courant {

void Contact::keep(Archive& archive) {
  archive("acted", acted_);
  archive("damping_work", damping_work_);
  archive("friction_work", friction_work_);
  archive("soft_dt", soft_dt_);
  archive("asleep", asleep_);
  if (may_end() && (!archive.loading() || archive.has("stored"))) archive("stored", stored_);
  if (eroded_) archive("eroded_count", eroded_count_);
  archive("reach", reach_);
  if (archive.loading()) grid_.build(facets_, reach_);
  archive("travel", travel_);
  keep_walls(archive);
  keep_slots(archive);
}

/// Corners of the walls that move, as they were one step ago; the rest of a facet follows from its nodes.
void Contact::keep_walls(Archive& archive) {
  std::vector<Vec> corners;
  for (const Index s : moving_)
    for (const Vec& x : facets_[s].x) corners.push_back(x);
  archive("wall_corners", corners);
  if (!archive.loading()) return;
  if (corners.size() != 4 * moving_.size()) archive.stop("wall_corners", "belongs to other walls");
  std::size_t at = 0;
  for (const Index s : moving_)
    for (Vec& x : facets_[s].x) x = corners[at++];
}

namespace {

/// Members of objects one after the other, each in the same order: given to the archive as one list.
template <class T>
class Row {
 public:
  explicit Row(bool loading) : loading_(loading) {}
  std::vector<T> values;
  template <class Member>
  void operator()(Member& member) {
    if (loading_)
      member = static_cast<Member>(values[at_++]);
    else
      values.push_back(static_cast<T>(member));
  }
  template <class Member, std::size_t n>
  void operator()(std::array<Member, n>& members) {
    for (Member& member : members) (*this)(member);
  }

 private:
  bool loading_;
  std::size_t at_ = 0;
};

constexpr std::size_t indices_of_slot = 10, letters_of_slot = 7, reals_of_slot = 6;

}  // namespace

void Contact::keep_slots(Archive& archive) {
  const bool loading = archive.loading();
  std::vector<Index> slots, candidates, facets;
  std::vector<std::int8_t> sides;
  for (const Block& b : blocks_) {
    slots.push_back(static_cast<Index>(b.slots.size()));
    candidates.push_back(static_cast<Index>(b.candidate.size()));
    facets.insert(facets.end(), b.candidate.begin(), b.candidate.end());
    sides.insert(sides.end(), b.side.begin(), b.side.end());
  }
  archive("slots", slots);
  archive("candidates", candidates);
  archive("facets", facets);
  archive("sides", sides);
  if (loading) {
    const auto beyond = [&](Index facet) { return facet < 0 || facet >= static_cast<Index>(facets_.size()); };
    if (candidates.size() != slots.size() || sides.size() != facets.size() ||
        std::any_of(facets.begin(), facets.end(), beyond))
      archive.stop("facets", "belongs to other walls");
    std::int64_t all = 0;
    for (const Index n : slots) all += std::max<Index>(n, 0);
    if (static_cast<std::size_t>(all) * indices_of_slot != archive.count("slot_indices"))
      archive.stop("slots", "has another length");
    blocks_.assign(slots.size(), {});
    std::size_t at = 0;
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
      if (slots[k] < 0 || candidates[k] < 0 || static_cast<std::size_t>(candidates[k]) > facets.size() - at)
        archive.stop("candidates", "counts facets that are not there");
      blocks_[k].slots.resize(slots[k]);
      const std::size_t end = at + static_cast<std::size_t>(candidates[k]);
      blocks_[k].candidate.assign(facets.begin() + at, facets.begin() + end);
      blocks_[k].side.assign(sides.begin() + at, sides.begin() + end);
      at = end;
    }
  }
  Row<Index> indices(loading);
  Row<std::int8_t> letters(loading);
  Row<Real> reals(loading);
  const auto keep_all = [&] {
    for (Block& b : blocks_)
      for (Slot& s : b.slots) {
        indices(s.particle), indices(s.first), indices(s.last), indices(s.facet), indices(s.joint);
        letters(s.walls), letters(s.side), letters(s.behind), letters(s.skipped), letters(s.joints);
        reals(s.k), reals(s.room), reals(s.travel);
        for (int d = 0; d < 3; ++d) reals(s.seen[d]);
      }
  };
  if (!loading) keep_all();
  archive("slot_indices", indices.values);
  archive("slot_letters", letters.values);
  archive("slot_reals", reals.values);
  if (!loading) return;
  std::size_t n = 0;
  for (const Block& b : blocks_) n += b.slots.size();
  if (indices.values.size() != n * indices_of_slot || letters.values.size() != n * letters_of_slot ||
      reals.values.size() != n * reals_of_slot)
    archive.stop("slots", "has another length");
  keep_all();
}

}  // namespace courant
