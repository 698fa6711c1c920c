// Which particles have walls near them, and which walls. Done again when particles were sorted.
#include <cmath>
#include <limits>

#include "contact/near.hpp"
#include "parallel/parallel.hpp"
#include "state/shared_fields.hpp"

namespace courant {

void Contact::refreshed(World& world, const Clock& clock, std::span<const Index> old_of_new) {
  update_facets(world, clock);
  look_further(world);
  forget_left(world, old_of_new);
  listed_ = world.particles.active;
  near_wall_ = shared_fields::near_wall.find(world.particles.fields);
  blocks_.resize(block_count(listed_));
  for_each_block(listed_, [&](Index begin, Index end) { list_block(world, clock, begin, end); });
  for (const Block& b : blocks_) count_leaks(world, b.leapt);
}

// Nobody else clears the memory of particles that are no longer active.
void Contact::forget_left(const World& world, std::span<const Index> old_of_new) {
  for (Index i = world.particles.active; i < Index(old_of_new.size()); ++i) {
    if (old_of_new[i] >= listed_) continue;
    admissible_->set(i, Vec::Zero());
    if (friction_on_)
      for (int k = 0; k < 3; ++k) friction_force_[k]->set(i, Vec::Zero());
  }
}

void Contact::list_block(World& world, const Clock& clock, Index begin, Index end) {
  Block& b = blocks_[begin / block_size];
  b.slots.clear(), b.candidate.clear(), b.side.clear();
  b.clear_touches();
  b.leapt.clear();
  const Particles& p = world.particles;
  for (Index i = begin; i < end; ++i) {
    Slot slot;
    slot.particle = i;
    slot.first = Index(b.candidate.size());
    slot.k = (*k_particle_)[i];
    if (slot.k > 0 && list_candidates(b, p.x.vec(i), slot.facet[0])) {
      slot.last = Index(b.candidate.size());
      b.side.resize(b.candidate.size());
      slot.behind = !admissible_->vec(i).isZero(0);
      learn_sides(world, clock, b, slot);
      note_planes(b, slot);
      b.slots.push_back(slot);
      if (near_wall_) (*near_wall_)[i] = 1;
      continue;
    }
    if (slot.k > 0 && leapt_over_wall(p.x.vec(i) - p.v.vec(i) * clock.dt_old, p.x.vec(i)))
      b.leapt.push_back(i);
    admissible_->set(i, Vec::Zero());
    if (friction_on_)
      for (int k = 0; k < 3; ++k) friction_force_[k]->set(i, Vec::Zero());
  }
}

// Who goes so far in one step that the wall is out of reach behind it is not pulled back: it has leaked.
bool Contact::leapt_over_wall(const Vec& from, const Vec& to) const {
  const Vec path = to - from;
  const Real length = path.norm();
  constexpr Real most_looks = 1000;
  if (!(length > reach_)) return false;
  const Real looks = std::ceil(std::min(length / reach_, most_looks));
  for (Real k = 0; k < looks; ++k)
    for (const Index s : grid_.near(from + path * ((k + 0.5) / looks))) {
      const Real before = plane_distance(walls_[s], from), after = plane_distance(walls_[s], to);
      if (is_there(s) && (before < 0) != (after < 0) &&
          is_over(facets_[s], from + path * (before / (before - after))))
        return true;
    }
  return false;
}

bool Contact::list_candidates(Block& b, const Vec& x, Index& nearest) const {
  const std::size_t before = b.candidate.size();
  Real least2 = std::numeric_limits<Real>::infinity();
  for (const Index s : grid_.near(x)) {
    const Wall& w = walls_[s];
    const Real far = reach_ + w.radius;
    if (!is_there(s)) continue;
    const Real d2 = (x - w.centre).squaredNorm();
    if (d2 > far * far || std::abs(plane_distance(w, x)) > reach_) continue;
    if (w.radius > reach_ && least_distance2(w, x) > reach_ * reach_) continue;
    b.candidate.push_back(s);
    if (d2 < least2) least2 = d2, nearest = s;
  }
  return b.candidate.size() > before;
}

// Shortcuts need to know all planes near the particle, and that it is on the same side of all facets of one.
void Contact::note_planes(const Block& b, Slot& slot) const {
  constexpr Index most = 100;  // chains of facets each a little deeper than the one before stay short
  const Index nearest = slot.facet[0];
  slot.walls = 0;
  if (!search_less_ || slot.last - slot.first > most) return;
  int planes = 0;
  for (Index c = slot.first; c < slot.last; ++c) {
    const Wall& w = walls_[b.candidate[c]];
    if (w.plane < 0) return;
    int j = 0;
    while (j < planes && walls_[slot.facet[j]].plane != w.plane) ++j;
    if (j == planes) {
      if (planes == 3) return;
      slot.facet[planes] = b.candidate[c];
      slot.side[planes++] = b.side[c];
    } else if ((slot.side[j] == b.side[c]) != (walls_[slot.facet[j]].n.dot(w.n) > 0)) {
      return;
    }
  }
  slot.walls = std::int8_t(planes);
  // The particle is most likely over this one. The order matters where there are more.
  if (planes == 1) take_facet(slot, 0, nearest);
}

// The sides are those of one step ago, so that a path that crosses a wall in the very step before this one is
// seen.
void Contact::learn_sides(const World& world, const Clock& clock, Block& b, const Slot& slot) const {
  const Index i = slot.particle;
  const Vec admissible =
      world.particles.x.vec(i) - world.particles.v.vec(i) * clock.dt_old + admissible_->vec(i);
  for (Index c = slot.first; c < slot.last; ++c) {
    const Facet& f = facets_[b.candidate[c]];
    if (!f.moves) {
      b.side[c] = std::int8_t(side_of(plane_distance(walls_[b.candidate[c]], admissible)));
      continue;
    }
    const Corners& x = before_[b.candidate[c]];
    const Vec n =
        f.corners == 4 ? Vec((x[2] - x[0]).cross(x[3] - x[1])) : Vec((x[1] - x[0]).cross(x[2] - x[0]));
    b.side[c] = std::int8_t(side_of(n.dot(admissible - x[0])));
  }
}

Index Contact::candidates() const {
  std::size_t n = 0;
  for (const Block& b : blocks_) n += b.candidate.size();
  return Index(n);
}

}  // namespace courant
