#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "parallel/parallel.hpp"
#include "search/nearest_distance.hpp"
#include "sph/cards.hpp"
#include "sph/core/pair_passes.hpp"
#include "sph/core/view.hpp"
#include "sph/materials/strength.hpp"
#include "sph/walls/ghosts/wall_ghosts.hpp"
#include "state/shared_fields.hpp"

namespace courant {
namespace {

template <class T>
std::map<Id, const T*> by_id(const Deck& deck, Id T::*id) {
  std::map<Id, const T*> found;
  for (const T& entry : deck.all<T>()) found.emplace(entry.*id, &entry);
  return found;
}

struct PartSmoothing {
  Real cslh = 1.2, hmin = 0.2, hmax = 2, sphini = 0;
};

class ParticleBuilder {
 public:
  ParticleBuilder(const Deck& deck, const Model& model, const std::function<SphMaterial(Index)>& material,
                  World& world, Diagnostics& diagnostics)
      : deck_(deck), model_(model), material_(material), world_(world), diagnostics_(diagnostics) {}

  SphSettings build() {
    settings_.tssfac = model_.tssfac;
    settings_.h_min_factor.assign(model_.parts.size(), 1);
    settings_.h_max_factor.assign(model_.parts.size(), 1);
    settings_.q.resize(model_.parts.size());
    settings_.spacing_of_part.resize(model_.parts.size());
    settings_.usual_spacing.resize(model_.parts.size());
    settings_.ro.assign(model_.parts.size(), 0);
    smoothing_.resize(model_.parts.size());
    read_sections();
    settings_.kernel = read_kernel(deck_, model_, diagnostics_);
    read_viscosities();
    read_control();
    fill_particles();
    if (model_.sph.empty()) return settings_;
    read_eddy_viscosity(deck_, model_, world_.particles, settings_, diagnostics_);
    set_smoothing_lengths();
    choose_h_form();
    read_pair_geometry();
    read_density_diffusion();
    if (const auto* c = deck_.last<CourantVolumeControl>()) settings_.volume_tau = c->tau;
    settings_.reinitialisation = read_density_reinitialisation(deck_, model_, diagnostics_);
    read_shifting();
    read_xsph(deck_, settings_, diagnostics_);
    read_riemann(deck_, model_, material_, settings_, diagnostics_);
    read_form(deck_, settings_, diagnostics_);
    read_strength(deck_, model_, settings_, diagnostics_);
    return settings_;
  }

 private:
  void read_sections() {
    const auto sections = by_id(deck_, &SectionSph::secid);
    for (std::size_t k = 0; k < model_.parts.size(); ++k) {
      const ModelPart& part = model_.parts[k];
      if (!part.has_sph) continue;
      const auto found = sections.find(part.secid);
      if (found == sections.end()) {
        deck_.error(diagnostics_, part.card, "SECID",
                    fmt::format("the particles of part {} need a *SECTION_SPH with id {}; {}", part.id,
                                part.secid, deck_.found_instead(IdSpace::section, part.secid)),
                    "add the section, or correct the id here");
        continue;
      }
      const SectionSph& s = *found->second;
      refuse_death(s, "DEATH", s.death);
      if (s.hmin > s.hmax)
        deck_.error(diagnostics_, s, "HMIN",
                    fmt::format("expected a number <= HMAX = {:g}, got '{:g}'", s.hmax, s.hmin),
                    "h may vary from HMIN h0 to HMAX h0; HMIN = HMAX = 1 keeps it constant");
      smoothing_[k] = {s.cslh, s.hmin, s.hmax, s.sphini};
      settings_.h_min_factor[k] = s.hmin;
      settings_.h_max_factor[k] = s.hmax;
    }
  }

  /// Particles interact to the end.
  void refuse_death(const Entry& card, const char* field, Real death) {
    if (death < model_.endtim)
      deck_.refuse(diagnostics_, card, field, fmt::format("'{:g}', before ENDTIM, is not supported", death),
                   "leave the field blank");
  }

