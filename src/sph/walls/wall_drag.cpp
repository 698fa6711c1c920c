// Viscosity between particles and their images in walls that hold water fast: LAW 2 of *COURANT_WALL_SUPPORT
// with METHOD 1.
#include <algorithm>

#include "sph/walls/images/wall_images.hpp"

namespace courant {

int WallPaths::crossings(const Sheets& sheets, const WallPath& path, const Vec& x, const Vec& y,
                         std::array<Crossing, 4>& to) const {
  std::array<const Sheet*, 4> by{};
  int n = 0;
  for (; n < 4 && path.by[static_cast<std::size_t>(n)] >= 0; ++n)
    by[static_cast<std::size_t>(n)] = &sheets[static_cast<std::size_t>(path.by[static_cast<std::size_t>(n)])];
  std::array<Vec, 4> target;
  Vec at = put_aside(y);
  for (auto k = static_cast<std::size_t>(n); k-- > 0;) target[k] = at = by[k]->image(at);
  Vec start = put_aside(x);
  for (std::size_t k = 0; k < static_cast<std::size_t>(n); ++k) {
    const Real from = by[k]->height(start), until = by[k]->height(target[k]), ray = from - until;
    const Vec q = start + (ray != 0 ? from / ray : Real(0.5)) * (target[k] - start);
    to[k] = {face_at(*by[k], q), q};
    start = by[k]->image(start);
  }
  return n;
}

/// Of one path: u is the velocity of particle i over that of the image, the force on i is `hold` u.
void WallImages::drag(Particles& p, const WallPath& path, Block& block) const {
  const Index i = path.i, j = path.j;
  const Real* V = volumes_->current();
  const Real hold = path.weight * V[i] * V[j] * ((*viscosity_)[i] + (*viscosity_)[j]) * slope(p.h[i], path.d);
  Vec u = p.v.vec(i);
  std::array<WallPaths::Crossing, 4> met;
  const int n = at_end().crossings(sheets(i), path, p.x.vec(i), p.x.vec(j), met);
  std::array<Vec, 4> slide;
  for (std::size_t k = 0; k < static_cast<std::size_t>(n); ++k) {
    const WallSurface::Face& face = at_end().face(met[k].face);
    if (!walls_.friction[static_cast<std::size_t>(face.segment)].no_slip) return;
    slide[k] = face.slide_at(support_->belt_factors(), met[k].at - at_end().shift());
    Vec w = slide[k];
    if (face.body >= 0) w += at_end().velocity(met[k].face, met[k].at);
    u -= (k % 2 == 0 ? 2 : -2) * w;
  }
  u -= (n % 2 == 0 ? 1 : -1) * p.v.vec(j);
  const Vec force = hold * u;
  (*heat_)[i] -= 0.5 * hold * u.squaredNorm();
  if (i != j || n % 2 == 1) {  // else it is its own path back, and walls have to do with each other alone
    p.f.add(i, force);
    if (viscous_) viscous_->add(i, force);
    if (n == 0) return;  // what a wall hides is none of its force
    drag_->add(i, force);
  }
  for (std::size_t k = 0; k < static_cast<std::size_t>(n); ++k) {
    const WallDerivative on_wall{
        .face = met[k].face, .at = met[k].at, .force = (k % 2 == 0 ? -1 : 1) * force};
    if (at_end().face(on_wall.face).body >= 0) give(on_wall, 1, block);
    block.belt_power -= on_wall.force.dot(slide[k]);
  }
}

void WallImages::record(World&, const Clock& clock, EnergyLedger& ledger) {
  if (!walls_.belts.any()) return;
  Real power = 0;
  for (const Block& block : blocks_) power += block.belt_power;
  ledger.external_work += power * clock.dt_mean();
  ledger.throughput += std::abs(power) * clock.dt_mean();
}

}  // namespace courant
