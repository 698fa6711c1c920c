#include "app/check/scene_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "contact/cards.hpp"
#include "model/mesh/named_parts.hpp"
#include "output/summary.hpp"
#include "rigid/switches/switch_cards.hpp"
#include "sph/inlets/injection.hpp"

namespace courant {
namespace {

constexpr Real infinite = std::numeric_limits<Real>::infinity();

/// Both sides of a contact: parts, or of a set of particles its id.
struct Sides {
  std::set<Index> particles;
  Id particle_set = 0;
  std::set<Index> walls;
  bool operator==(const Sides& other) const {
    return particles == other.particles && particle_set == other.particle_set && walls == other.walls;
  }
};

class SceneWarnings {
 public:
  SceneWarnings(const Simulation& simulation, Diagnostics& diagnostics)
      : s_(simulation), p_(s_.world().particles), diagnostics_(diagnostics) {}

  void all() {
    if (p_.size() == 0) return;
    contacts();
    walls();
    for (std::size_t k = 0; k < s_.model().parts.size(); ++k) {
      if (!(s_.sph().usual_spacing[k] > 0) || !std::isfinite(s_.sph().usual_spacing[k])) continue;
      const std::vector<Index> members = members_of(k);
      if (members.size() < least_members) continue;
      spacing(k, members);
      neighbours(k, members);
      compression(k, members);
      if (!flows_in(k)) masses(k, members);
    }
    plane();
  }

 private:
  static constexpr std::size_t least_members = 8;  ///< fewer have no inside
  static constexpr Real least_of_enclosed = 0.2;   ///< pressure, of the largest; at a free surface it is 0

  void warn_of_part(std::size_t part, const std::string& what, std::string hint) {
    const ModelPart& p = s_.model().parts[part];
    diagnostics_.warning(p.where, fmt::format("*PART {}: {}", p.id, what), std::move(hint));
  }

  std::vector<Index> members_of(std::size_t part) const {
    std::vector<Index> out;
    for (Index i = 0; i < p_.size(); ++i)
      if (p_.part[i] == static_cast<Index>(part)) out.push_back(i);
    return out;
  }

  // --- contacts and walls

  Sides sides_of(const ContactCard& c) const {
    Sides out;
    Diagnostics told_before;
    const auto parts = [&](const char* field, Id id, int type) {
      const std::vector<Index> named = parts_named(s_.deck(), s_.model(), c, field, id, type, told_before);
      return std::set<Index>(named.begin(), named.end());
    };
    constexpr int node_set = 4, all = 5;
    if (c.surfatyp == node_set)
      out.particle_set = c.surfa;
    else if (c.surfatyp == all)
      for (std::size_t k = 0; k < s_.model().parts.size(); ++k) {
        if (s_.model().parts[k].has_sph) out.particles.insert(static_cast<Index>(k));
      }
    else
      out.particles = parts("SURFA", c.surfa, c.surfatyp);
    out.walls = parts("SURFB", c.surfb, c.surfbtyp);
    return out;
  }

  void contacts() {
    const auto& cards = s_.deck().all<ContactCard>();
    std::vector<Sides> sides;
    for (const ContactCard& card : cards) {
      sides.push_back(sides_of(card));
      if (kind_of(card).nodes) met_.insert(sides.back().walls.begin(), sides.back().walls.end());
      if (kind_of(card).nodes && (card.fs > 0 || card.fd > 0)) contact_on_belts(card, sides.back().walls);
      if (kind_of(card).nodes && &card == &cards.front()) diffusion_under_pressure(card);
      for (std::size_t k = 0; k + 1 < sides.size(); ++k) {
        const bool apart = cards[k].dt <= card.bt || card.dt <= cards[k].bt;
        if (apart || !(sides[k] == sides.back())) continue;
        diagnostics_.warning(
            s_.deck().where(card),
            fmt::format("{}: the same particles and walls as the contact at {}: they push twice",
                        s_.deck().keyword(card), s_.deck().place(cards[k])),
            "leave out one of them");
        break;
      }
    }
  }

  void contact_on_belts(const ContactCard& card, const std::set<Index>& walls) {
    const SupportedWalls& w = s_.sph().walls;
    for (const Index segment : w.segments)
      if (const Index part = s_.world().segments.part[segment]; w.belts.of(segment) >= 0 && walls.count(part))
        return diagnostics_.warning(
            s_.deck().where(card),
            fmt::format(
                "{}: friction FS, FD of the contact takes the shells of part {} as they stand, and not "
                "the surface of *COURANT_WALL_BELT",
                s_.deck().keyword(card), s_.model().parts[static_cast<std::size_t>(part)].id),
            "leave FS and FD 0, and let *COURANT_WALL_SUPPORT rub");
  }