  void read_viscosities() {
    const auto hourglass = by_id(deck_, &Hourglass::hgid);
    const auto* control = deck_.last<ControlBulkViscosity>();
    for (std::size_t k = 0; k < model_.parts.size(); ++k) {
      const ModelPart& part = model_.parts[k];
      if (control) settings_.q[k] = {control->q2, control->q1};  // LS-DYNA: Q1 quadratic, Q2 linear
      if (part.hgid == 0) continue;
      const auto found = hourglass.find(part.hgid);
      if (found == hourglass.end())
        deck_.error(diagnostics_, part.card, "HGID", fmt::format("hourglass {} does not exist", part.hgid),
                    "define it with *HOURGLASS, or leave the field blank");
      else
        settings_.q[k] = {found->second->q2, found->second->q1};
    }
  }

  void read_control() {
    const ControlSph* c = deck_.last<ControlSph>();
    const ControlSph standard{};
    if (c == nullptr || model_.sph.empty()) c = &standard;  // rigid bodies alone are in space
    refuse_death(*c, "DT", c->dt);
    const auto parts = std::count_if(model_.parts.begin(), model_.parts.end(),
                                     [](const ModelPart& part) { return part.has_sph; });
    if (c->cont == 1 && parts > 1)
      deck_.refuse(diagnostics_, *c, "CONT", fmt::format("'1' is not supported with {} SPH parts", parts),
                   "leave the field blank or 0: parts that meet interact");
    world_.dim = c->idim == 2 ? 2 : c->idim == 3 ? 3 : dimension_of_geometry();
    settings_.dim = world_.dim;
    settings_.maxv = std::abs(c->maxv) >= 1e15 ? 0 : c->maxv;
    settings_.hide_inactive = c->ishow == 1;
    settings_.skip_inactive_contact = c->icont == 1;
    settings_.thickness_from_volume = c->ithk == 1;
    if (c->boxid != 0) {
      const auto box = model_.boxes.find(c->boxid);
      if (box == model_.boxes.end())
        deck_.error(diagnostics_, *c, "BOXID", fmt::format("box {} does not exist", c->boxid),
                    "define it with *DEFINE_BOX");
      else if (box->second.local)
        deck_.error(diagnostics_, *c, "BOXID",
                    fmt::format("box {} has axes of its own, which is not supported here", c->boxid),
                    "use a *DEFINE_BOX along the global axes");
      else
        settings_.region = Neighbours::Region{box->second.low, box->second.high};
    }
    if (c->iavis == 1) {
      settings_.viscosity = BulkViscosity{};
      return;
    }
    settings_.viscosity = MonaghanViscosity{common_q2()};
  }

  void read_density_diffusion() {
    const auto* c = deck_.last<CourantDensityDiffusion>();
    if (c == nullptr) return;
    settings_.density_diffusion = c->delta;
    settings_.loads = acceleration_of_particles(model_);
    if (settings_.loads.by_parts())
      deck_.error(diagnostics_, *c, "DELTA",
                  "density diffusion takes body loads that act on all SPH parts alike, which these do not",
                  "let loads act on all SPH parts or on none, or leave the card out");
    const Real most = most_diffusion * std::min(Real(1), stiffness<CubicSpline>() /
                                                             with_kernel(settings_.kernel, [&](auto kernel) {
                                                               return stiffness<decltype(kernel)>();
                                                             }));
    if (c->delta > most)
      deck_.error(
          diagnostics_, *c, "DELTA",
          fmt::format("expected at most {:.3g}, beyond which it is unstable, got '{:g}'", most, c->delta),
          "0.1 evens out the noise of pressures");
  }

  /// Integral of -(dW/dr)/r, times h^2: how stiff diffusion between neighbours is; in 2D.
  template <class Kernel>
  static Real stiffness() {
    return 2 * pi * Kernel::C(2) * Kernel::shape(0.0);
  }

