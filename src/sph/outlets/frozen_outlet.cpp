// *COURANT_FROZEN_OUTLET: what leaves the computational box gets a velocity and the pressure below a level,
// and keeps both.
#include "sph/outlets/frozen_outlet.hpp"
#include "sph/boundaries/boundary_cards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/run_error.hpp"
#include "keyword/registry.hpp"
#include "model/definitions/named_curve.hpp"
#include "sph/materials/initial_stress.hpp"
#include "sph/outlets/free_surface.hpp"

namespace courant {

namespace {

const RegisterKeyword<CourantFrozenOutlet> frozen_outlet_keyword{courant_frozen_outlet_table()};

/// What a card means.
struct FrozenOutlet {
  int axis = 0;
  Real sign = 1, face = 0;  ///< the face is at x[axis] = face [L]
  Real vel = 0;             ///< [L/T]
  Curve factor{};           ///< on vel over time; empty: 1
  FreeSurface surface{};

  bool passed(const Vec& x) const { return sign * (x[axis] - face) > 0; }
  Vec velocity(Real t) const {
    return sign * vel * (factor.abscissa.empty() ? 1 : factor(t)) * Vec::Unit(axis);
  }
};

/// A particle keeps what it has when it leaves the box; this changes what that is, once.
class FrozenOutlets : public Refresh {
 public:
  FrozenOutlets(std::vector<FrozenOutlet> outlets, const std::vector<PartMaterial>& materials,
                std::shared_ptr<const Neighbours> neighbours)
      : outlets_(std::move(outlets)), materials_(materials), neighbours_(std::move(neighbours)) {}
  std::string name() const override { return "frozen outlets"; }

  void refreshed(World& world, const Clock& clock, std::span<const Index>) override {
    Particles& p = world.particles;
    for (const Index i : neighbours_->left())
      for (const FrozenOutlet& o : outlets_) {
        if (!o.passed(p.x.vec(i))) continue;
        p.v.set(i, o.velocity(clock.t));
        set_pressure(world, i, o.surface.head(p.x.vec(i), clock.t, p.part[i]));
        break;
      }
  }

 private:
  void set_pressure(World& world, Index i, Real head) const {
    Particles& p = world.particles;
    const PartMaterial& m = materials_[static_cast<std::size_t>(p.part[i])];
    const auto mu = compression_at(*m.eos, m.ro, m.ro * head);
    if (!mu)
      throw RunError(
          fmt::format("*COURANT_FROZEN_OUTLET: the equation of state of part {} has no density with "
                      "the pressure {:g} below the level",
                      world.part_ids[static_cast<std::size_t>(p.part[i])], m.ro * head),
          "check the level and its units");
    p.rho[i] = m.ro * (1 + *mu);
    p.p[i] = m.ro * head;
  }

  std::vector<FrozenOutlet> outlets_;
  const std::vector<PartMaterial>& materials_;
  std::shared_ptr<const Neighbours> neighbours_;
};

class FrozenOutletReader {
 public:
  FrozenOutletReader(const Deck& deck, const Model& model, const SphSettings& settings, const World& world,
                     Diagnostics& diagnostics)
      : deck_(deck), model_(model), settings_(settings), world_(world), diagnostics_(diagnostics) {}

  std::vector<FrozenOutlet> read() {
    std::vector<FrozenOutlet> outlets;
    for (const auto& card : deck_.all<CourantFrozenOutlet>()) {
      FrozenOutlet o;
      if (!read_face(card, o) || !read_flow(card, o) || !read_level(card, o)) continue;
      for (const FrozenOutlet& other : outlets)
        if (other.axis == o.axis && other.sign == o.sign)
          refuse(card, "DIR", "this face has an outlet already", "give each face one outlet");
      outlets.push_back(std::move(o));
    }
    return outlets;
  }

 private:
  bool refuse(const CourantFrozenOutlet& card, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
    return false;
  }