  /// Kernels end at shells that have no *COURANT_WALL_SUPPORT. Rows of particles there hold other pressures
  /// than the rest, which diffusion evens out again and again: a closed ring loses half of its pressure while
  /// sound crosses it five times (docs/study_fluid_structure.md). With a free surface the pressure follows
  /// the depth.
  void diffusion_under_pressure(const ContactCard& card) {
    if (!(s_.sph().density_diffusion > 0) || !s_.sph().walls.segments.empty()) return;
    const auto [least, most] = std::minmax_element(p_.p.data(), p_.p.data() + p_.active);
    if (!(*least > least_of_enclosed * *most)) return;
    diagnostics_.warning(
        s_.deck().where(card),
        fmt::format("{}: all particles begin under pressure, {:.3g} at least: water enclosed by "
                    "shells or solids loses it by density diffusion",
                    s_.deck().keyword(card), *least),
        "remove *COURANT_DENSITY_DIFFUSION, or support rigid walls by *COURANT_WALL_SUPPORT");
  }

  void walls() {
    const Segments& g = s_.world().segments;
    std::set<Index> supported;
    for (const Index segment : s_.sph().walls.segments) supported.insert(g.part[segment]);
    std::vector<char> crosses(s_.model().parts.size(), 0), moves = crosses;
    const Real z = p_.x.vec(0)[2];
    for (Index k = 0; k < g.size(); ++k) {
      Real low = infinite, high = -infinite;
      for (const Index n : g.nodes(k)) {
        low = std::min(low, s_.world().nodes.x.vec(n)[2]);
        high = std::max(high, s_.world().nodes.x.vec(n)[2]);
        if (!s_.world().nodes.held[n]) moves[static_cast<std::size_t>(g.part[k])] = 1;
      }
      if (low < high && low <= z && z <= high) crosses[static_cast<std::size_t>(g.part[k])] = 1;
    }
    for (std::size_t k = 0; k < crosses.size(); ++k) {
      if (!s_.model().parts[k].has_shell) continue;
      const bool held_off = met_.contains(static_cast<Index>(k));
      const bool met = held_off || supported.contains(static_cast<Index>(k));
      if (!held_off && (met || !moves[k]))  // what moves may do so for its own sake
        warn_of_part(k,
                     met ? "no contact names these shells: *COURANT_WALL_SUPPORT completes sums there, and "
                           "does not stop particles"
                         : "no contact names these shells, so particles go through them",
                     "name the part as SURFB of a *CONTACT_AUTOMATIC_NODES_TO_SURFACE");
      if (met && s_.world().dim == 2 && !crosses[k])
        warn_of_part(
            k,
            fmt::format("none of the shells reaches through the plane of the particles, z = {:g}: in "
                        "2D they are no wall",
                        z),
            "walls of a 2D scene are normal to the plane, with nodes on both sides of it");
    }
  }

  // --- particles

  /// What the verdict would doubt at once: a sound speed too low for the pressure at the start.
  void compression(std::size_t part, const std::vector<Index>& members) {
    const Ranges& ranges = s_.guard().ranges();
    if (part >= ranges.size() || ranges[part].stiffness_field.empty()) return;
    const PartRange& range = ranges[part];
    Real most = 0;
    for (const Index i : members) most = std::max(most, p_.rho[i] / range.rho0);
    if (most <= 1 + VerdictLimits().density_doubtful) return;
    warn_of_part(part,
                 fmt::format("the liquid begins compressed to {:.3g} times RO: its sound speed {:.4g} is too "
                             "low for the pressure there",
                             most, range.c0),
                 fmt::format("raise {}: a sound speed of ten times the largest expected speed, sqrt(2 g H) "
                             "for instance",
                             range.stiffness_field));
  }

  /// An inlet makes the masses itself.
  bool flows_in(std::size_t part) const {
    const auto& inlets = s_.get<Injections>().inlets;
    return std::any_of(inlets.begin(), inlets.end(),
                       [part](const Injection& inlet) { return inlet.part == static_cast<Index>(part); });
  }

  void spacing(std::size_t part, const std::vector<Index>& members) {
    const Real dx = s_.sph().usual_spacing[part];
    Real farthest = 0;
    for (const Index i : members) farthest = std::max(farthest, p_.x.vec(i).cwiseAbs().maxCoeff());
    constexpr Real least = 1e-12, most = 1e9;  // of any units in use
    if (dx < least || dx > most)
      warn_of_part(part, fmt::format("the particles are {:.4g} [L] apart", dx),
                   "is the unit of length that of the other numbers of the deck?");
    else if (farthest > most * dx)
      warn_of_part(part,
                   fmt::format("coordinates are up to {:.4g} [L], and the particles {:.4g} apart: rounding "
                               "spoils their distances",
                               farthest, dx),
                   "move the scene near the origin");
  }