  void read_shifting() {
    const auto* control = deck_.last<ControlSph>();
    const auto* c = deck_.last<CourantShifting>();
    const bool on = control != nullptr && control->ishift == 1;
    if (c && !on)
      deck_.error(diagnostics_, *c, "A", "nothing asks for the shifting that this describes",
                  "set ISHIFT of *CONTROL_SPH to 1, or leave the keyword out");
    if (!on) return;
    constexpr Real usual_strength = 2, usual_pairing = 0.2;
    settings_.shift.strength = c ? c->strength : usual_strength;
    settings_.shift.pairing = c ? std::max(c->pairing, Real(0)) : usual_pairing;
    settings_.shift.surface = c && c->surface > 0 ? c->surface : settings_.dim - 0.5;
    settings_.shift.correct = c && c->correct == 1;
    if (c && c->surface >= settings_.dim)
      deck_.error(diagnostics_, *c, "SURFACE",
                  fmt::format("expected a number below {}, which is div r inside, got '{:g}'", settings_.dim,
                              c->surface),
                  "1.5 in 2D and 2.5 in 3D distinguish a surface from the inside");
  }

  void read_pair_geometry() {
    const auto* c = deck_.last<CourantPairGeometry>();
    if (c == nullptr) return;
    settings_.geometry_eps = c->eps;
    if (c->eps > 0 && !settings_.uniform_h)
      deck_.error(diagnostics_, *c, "EPS",
                  fmt::format("expected 0 where h differs or changes, got '{:g}'", c->eps),
                  "use HMIN = HMAX = 1 and one CSLH and spacing for all SPH parts, or leave the keyword out");
    const bool kink = with_kernel(settings_.kernel, [](auto kernel) { return decltype(kernel)::kink; });
    if (c->eps > 0 && kink)
      deck_.error(diagnostics_, *c, "EPS",
                  fmt::format("expected 0 beside the {}: particles that pass each other closely turn its "
                              "gradient round within a step",
                              kernel_name(settings_.kernel)),
                  "use another kernel, or leave the keyword out");
  }

  /// The quadratic coefficient of the pair loop, which has only one.
  Real common_q2() {
    const ModelPart* first = nullptr;
    Real q2 = 0;
    for (std::size_t k = 0; k < model_.parts.size(); ++k) {
      const ModelPart& part = model_.parts[k];
      if (!part.has_sph) continue;
      if (first == nullptr) {
        first = &part;
        q2 = settings_.q[k].q2;
      } else if (settings_.q[k].q2 != q2) {
        deck_.error(diagnostics_, part.card, "HGID",
                    fmt::format("the quadratic viscosity Q1 of part {} is {:g}, that of part {} is {:g}: "
                                "IAVIS 0 supports only "
                                "one for all SPH parts",
                                part.id, settings_.q[k].q2, first->id, q2),
                    "give all SPH parts the same Q1 in *HOURGLASS, or use IAVIS 1 of *CONTROL_SPH");
      }
    }
    return q2;
  }

  int dimension_of_geometry() const {
    for (const ModelSph& s : model_.sph)
      if (model_.nodes[s.node].x[2] != model_.nodes[model_.sph[0].node].x[2]) return 3;
    return model_.sph.empty() ? 3 : 2;
  }

  void fill_particles() {
    Particles& p = world_.particles;
    p.fields.resize(static_cast<Index>(model_.sph.size()));
    Field<Real>& volume = shared_fields::reference_volume.add(p.fields);
    bool any_mu = false;
    std::vector<SphMaterial> materials(model_.parts.size());
    std::vector<Real> mu(model_.parts.size(), 0);
    for (std::size_t k = 0; k < model_.parts.size(); ++k)
      if (model_.parts[k].has_sph) {
        materials[k] = material_(static_cast<Index>(k));
        mu[k] = materials[k].mu;
        settings_.ro[k] = materials[k].ro;
        any_mu |= mu[k] > 0;
        if (materials[k].strength) {
          settings_.strength.resize(model_.parts.size());
          settings_.strength[k] = materials[k].strength;
        }
        if (materials[k].heat_in_internal) {
          settings_.heat_in_internal.resize(model_.parts.size(), 0);
          settings_.heat_in_internal[k] = 1;
        }
      }
    if (any_mu) settings_.mu = mu;
    for_each(p.size(), [&](Index i) {
      const ModelSph& s = model_.sph[i];
      const ModelNode& node = model_.nodes[s.node];
      const SphMaterial& material = materials[s.part];
      const Real mass = s.mass > 0 ? s.mass : -s.mass * material.ro;
      p.x.set(i, node.x);
      p.v.set(i, node.v);
      p.m[i] = mass;
      p.rho[i] = material.ro > 0 ? material.ro / material.v0 : 1;
      volume[i] = material.ro > 0 ? mass / material.ro : 0;
      p.id[i] = node.id;
      p.part[i] = s.part;
      p.state[i] = particle_outside;
    });
    if (settings_.dim == 2) {
      report_off_plane();
      check_body_loads_2d(deck_, diagnostics_);
      report_other_unit_of_length();
    }
  }

