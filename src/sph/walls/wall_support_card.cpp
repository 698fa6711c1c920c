// *COURANT_WALL_SUPPORT: meaning of its fields, and what is refused.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "keyword/registry.hpp"
#include "model/mesh/named_parts.hpp"
#include "sph/cards.hpp"
#include "sph/sph.hpp"
#include "sph/walls/wall_surface.hpp"
#include "surfaces/contact_thickness.hpp"

namespace courant {

namespace {

const RegisterKeyword<CourantWallSupport> wall_support_keyword{courant_wall_support_table()};

/// Warns if contact, which acts at half the thickness, does not hold particles half a spacing from the
/// wall, or, with mirrors and ghosts, holds them before that. Images of wide kernels hardly repel
/// particles from a wall: contact at half a spacing then keeps still water still.
void check_thickness(const CourantWallSupport& c, Real thickness, const Deck& deck, const World& world,
                     KernelChoice kernel, Diagnostics& diagnostics) {
  constexpr Real wide = 3.9;  // reach of the kernel over spacing
  const Particles& p = world.particles;
  const Real dx = p.size() > 0 ? std::pow(p.m[0] / p.rho[0], 1.0 / world.dim) : 0;
  if (c.method > 0) {
    const bool is_wide = c.method == 1 && p.size() > 0 && kernel_support(kernel) * p.h[0] > wide * dx;
    if (thickness > (is_wide ? 1.05 : 0.5) * dx)
      diagnostics.warning(
          deck.where(c),
          fmt::format("*COURANT_WALL_SUPPORT: contact holds particles {:g} off the middle of the shells and "
                      "carries part of what METHOD {} should, which holds them half a spacing off, {:g}",
                      0.5 * thickness, c.method, 0.5 * dx),
          "let the shells be 0.4 spacings of the particles thick");
    return;
  }
  if (std::abs(thickness / dx - 1) > 0.1)
    diagnostics.warning(
        deck.where(c),
        fmt::format("*COURANT_WALL_SUPPORT: contact holds particles {:g} off the middle of the "
                    "shells, where the sums are complete for {:g}, half a spacing",
                    0.5 * thickness, 0.5 * dx),
        "let the shells be one spacing of the particles thick");
}

/// Refuses what METHOD 1 does not support.
void check_images(const CourantWallSupport& c, const Deck& deck, const Model& model, const World& world,
                  const SphSettings& s, Diagnostics& diagnostics) {
  const auto refuse = [&](bool is, const char* what, const char* hint) {
    if (is) deck.error(diagnostics, c, "METHOD", fmt::format("METHOD 1 is not supported {}", what), hint);
  };
  refuse(s.renormalised, "where FORM of *CONTROL_SPH renormalises", "use METHOD 0, or FORM 0");
  refuse(!s.uniform_h, "where smoothing lengths differ",
         "use METHOD 0, or one CSLH and spacing, HMIN = HMAX = 1");
  refuse(s.geometry_eps > 0, "with *COURANT_PAIR_GEOMETRY", "use METHOD 0, or leave the other card out");
  const auto bends = [&](Index segment) {
    return segment_moves(world, segment) &&
           !model.parts[static_cast<std::size_t>(world.segments.part[segment])].rigid;
  };
  refuse(std::any_of(s.walls.segments.begin(), s.walls.segments.end(), bends),
         "on walls that move and are no rigid bodies", "use METHOD 0, or make them of *MAT_RIGID");
}

/// Refuses what METHOD 2 does not support: ghosts enter the pair loops of plain water alone.
void check_ghosts(const CourantWallSupport& c, const Deck& deck, const Model& model, const SphSettings& s,
                  Diagnostics& diagnostics) {
  const auto refuse = [&](bool is, const char* what, const char* hint = "use METHOD 1 or 0") {
    if (is) deck.error(diagnostics, c, "METHOD", fmt::format("METHOD 2 is not supported {}", what), hint);
  };
  const char* const one_h = "use METHOD 0, or one CSLH and spacing, HMIN = HMAX = 1";
  refuse(!s.uniform_h, "where smoothing lengths differ", one_h);
  refuse(s.renormalised, "where FORM of *CONTROL_SPH renormalises", "use METHOD 0, or FORM 0");
  refuse(s.geometry_eps > 0, "with *COURANT_PAIR_GEOMETRY");
  refuse(!s.strength.empty(), "beside particles with strength");
  refuse(std::holds_alternative<RiemannFlux>(s.viscosity), "with *COURANT_RIEMANN");
  refuse(s.volume_tau > 0, "with *COURANT_VOLUME_CONTROL");
  refuse(s.shift.strength > 0, "with shifting (ISHIFT of *CONTROL_SPH)");
  refuse(s.xsph > 0 || s.velocity_smoothing > 0, "with *COURANT_XSPH");
  refuse(s.reinitialisation.every > 0, "where densities are re-initialised");
  refuse(s.mixing_length.most > 0 || deck.last<CourantTurbulence>() != nullptr, "with a model of turbulence");
  refuse(c.cf > 0 || c.law != 0, "with friction (CF, LAW)");
  refuse(deck.last<CourantWallBelt>() != nullptr, "with *COURANT_WALL_BELT");
  refuse(!parts_of_several_materials(model).empty(), "where SPH parts differ in MID or EOSID");
}

/// Requirements of no-slip walls.
void check_no_slip(const CourantWallSupport& c, const Deck& deck, const Model& model, const SphSettings& s,
                   Diagnostics& diagnostics) {
  const auto refuse = [&](bool is, const char* field, const std::string& what, const char* hint) {
    if (is) deck.error(diagnostics, c, field, what, hint);
  };
  refuse(c.cf > 0, "CF", "LAW 2 finds the shear stress itself", "leave CF 0, or give LAW 0");
  refuse(c.ks > 0, "KS", "LAW 2 has no roughness", "leave KS 0, or give LAW 1");
  refuse(!s.strength.empty(), "LAW", "no slip is not supported beside particles with strength",
         "give LAW 0, or let solids be elements or rigid bodies");
  refuse(s.mixing_length.most > 0, "LAW",
         "no slip takes viscosity between pairs, and *COURANT_EDDY_VISCOSITY acts by a stress",
         "use MODEL 1 of *COURANT_TURBULENCE, which is that mixing length between pairs");
  const auto* turbulence = deck.last<CourantTurbulence>();
  refuse(turbulence && static_cast<TurbulenceModel>(turbulence->model) == TurbulenceModel::k_epsilon, "LAW",
         "k-epsilon does not hold down to a wall without slip", "give LAW 1, the law of the wall");
  for (const ModelPart& part : model.parts)
    if (part.has_sph && (s.mu.empty() || !(s.mu[static_cast<std::size_t>(&part - model.parts.data())] > 0)))
      return refuse(true, "LAW", fmt::format("no slip needs a viscosity, and part {} has none", part.id),
                    "give MU in *MAT_NULL, 1e-3 Pa s for water, or LAW 0");
}

/// Refuses contradicting fields of friction.
void check_friction(const CourantWallSupport& c, const Deck& deck, const Model& model, const SphSettings& s,
                    Diagnostics& diagnostics) {
  if (c.law == 2) return check_no_slip(c, deck, model, s, diagnostics);
  if (c.law == 0 && c.ks > 0)
    deck.error(diagnostics, c, "KS", "a roughness belongs to the logarithmic law",
               "give LAW 1, or leave KS 0");
  if (c.law == 0) return;
  if (c.cf > 0)
    deck.error(diagnostics, c, "CF", "LAW 1 finds the shear stress itself", "leave CF 0, or give LAW 0");
  if (c.ks > 0) return;
  for (const ModelPart& part : model.parts)
    if (part.has_sph && (s.mu.empty() || !(s.mu[static_cast<std::size_t>(&part - model.parts.data())] > 0)))
      return deck.error(diagnostics, c, "KS",
                        fmt::format("the logarithmic law of a smooth wall needs the viscosity of the water, "
                                    "and part {} has none",
                                    part.id),
                        "give MU in *MAT_NULL, 1e-3 Pa s for water, or the roughness KS");
}

/// Whether a node of a shell moves by forces.
bool deforms(const World& world, Index segment) {
  for (const Index n : world.segments.nodes(segment))
    if (world.nodes.follow[n] == 0) return true;
  return false;
}

}  // namespace

void read_supported_walls(const Deck& deck, const Model& model, const World& world, SphSettings& settings,
                          Diagnostics& diagnostics) {
  SupportedWalls& walls = settings.walls;
  if (world.particles.size() == 0) return;  // there may be a million shells
  walls.friction.assign(static_cast<std::size_t>(world.segments.size()), {});
  const CourantWallSupport* first = nullptr;
  for (const auto& c : deck.all<CourantWallSupport>()) {
    const std::vector<char> chosen =
        shell_parts_named(deck, model, c, "SURFB", c.surfb, c.surfbtyp, diagnostics);
    Real thickness = 0;
    for (Index s = 0; s < world.segments.size(); ++s) {
      if (!chosen[world.segments.part[s]]) continue;
      if (deforms(world, s)) {
        deck.error(diagnostics, c, "SURFB",
                   fmt::format("the shells of part {} deform, which is not supported here",
                               model.parts[world.segments.part[s]].id),
                   "name rigid parts; contact alone holds particles off shells that deform");
        return;
      }
      thickness = contact_thickness(world.segments, s);
      if (walls.friction[s].cf >= 0) {
        deck.error(diagnostics, c, "SURFB",
                   fmt::format("part {} is named twice", model.parts[world.segments.part[s]].id),
                   "name each part by one card");
        return;
      }
      walls.segments.push_back(s);
      walls.friction[s] = {.cf = c.cf, .log_law = c.law == 1, .ks = c.ks, .no_slip = c.law == 2};
    }
    walls.hold |= c.law == 2;
    if (first && first->method != c.method)
      deck.error(diagnostics, c, "METHOD", "another *COURANT_WALL_SUPPORT has another METHOD",
                 "give all of them the same METHOD");
    first = &c;
    walls.images = c.method == 1;
    if (c.method == 2) check_ghosts(c, deck, model, settings, diagnostics);
    if (walls.images) check_images(c, deck, model, world, settings, diagnostics);
    check_friction(c, deck, model, settings, diagnostics);
    if (thickness > 0) check_thickness(c, thickness, deck, world, settings.kernel, diagnostics);
  }
  read_wall_belts(deck, model, world, settings, diagnostics);
  if (first && first->method == 2) walls.with_ghosts.swap(walls.segments);
}

}  // namespace courant
