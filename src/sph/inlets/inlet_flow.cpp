// *COURANT_INFLOW: pressure under a free surface, and profile of the velocity, of the water that inlets let
// in.
#include "sph/inlets/inlet_flow.hpp"
#include "sph/boundaries/boundary_cards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "keyword/registry.hpp"
#include "model/definitions/named_curve.hpp"
#include "sph/inlets/injection.hpp"

namespace courant {

namespace {

enum class SurfaceChoice { none = 0, upper_rim = 1, point = 2 };
enum class Profile { uniform = 0, power = 1, logarithmic = 2, curve = 3 };

const RegisterKeyword<CourantInflow> courant_inflow_keyword{courant_inflow_table()};

class InflowReader {
 public:
  InflowReader(const Deck& deck, const Model& model, std::vector<Injection>& inlets, Diagnostics& diagnostics)
      : deck_(deck), model_(model), inlets_(inlets), diagnostics_(diagnostics) {}

  void read() {
    std::vector<const CourantInflow*> of_part(model_.parts.size(), nullptr);
    for (const CourantInflow& card : deck_.all<CourantInflow>()) {
      const auto part = model_.part_of_id.find(card.pid);
      const Index k = part == model_.part_of_id.end() ? -1 : part->second;
      const auto is_of_part = [k](const Injection& inlet) { return inlet.part == k; };
      if (k < 0 || std::none_of(inlets_.begin(), inlets_.end(), is_of_part)) {
        refuse(card, "PID", fmt::format("part {} {}", card.pid, k < 0 ? "does not exist" : "has no inlet"),
               "name the part of a *DEFINE_SPH_INJECTION");
        continue;
      }
      const CourantInflow*& first = of_part[static_cast<std::size_t>(k)];
      if (first)
        refuse(card, "PID", fmt::format("part {} has one already, at {}", card.pid, deck_.place(*first)),
               "keep one of the two");
      first = &card;
      if (check(card))
        for (Injection& inlet : inlets_)
          if (is_of_part(inlet)) complete(card, inlet);
    }
  }

 private:
  bool refuse(const CourantInflow& card, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
    return false;
  }

  bool check(const CourantInflow& card) {
    const int errors = diagnostics_.errors();
    const auto surf = static_cast<SurfaceChoice>(card.surf);
    const auto profile = static_cast<Profile>(card.prof);
    if (surf != SurfaceChoice::point && !Vec(card.xs, card.ys, card.zs).isZero())
      refuse(card, "XS", "the point is that of SURF 2", "give SURF 2, or leave it blank");
    if (surf == SurfaceChoice::none && card.lclev != 0)
      refuse(card, "LCLEV", "without a surface it has no level", "give SURF 1 or 2");
    if (card.lclev != 0) curve_of(card, "LCLEV", card.lclev);
    if (profile == Profile::logarithmic && !(card.ks > 0))
      refuse(card, "KS", "PROF 2 needs the roughness", "of a smooth bed it is 3.3 nu/u*");
    if (profile != Profile::logarithmic && card.ks > 0)
      refuse(card, "KS", fmt::format("PROF {} does not use it", card.prof), "give PROF 2, or leave it blank");
    if (profile == Profile::curve && card.lcprof == 0)
      refuse(card, "LCPROF", "PROF 3 needs a curve", "give a *DEFINE_CURVE of the factor over the height");
    if (profile != Profile::curve && card.lcprof != 0)
      refuse(card, "LCPROF", fmt::format("PROF {} does not use it", card.prof),
             "give PROF 3, or leave it blank");
    if (profile == Profile::curve && card.lcprof != 0) {
      const Curve* curve = curve_of(card, "LCPROF", card.lcprof);
      if (curve && *std::min_element(curve->ordinate.begin(), curve->ordinate.end()) < 0)
        refuse(card, "LCPROF", fmt::format("curve {} falls below 0: water would flow out", card.lcprof),
               "an inlet lets water in; leave out the positions where it flows back");
    }
    return diagnostics_.errors() == errors;
  }

  const Curve* curve_of(const CourantInflow& card, const char* field, Id id) {
    return curve_named(deck_, model_, card, field, id, diagnostics_);
  }