  /// MASS per unit of depth has another dimension than its field in 3D, by which *INCLUDE_TRANSFORM converts.
  void report_other_unit_of_length() {
    for (const ModelSph& s : model_.sph) {
      const Conversion& c = deck_.files[static_cast<std::size_t>(s.card.file)].conversion;
      if (c.units.length == 1) continue;
      if (deck_.keyword(s.card) != "*ELEMENT_SPH") return;  // those of inlets are behind all of them
      deck_.error(diagnostics_, s.card, "MASS",
                  fmt::format("in 2D masses are per unit of depth, and the file has another unit of length "
                              "(FCTLEN {:g}), which leaves open what the depth is",
                              c.units.length),
                  "give 2D particles in the deck's own unit of length");
      return;  // once for all of them
    }
  }

  void report_off_plane() {
    const Particles& p = world_.particles;
    Index i = 0;
    while (i < p.size() && p.x.vec(i)[2] == p.x.vec(0)[2] && p.v.vec(i)[2] == 0) ++i;
    if (i == p.size()) return;
    diagnostics_.error(
        deck_.where(model_.sph[i].card),
        fmt::format("{}: in 2D all particles must lie in one plane z = constant without velocity along "
                    "z; particle {} has z = {:g} [L] and vz = {:g} [L/T], the first one z = {:g}",
                    deck_.keyword(model_.sph[i].card), p.id[i], p.x.vec(i)[2], p.v.vec(i)[2], p.x.vec(0)[2]),
        "move it into the plane, or use IDIM 3 of *CONTROL_SPH");
  }

  /// h0 = CSLH x largest nearest-neighbour distance, per part. A part in which one particle stands far off
  /// would get an h of that distance, so such particles are refused. Parts whose h differ by no more than the
  /// rounding of coordinates in decks get the h of the first: pair loops are quicker where all have one.
  void set_smoothing_lengths() {
    Particles& p = world_.particles;
    std::vector<Real> nearest = nearest_distance(p.x.data(0), p.x.data(1), p.x.data(2), p.size());
    for (Index i = 0; i < p.size(); ++i)
      if (model_.sph[i].spacing > 0) nearest[i] = model_.sph[i].spacing;
    report_coincident_particles(nearest);
    std::vector<Real> used;
    for (std::size_t k = 0; k < model_.parts.size(); ++k) {
      if (!model_.parts[k].has_sph) continue;
      std::vector<Real> distances;
      for (Index i = 0; i < p.size(); ++i)
        if (p.part[i] == static_cast<Index>(k)) distances.push_back(nearest[i]);
      if (distances.empty()) continue;
      const Real largest = *std::max_element(distances.begin(), distances.end());
      std::nth_element(distances.begin(),
                       distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2),
                       distances.end());
      const Real median = distances[distances.size() / 2];
      Real h = smoothing_[k].sphini;
      if (h <= 0) {
        report_lone_particles(static_cast<Index>(k), nearest, median);
        h = smoothing_[k].cslh * largest;
      }
      if (std::isfinite(largest)) {
        settings_.spacing_of_part[k] = largest;
        settings_.usual_spacing[k] = median;
        settings_.spacing = std::max(settings_.spacing, largest);
      }
      const auto same = std::find_if(used.begin(), used.end(), [h](Real other) {
        return std::abs(h - other) <= rounding_of_decks * other;
      });
      if (same != used.end())
        h = *same;
      else
        used.push_back(h);
      for_each(p.size(), [&](Index i) {
        if (p.part[i] == static_cast<Index>(k)) p.h[i] = h;
      });
    }
  }