  bool read_face(const CourantFrozenOutlet& card, FrozenOutlet& o) {
    if (!settings_.region)
      return refuse(card, "DIR", "there is no computational box whose face it could be",
                    "name a *DEFINE_BOX by BOXID of *CONTROL_SPH");
    o.axis = std::abs(card.dir) - 1, o.sign = card.dir > 0 ? 1 : -1;
    if (o.axis >= settings_.dim)
      return refuse(card, "DIR", "in 2D nothing flows along z", "use 1, -1, 2 or -2");
    for (const GhostPlane& plane : settings_.walls.planes)
      if (plane.kind == GhostPlane::Kind::periodic && std::abs(plane.normal[o.axis]) > 1e-9)
        return refuse(card, "DIR", "the face is behind a periodic plane, through which water comes back",
                      "let water leave along the planes");
    o.face = card.dir > 0 ? settings_.region->high[o.axis] : settings_.region->low[o.axis];
    return true;
  }

  bool read_flow(const CourantFrozenOutlet& card, FrozenOutlet& o) {
    o.vel = card.vel;
    if (card.lcvel == 0) return true;
    const Curve* curve = curve_of(card, "LCVEL", card.lcvel);
    if (!curve) return false;
    o.factor = *curve;
    if (*std::min_element(curve->ordinate.begin(), curve->ordinate.end()) > 0) return true;
    return refuse(
        card, "LCVEL",
        fmt::format("curve {} falls to 0 or below: particles that leave would remain before the box",
                    card.lcvel),
        "let it stay above 0");
  }

  bool read_level(const CourantFrozenOutlet& card, FrozenOutlet& o) {
    o.surface.gravity = acceleration_of_particles(model_);
    const Particles& p = world_.particles;
    const Index part = p.size() > 0 ? p.part[0] : -1;
    const auto up = upward(o.surface.gravity, Vec(card.xs, card.ys, card.zs), 0, model_.endtim, part);
    if (!up)
      return refuse(card, "DIR", "without gravity there is no pressure below a level",
                    "give gravity by *LOAD_BODY, or leave the outlet out: the box freezes what leaves it");
    o.surface.up = *up, o.surface.point = Vec(card.xs, card.ys, card.zs);
    for (std::size_t k = 0; k < model_.parts.size(); ++k)
      if (model_.parts[k].has_sph && !settings_.strength.empty() && settings_.strength[k])
        return refuse(card, "DIR", fmt::format("part {} has strength", model_.parts[k].id),
                      "it is for fluids, which *MAT_NULL makes");
    if (card.lclev == 0) return true;
    const Curve* curve = curve_of(card, "LCLEV", card.lclev);
    if (curve) o.surface.level = *curve;
    return curve != nullptr;
  }

  const Curve* curve_of(const CourantFrozenOutlet& card, const char* field, Id id) {
    return curve_named(deck_, model_, card, field, id, diagnostics_);
  }

  const Deck& deck_;
  const Model& model_;
  const SphSettings& settings_;
  const World& world_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::string keep_face(CourantFrozenOutlet&, const Affine& motion) {
  if (motion.linear() == Matrix::Identity()) return {};
  return "its face is one of a box along the axes, which a transformation that turns the file would change";
}

bool add_frozen_outlets(const Deck& deck, const Model& model, const SphSettings& settings,
                        const std::vector<PartMaterial>& materials,
                        std::shared_ptr<const Neighbours> neighbours, World& world,
                        Diagnostics& diagnostics) {
  const int errors = diagnostics.errors();
  std::vector<FrozenOutlet> outlets = FrozenOutletReader(deck, model, settings, world, diagnostics).read();
  if (outlets.empty() || diagnostics.errors() > errors) return !deck.all<CourantFrozenOutlet>().empty();
  world.passes.add(std::make_shared<FrozenOutlets>(std::move(outlets), materials, std::move(neighbours)));
  return true;
}

}  // namespace courant