  void complete(const CourantInflow& card, Injection& inlet) {
    const BodyAcceleration loads = acceleration_of_particles(model_);
    const auto up = upward(loads, inlet.plane.point, inlet.begin, model_.endtim, inlet.part);
    if (!up) {
      refuse(card, card.surf != 0 ? "SURF" : "PROF", "without gravity the upward direction is not defined",
             "give gravity by *LOAD_BODY, or leave the keyword out");
      return;
    }
    FreeSurface& surface = inlet.surface;
    surface.up = *up;
    surface.gravity = loads;
    const auto height = [&](const Vec& x) { return x.dot(surface.up); };
    const auto [low, high] =
        std::minmax_element(inlet.places.begin(), inlet.places.end(),
                            [&](const Vec& a, const Vec& b) { return height(a) < height(b); });
    // The normal component of `up` takes nothing from the height of a cell.
    const Real half =
        0.5 * inlet.cell * (surface.up - surface.up.dot(inlet.plane.normal) * inlet.plane.normal).norm();
    surface.on = card.surf != 0;
    surface.point = static_cast<SurfaceChoice>(card.surf) == SurfaceChoice::point
                        ? Vec(card.xs, card.ys, card.zs)
                        : Vec(*high + half * surface.up);
    if (card.lclev != 0) surface.level = model_.curves.at(card.lclev);
    if (static_cast<Profile>(card.prof) != Profile::uniform) set_profile(card, inlet, height(*low) - half);
  }

  /// `bottom`: height of the lower rim. Laws keep the mean over what is below the surface at TBEG.
  void set_profile(const CourantInflow& card, Injection& inlet, Real bottom) {
    const auto profile = static_cast<Profile>(card.prof);
    Real sum = 0, wet = 0;
    for (const Vec& x : inlet.places) {
      const Real z = x.dot(inlet.surface.up) - bottom;
      const Real f = profile == Profile::power         ? std::pow(z, 1 / card.expo)
                     : profile == Profile::logarithmic ? std::log(30 * z / card.ks)
                                                       : model_.curves.at(card.lcprof)(z);
      if (!(f > 0)) {
        refuse(card, profile == Profile::curve ? "LCPROF" : "KS",
               fmt::format("the profile is {:.4g} at z = {:.4g} [L], where the lowest particles enter", f, z),
               "let it be above 0 at the middle of each row of particles");
        return;
      }
      const Real share =
          inlet.surface.on ? inlet.surface.filled(x, inlet.begin, inlet.cell, inlet.plane.normal) : 1;
      sum += share * f, wet += share;
      inlet.factor.push_back(f);
    }
    if (profile == Profile::curve || !(sum > 0)) return;
    for (Real& f : inlet.factor) f *= wet / sum;
  }

  const Deck& deck_;
  const Model& model_;
  std::vector<Injection>& inlets_;
  Diagnostics& diagnostics_;
};

}  // namespace

Real InletRate::time_of(Real sum, Real begin) const {
  if (steady()) return begin + sum;
  Real t = begin, at = curve_(begin);
  for (std::size_t k = 0; k < curve_.abscissa.size(); ++k) {
    const Real next = curve_.abscissa[k], value = curve_.ordinate[k];
    if (next <= t) {
      if (next == t) at = value;  // a jump: the later one holds
      continue;
    }
    // between two points with the same abscissa the earlier one ends the piece
    const Real piece = 0.5 * (at + value) * (next - t);
    if (piece >= sum) {  // at s + slope s^2/2 = sum, in the form that holds where the slope is 0
      const Real slope = (value - at) / (next - t);
      return t + 2 * sum / (at + std::sqrt(std::max(Real(0), at * at + 2 * slope * sum)));
    }
    sum -= piece, t = next, at = value;
  }
  return at > 0 ? t + sum / at : std::numeric_limits<Real>::infinity();
}

Real InletRate::least() const {
  return steady() ? 1 : *std::min_element(curve_.ordinate.begin(), curve_.ordinate.end());
}
Real InletRate::most() const {
  return steady() ? 1 : *std::max_element(curve_.ordinate.begin(), curve_.ordinate.end());
}

void read_inflows(const Deck& deck, const Model& model, std::vector<Injection>& inlets,
                  Diagnostics& diagnostics) {
  InflowReader(deck, model, inlets, diagnostics).read();
}

}  // namespace courant