  void report_coincident_particles(const std::vector<Real>& nearest) {
    const Particles& p = world_.particles;
    Index found = 0;
    for (Index i = 0; i < p.size(); ++i) {
      if (nearest[i] != 0) continue;
      Index first = 0;  // the earlier one of the pair is not reported
      while (p.x.vec(first) != p.x.vec(i)) ++first;
      if (model_.sph[first].node == model_.sph[i].node)
        continue;  // the same one, or one node used twice: told already
      diagnostics_.error(deck_.where(model_.sph[i].card),
                         fmt::format("{}: particle {} is at the position of particle {}",
                                     deck_.keyword(model_.sph[i].card), p.id[i], p.id[first]),
                         "remove one of the two, or move its node");
      if (++found < max_reports) continue;
      diagnostics_.note(deck_.where(model_.sph[i].card),
                        fmt::format("only {} particles at the position of another are shown", max_reports));
      return;  // each search runs over all particles
    }
  }

  void report_lone_particles(Index part, const std::vector<Real>& nearest, Real median) {
    const Particles& p = world_.particles;
    Index found = 0;
    for (Index i = 0; i < p.size(); ++i) {
      if (p.part[i] != part || !(nearest[i] > 3 * median || !std::isfinite(nearest[i]))) continue;
      if (++found > max_reports) continue;
      const std::string what =
          std::isfinite(nearest[i])
              ? fmt::format(
                    "has no neighbour: the nearest other particle is {:.4g} [L] away, the usual "
                    "distance in its part is {:.4g}",
                    nearest[i], median)
              : std::string("is the only one, so it has no neighbour to take the smoothing length from");
      diagnostics_.error(deck_.where(model_.sph[i].card),
                         fmt::format("{}: particle {} {}", deck_.keyword(model_.sph[i].card), p.id[i], what),
                         "remove the particle, or give the smoothing length by SPHINI of *SECTION_SPH");
    }
    if (found > max_reports)
      diagnostics_.note(model_.parts[part].where,
                        fmt::format("{} more particles of part {} have no neighbour", found - max_reports,
                                    model_.parts[part].id));
  }

  void choose_h_form() {
    const Particles& p = world_.particles;
    settings_.uniform_h = true;
    for (Index i = 0; i < p.size(); ++i) settings_.uniform_h &= p.h[i] == p.h[0];
    for (std::size_t k = 0; k < model_.parts.size(); ++k)
      if (model_.parts[k].has_sph && !(settings_.h_min_factor[k] == 1 && settings_.h_max_factor[k] == 1))
        settings_.evolving_h = true;
    settings_.uniform_h &= !settings_.evolving_h;
  }

  const Deck& deck_;
  const Model& model_;
  const std::function<SphMaterial(Index)>& material_;
  World& world_;
  Diagnostics& diagnostics_;
  SphSettings settings_;
  std::vector<PartSmoothing> smoothing_;
  static constexpr Real most_diffusion = 0.2;      ///< delta h c dt = dx^2/4 at TSSFAC 0.9, h = 1.2 dx
  static constexpr Real rounding_of_decks = 1e-6;  ///< of a spacing
  static constexpr Index max_reports = 20;         ///< of one kind of fault
};

}  // namespace

SphSettings build_particles(const Deck& deck, const Model& model,
                            const std::function<SphMaterial(Index part)>& material, World& world,
                            Diagnostics& diagnostics) {
  return ParticleBuilder(deck, model, material, world, diagnostics).build();
}

