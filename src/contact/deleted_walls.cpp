// Walls whose elements are deleted are there no longer, and what they covered may be bare.
#include "contact/near.hpp"
#include "parallel/parallel.hpp"

namespace courant {

// Lists are made again where an element was deleted in this step.
void Contact::leave_deleted(World& world, const Clock& clock) {
  if (!eroded_) return;
  const auto deleted = world.counters.find("deleted_elements");
  const std::int64_t count = deleted == world.counters.end() ? 0 : deleted->second;
  if (count == eroded_count_) return;
  eroded_count_ = count;
  for_each_block(listed_, [&](Index begin, Index end) {
    Block& b = blocks_[begin / block_size];
    b.freed.clear();
    if (!asleep_) note_freed(world, clock, b);
    list_block(world, clock, begin, end);
  });
  for (const Block& b : blocks_) count_leaks(world, b.leapt);
}

// What springs of particles at deleted walls would hold now; what they go on to hold is taken off it later.
void Contact::note_freed(World& world, const Clock& clock, Block& b) {
  for (Slot& slot : b.slots) {
    const auto begin = b.candidate.begin() + slot.first, end = b.candidate.begin() + slot.last;
    if (std::all_of(begin, end, [&](Index facet) { return is_there(facet); })) continue;
    if (slot.skipped) learn_sides(world, clock, b, slot);
    Pushes pushes;
    find_pushes(world, clock, b, slot, pushes);
    const Real held = stored_in(world, slot, pushes);
    if (held > 0) b.freed.emplace_back(slot.particle, held);
  }
}

// What the springs noted above do not hold any more, now that touches are found. [ML2/T2]
Real Contact::let_go(Block& b) const {
  Real out = 0;
  for (const auto& [particle, held] : b.freed) out += held;
  for (const Touch& a : b.touches) {
    const auto before = [](const auto& one, Index particle) { return one.first < particle; };
    const auto at = std::lower_bound(b.freed.begin(), b.freed.end(), a.particle, before);
    if (at != b.freed.end() && at->first == a.particle) out -= 0.5 * a.k * a.share * a.depth;
  }
  b.freed.clear();
  return out;
}

Real Contact::stored_in(const World& world, const Slot& slot, const Pushes& pushes) const {
  Real out = 0;
  for (int j = 0; j < pushes.count; ++j) {
    const Push& p = pushes.at[j];
    const Facet& f = facets_[p.facet];
    if (p.share > 0) out += 0.5 * stiffness(slot.particle, slot.k, f.k, f, world) * p.share * p.depth;
  }
  return out;
}

}  // namespace courant
