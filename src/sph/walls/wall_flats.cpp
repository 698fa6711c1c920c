// Images of particles beside one flat wall of a moving body only.
#include <algorithm>
#include <cmath>

#include "search/neighbours.hpp"
#include "sph/walls/images/wall_images.hpp"

namespace courant {

Index WallPaths::moving_flat_about(const Sheets& sheets, const Vec& at, Real sight) const {
  const Vec x = surface_.in_plane(at);
  const Real around = sight + 0.5 * width_;
  const Sheet* only = nullptr;
  for (const Sheet& s : sheets) {
    if (s.off(x) > around) continue;
    if (only || s.body < 0) return -1;
    only = &s;
  }
  if (!only || !is_inside(*only, only->image(x) + only->height(x) * only->n)) return -1;
  for (const Border& edge : only->edges) {
    if (distance_to(x, edge.from, edge.to) <= around) return -1;
  }
  return only->face;
}

void WallImages::find_flat(const Particles& p, Index i) {
  const Vec x = p.x.vec(i);
  // both may move by half of the skin
  const Real sight = 2 * support_->sight_until_search(p, i) - kernel_->support * p.h[i];
  flats_[static_cast<std::size_t>(i)] = at_end().moving_flat_about(sheets(i), x, sight);
}

/// The plane of a flat wall, with its normal towards the particle, for positions offset by `aside`.
struct WallImages::Flat {
  Vec n;
  Real offset, side;
  Flat(const WallSurface::Face& face, const Vec& x, const Vec& aside)
      : n(face.n), offset(face.offset - face.n.dot(aside)), side(n.dot(x) < offset ? -1 : 1) {
    n *= side, offset *= side;
  }
  Real height(const Vec& x) const { return n.dot(x) - offset; }
};

/// Whether all particles in range of particle i are on its side of the wall in the middle of the step.
bool WallImages::has_flat_to_itself(const Particles& p, Index i) const {
  const Index f = flats_[static_cast<std::size_t>(i)];
  if (f < 0) return false;
  const auto in_the_middle = [&](Index k) { return Vec(p.x.vec(k) - half_step_ * p.v.vec(k)); };
  const Vec x = in_the_middle(i);
  const Real reach2 = power<2>(kernel_->support * p.h[i]);
  const Flat flat(in_middle_->face(f), x, at_end().shift());
  const auto& js = neighbours_->of_group(i / Neighbours::lanes);
  return std::all_of(js.begin(), js.end(), [&](Index j) {
    const Vec y = in_the_middle(j);
    return flat.height(y) > 0 || (y - x).squaredNorm() > reach2;
  });
}

/// As in a sub-domain at rest, with velocities relative to the body.
void WallImages::add_flat_rate(Particles& p, Index i) const {
  const auto in_the_middle = [&](Index k) { return Vec(p.x.vec(k) - half_step_ * p.v.vec(k)); };
  const Index f = flats_[static_cast<std::size_t>(i)];
  const Vec x = in_the_middle(i), u = p.v.vec(i) - in_middle_->velocity(f, x);
  const Real h = p.h[i], reach2 = power<2>(kernel_->support * h);
  const Flat flat(in_middle_->face(f), x, at_end().shift());
  const Real height = flat.height(x);
  Real rate = 0;
  for (const Index j : neighbours_->of_group(i / Neighbours::lanes)) {
    const Vec y = i == j ? Vec(x + at_end().shift_of_itself()) : in_the_middle(j), apart = x - y;
    const Real there = std::max(flat.height(y), Real(0));  // particles behind are out of reach
    if (apart.squaredNorm() + 4 * height * there >= reach2) continue;
    const Vec d = apart + 2 * there * flat.n, other = p.v.vec(j) - in_middle_->velocity(f, y);
    const Real approach = (u - other).dot(d) + 2 * flat.n.dot(other) * flat.n.dot(d);
    rate += volumes_->current()[j] * slope(h, d) * approach;
  }
  p.drhodt[i] += p.rho[i] * rate;
}

/// The wall receives the normal reaction of each path at the point where the path meets it: half here,
/// half by the reverse path.
void WallImages::add_flat_forces(Particles& p, Index i, Block& block) const {
  const Index f = flats_[static_cast<std::size_t>(i)];
  const Vec x = p.x.vec(i);
  const Real h = p.h[i], reach2 = power<2>(kernel_->support * h);
  const Flat flat(at_end().face(f), x, at_end().shift());
  const Real height = flat.height(x);
  // particles in range in the middle of the step, as in other passes
  const auto in_the_middle = [&](Index k) { return Vec(p.x.vec(k) - half_step_ * p.v.vec(k)); };
  const Vec earlier = in_the_middle(i);
  const Flat before(in_middle_->face(f), earlier, at_end().shift());
  const Real height_before = before.height(earlier);
  const Real* V = volumes_->current();
  Vec force = Vec::Zero(), lever = Vec::Zero();
  Real diffusion = 0;
  for (const Index j : neighbours_->of_group(i / Neighbours::lanes)) {
    const Vec y = in_the_middle(j);
    const Real there_before = std::max(before.height(y), Real(0));
    if ((earlier - y).squaredNorm() + 4 * height_before * there_before >= reach2) continue;
    const Vec apart = x - p.x.vec(j);
    const Real there = std::max(flat.height(p.x.vec(j)), Real(0));
    const Vec d = apart + 2 * there * flat.n;
    const Real share = V[j] * slope(h, d);
    const Vec one = -V[i] * (pressure_[i] + pressure_[j]) * share * d;
    force += one;
    const Vec along = -(apart - flat.n.dot(apart) * flat.n);
    lever += flat.n.dot(one) * height / std::max(height + there, Real(1e-300)) * along;
    if (diffusion_)
      diffusion += share * (pressure_[j] - pressure_[i] + p.rho[i] * now_.rise(x, Vec(-apart), p.part[i]));
  }
  p.f.add(i, force), force_.add(i, force);
  if (diffusion_) (*diffusion_)[i] -= 2 * delta_ * h / p.c[i] * diffusion;
  const Vec foot = surface().in_plane(x) + at_end().shift() - height * flat.n;
  const WallPaths::Sheets& sheets = sheets_[static_cast<std::size_t>(i)];
  const auto sheet = std::find_if(sheets.begin(), sheets.end(), [f](const auto& s) {
    return std::find(s.faces.begin(), s.faces.end(), f) != s.faces.end();
  });
  give({.face = sheet == sheets.end() ? f : at_end().face_at(*sheet, foot),
        .at = foot,
        .force = -flat.n.dot(force) * flat.n,
        .lever = -flat.side * lever},
       1, block);
}

}  // namespace courant
