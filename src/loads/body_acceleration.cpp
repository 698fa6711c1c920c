#include "loads/body_acceleration.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "model/cards.hpp"

namespace courant {

namespace {

bool acts_on(const BodyLoad& load, Index part) {
  return load.parts.empty() || std::binary_search(load.parts.begin(), load.parts.end(), part);
}

/// From the axis to x.
Vec from_axis(const BodyLoad& load, const Vec& x) {
  const Vec r = x - load.centre;
  return r - r.dot(load.direction) * load.direction;
}

}  // namespace

bool BodyAcceleration::At::acts(const Term& term, Index part) {
  return acts_on(*term.load, part);
}

// -omega x (omega x r) = omega^2 times the distance from the axis
Vec BodyAcceleration::At::operator()(const Vec& x, Index part) const {
  Vec a = everywhere_;
  for (const Term& term : terms_)
    if (acts(term, part)) a += term.a + term.omega2 * from_axis(*term.load, x);
  return a;
}

Real BodyAcceleration::At::potential(const Vec& x, Index part) const {
  Real sum = -everywhere_.dot(x);
  for (const Term& term : terms_)
    if (acts(term, part)) sum -= term.a.dot(x) + 0.5 * term.omega2 * from_axis(*term.load, x).squaredNorm();
  return sum;
}

Real BodyAcceleration::At::rise(const Vec& x, const Vec& step, Index part) const {
  Real sum = -everywhere_.dot(step);
  for (const Term& term : terms_)
    if (acts(term, part)) sum -= (term.a + term.omega2 * from_axis(*term.load, x + 0.5 * step)).dot(step);
  return sum;
}

bool BodyAcceleration::At::zero() const {
  return everywhere_.isZero(0) && std::all_of(terms_.begin(), terms_.end(), [](const Term& term) {
           return term.a.isZero(0) && term.omega2 == 0;
         });
}

BodyAcceleration::BodyAcceleration(std::vector<BodyLoad> loads)
    : loads_(std::make_shared<const std::vector<BodyLoad>>(std::move(loads))) {
  for (const BodyLoad& load : *loads_)
    if (load.kind != BodyLoad::Kind::translation || !load.parts.empty()) uniform_ = false;
}

BodyAcceleration BodyAcceleration::on(std::span<const Index> parts) const {
  if (parts.empty()) return *this;
  std::vector<BodyLoad> seen;
  for (BodyLoad load : *loads_) {
    const auto count = std::count_if(parts.begin(), parts.end(), [&](Index p) { return acts_on(load, p); });
    if (count == 0) continue;
    if (count == std::ssize(parts)) load.parts.clear();
    seen.push_back(std::move(load));
  }
  BodyAcceleration out(std::move(seen));
  out.normals_ = normals_;
  return out;
}

bool BodyAcceleration::by_parts() const {
  return std::any_of(loads_->begin(), loads_->end(),
                     [](const BodyLoad& load) { return !load.parts.empty(); });
}

BodyAcceleration BodyAcceleration::without(const Vec& normal) const {
  BodyAcceleration out = *this;
  out.normals_.push_back(normal);
  return out;
}

BodyAcceleration::At BodyAcceleration::at(Real t) const {
  At now;
  now.loads_ = loads_;
  const auto flatten = [&](Vec& a) {
    for (const Vec& n : normals_) a = Vec(a - a.dot(n) * n);
  };
  for (const BodyLoad& load : *loads_) {
    const Real value = load.sf * load.curve(t);
    // the base accelerates, bodies feel the opposite
    if (load.kind == BodyLoad::Kind::rotation)
      now.terms_.push_back({.load = &load, .omega2 = value * value});
    else if (load.parts.empty())
      now.everywhere_ -= value * load.direction;
    else
      now.terms_.push_back({.load = &load, .a = -value * load.direction});
  }
  flatten(now.everywhere_);
  for (At::Term& term : now.terms_) flatten(term.a);
  return now;
}

BodyAcceleration::At BodyAcceleration::change(Real from, Real to) const {
  At change = at(to);
  const At before = at(from);
  change.everywhere_ -= before.everywhere_;
  for (std::size_t k = 0; k < change.terms_.size(); ++k) {
    change.terms_[k].a -= before.terms_[k].a;
    change.terms_[k].omega2 -= before.terms_[k].omega2;
  }
  return change;
}

BodyAcceleration acceleration_of_particles(const Model& model) {
  std::vector<Index> parts;
  for (std::size_t p = 0; p < model.parts.size(); ++p)
    if (model.parts[p].has_sph) parts.push_back(static_cast<Index>(p));
  return BodyAcceleration(model.body_loads).on(parts);
}

void check_body_loads_2d(const Deck& deck, Diagnostics& diagnostics) {
  const auto warn = [&](const Entry& card) {
    diagnostics.warning(deck.where(card),
                        fmt::format("{}: in 2D nothing moves along z: no effect", deck.keyword(card)),
                        "gravity of a 2D scene is *LOAD_BODY_X or *LOAD_BODY_Y");
  };
  for (const LoadBodyCard& card : deck.all<LoadBodyCard>())
    if (card.name == 2 && card.cid == 0 && card.sf != 0) warn(card);
  for (const LoadGravityPartCard& card : deck.all<LoadGravityPartCard>())
    if (card.dof == 3 && card.accel != 0) warn(card);
  for (const LoadBodyVectorCard& card : deck.all<LoadBodyVectorCard>())
    if (card.v3 != 0)
      deck.warning(diagnostics, card, "V3", "in 2D nothing moves along z: this component has no effect",
                   "give a vector in the plane");
  for (const LoadBodyRotationCard& card : deck.all<LoadBodyRotationCard>())
    if (card.name != 2)
      deck.error(diagnostics, card, "", "a 2D scene turns in its plane only, about z", "use *LOAD_BODY_RZ");
}

void check_body_loads_periodic(const Deck& deck, const Vec& normal, Diagnostics& diagnostics) {
  constexpr Real along = 1 - 1e-9;  // cosine
  for (const LoadBodyRotationCard& card : deck.all<LoadBodyRotationCard>())
    if (std::abs(normal[card.name]) < along)
      deck.error(diagnostics, card, "",
                 "the centrifugal acceleration is not the same again beyond a periodic plane",
                 "turn about the direction of the period, or leave *BOUNDARY_SPH_PERIODIC out");
}

}  // namespace courant