  void neighbours(std::size_t part, const std::vector<Index>& members) {
    const Real dx = s_.sph().usual_spacing[part], h = p_.h[members.front()];
    const Real reach = kernel_support(s_.sph().kernel) * h;
    const Real diagonal = std::sqrt(Real(2));  // of a square: a lattice with less has only the nearest ones
    if (reach >= diagonal * dx) return;
    warn_of_part(part,
                 fmt::format("particles reach {:.4g} [L], and are {:.4g} apart: they have {}", reach, dx,
                             reach <= dx ? "no neighbours" : "too few neighbours"),
                 "CSLH of *SECTION_SPH is usually 1.2; SPHINI replaces it where it is given");
  }

  /// Sum of the kernel over the neighbours of a particle times its volume: 1 inside of a body.
  Real filling(Index i) const {
    const Real h = p_.h[i], reach = kernel_support(s_.sph().kernel) * h;
    const Vec x = p_.x.vec(i);
    return with_kernel(s_.sph().kernel, [&](auto kernel) {
      Real sum = 0;
      for (Index j = 0; j < p_.size(); ++j) {
        const Real r = (p_.x.vec(j) - x).norm();
        if (r < reach) sum += kernel.shape(r / h);
      }
      return sum * decltype(kernel)::C(s_.world().dim) / std::pow(h, s_.world().dim) * p_.m[i] / p_.rho[i];
    });
  }

  /// By the distance between neighbours, and, since that of particles in disorder is smaller, by the sums of
  /// the kernel: both must tell the same.
  void masses(std::size_t part, const std::vector<Index>& members) {
    constexpr Real most = 1.5;
    constexpr std::size_t samples = 40;
    const Index first = members.front();
    const Real volume = std::pow(s_.sph().usual_spacing[part], s_.world().dim);
    const Real mass = p_.rho[first] * volume, ratio = p_.m[first] / mass;
    if (ratio < most && ratio > 1 / most) return;
    Real fullest = 0;
    for (std::size_t k = 0; k < samples; ++k)
      fullest = std::max(fullest, filling(members[k * (members.size() - 1) / (samples - 1)]));
    if (ratio > 1 ? fullest < most : fullest > 1 / most) return;
    warn_of_part(
        part,
        fmt::format("particle {} has the mass {:.4g} [M], and its density times the spacing {:.4g} to the "
                    "power {} gives {:.4g}",
                    p_.id[first], p_.m[first], s_.sph().usual_spacing[part], s_.world().dim, mass),
        masses_hint(ratio));
  }

  /// Factors of a thousand are those between units: RO = 1e-9 are tonnes in a cubic mm, of which a kg is not
  /// one.
  static std::string masses_hint(Real ratio) {
    const Real thousands = std::log10(ratio) / 3;
    constexpr Real near = 0.06;  // some 50 % of the mass
    if (std::abs(thousands) > 0.5 && std::abs(thousands - std::round(thousands)) < near)
      return fmt::format(
          "a factor of 1e{:.0f} looks like another unit: with lengths in mm, RO of water is 1e-9 where "
          "masses are in "
          "tonnes, 1e-6 in kg, 1e-3 in g; type MASS / 1e{:.0f}, or RO x 1e{:.0f}",
          3 * std::round(thousands), 3 * std::round(thousands), 3 * std::round(thousands));
    return "correct MASS of *ELEMENT_SPH (in 2D per unit of depth), or RO of the material";
  }

  void plane() {
    if (s_.world().dim != 3 || p_.size() < static_cast<Index>(least_members)) return;
    Vec low = p_.x.vec(0), high = low;
    for (Index i = 1; i < p_.size(); ++i) low = low.cwiseMin(p_.x.vec(i)), high = high.cwiseMax(p_.x.vec(i));
    const Vec size = high - low;
    const std::vector<GhostPlane>& planes = s_.sph().walls.planes;
    for (int k = 0; k < 3; ++k) {
      const bool others = size[(k + 1) % 3] > 0 && size[(k + 2) % 3] > 0;
      const bool images = std::any_of(planes.begin(), planes.end(), [&](const GhostPlane& plane) {
        return std::abs(plane.normal[k]) > 0.5;
      });
      if (size[k] > 0 || !others || images) continue;
      diagnostics_.warning({s_.deck().files[0].name},
                           fmt::format("all particles are in one plane, {} = {:g}, and the scene is one of "
                                       "three dimensions",
                                       "xyz"[k], low[k]),
                           "give IDIM 2 of *CONTROL_SPH, with the particles in a plane z = constant");
    }
  }

  const Simulation& s_;
  const Particles& p_;
  Diagnostics& diagnostics_;
  std::set<Index> met_;  ///< parts of walls that particles may meet
};

}  // namespace

void warn_of_scene(const Simulation& simulation, Diagnostics& diagnostics) {
  if (!simulation.world().goes_on) warn_of_switch_at_restart(simulation.deck(), diagnostics);
  SceneWarnings(simulation, diagnostics).all();
}

}  // namespace courant