std::vector<PassNote> add_sph_passes(World& world, const SphSettings& s,
                                     std::shared_ptr<Neighbours> neighbours,
                                     const std::shared_ptr<WallGhosts>& wall_ghosts) {
  std::vector<PassNote> left_out;
  const auto volumes = make_pair_volumes(world);
  const auto add_or_tell = [&](bool on, auto add, const char* name, const char* reason) {
    if (on)
      add(s, world, neighbours, volumes);
    else
      left_out.push_back({name, reason});
  };
  const PairPasses pairs = make_pair_passes(s, world, neighbours, volumes);
  for (const auto& pass : pairs.rates) world.passes.add(pass);
  std::shared_ptr<Force> wall_images;
  if (wall_ghosts) {
    wall_ghosts->set_volumes(volumes);
    add_wall_ghost_forces(world, wall_ghosts);
  } else if (!s.walls.segments.empty()) {
    wall_images = add_wall_support(s, world, neighbours, volumes);
  } else
    left_out.push_back({"wall support", "no *COURANT_WALL_SUPPORT"});
  add_or_tell(s.renormalised, add_renormalisation, "renormalisation", "FORM of *CONTROL_SPH is a plain one");
  const bool riemann = std::holds_alternative<RiemannFlux>(s.viscosity);
  add_or_tell(riemann, add_riemann, "Riemann flux", "no *COURANT_RIEMANN");
  if (s.density_diffusion > 0 || riemann) add_density_diffusion(s, world);
  if (s.density_diffusion == 0) left_out.push_back({"density diffusion", "no *COURANT_DENSITY_DIFFUSION"});
  add_or_tell(s.volume_tau > 0, add_volume_control, "volume control", "no *COURANT_VOLUME_CONTROL");
  add_or_tell(s.shift.strength > 0, add_shifting, "shifting", "ISHIFT 0");
  add_or_tell(s.xsph > 0 || s.velocity_smoothing > 0, add_xsph, "XSPH", "no *COURANT_XSPH");
  if (s.xsph > 0 && !(s.shift.strength > 0)) add_drift_rate(s, world, neighbours, volumes);
  add_or_tell(s.reinitialisation.every > 0, add_density_reinitialisation, "re-initialisation",
              "no *COURANT_DENSITY_REINITIALISATION");
  if (s.geometry_eps == 0) left_out.push_back({"frozen gradients", "no *COURANT_PAIR_GEOMETRY"});
  if (s.evolving_h)
    world.passes.add(make_smoothing_length(s, world));
  else
    left_out.push_back({"smoothing length", "HMIN = HMAX = 1: h is constant"});
  if (std::holds_alternative<BulkViscosity>(s.viscosity))
    world.passes.add(make_bulk_viscosity(s, world));
  else
    left_out.push_back({"bulk viscosity", riemann ? "*COURANT_RIEMANN replaces viscosity"
                                                  : "IAVIS 0: Monaghan viscosity between pairs"});
  if (s.mixing_length.most > 0)
    world.passes.add(make_eddy_viscosity(s, world));
  else
    left_out.push_back({"eddy viscosity", "no *COURANT_EDDY_VISCOSITY"});
  if (s.turbulence.on())
    add_turbulence(s, world, neighbours, volumes);
  else
    left_out.push_back({"turbulence", "no *COURANT_TURBULENCE"});
  if (s.has_viscous_stress())
    world.passes.add(make_viscous_stress(s, world));
  else if (!s.turbulence.on())  // whose viscosity acts between pairs
    s.has_viscous_pairs() ? add_pair_viscosity(s, world, neighbours, volumes)
                          : left_out.push_back({"viscous stress", "MU is 0 in all SPH materials"});
  if (!s.strength.empty())
    add_strength(s, world, neighbours, volumes);
  else
    left_out.push_back({"strength", "all SPH materials are fluids"});
  for (const auto& pass : pairs.forces) world.passes.add(pass);
  if (wall_images) world.passes.add(wall_images);
  if (s.maxv != 0)
    world.passes.add(make_speed_limit(s, neighbours));
  else
    left_out.push_back({"speed limit MAXV", "none given"});
  if (!s.region) left_out.push_back({"computational box", "no BOXID"});
  world.passes.add(make_sph_energy(s, world, neighbours));
  return left_out;
}

}  // namespace courant
