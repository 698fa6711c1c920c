// *COURANT_WALL_SUPPORT with METHOD 2: where its ghosts are, and what cannot have any.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "loads/body_acceleration.hpp"
#include "model/conditions/prescribed_motion.hpp"
#include "sph/boundaries/boundary_cards.hpp"
#include "sph/walls/ghosts/wall_ghosts.hpp"
#include "sph/walls/wall_surface.hpp"

namespace courant {

namespace {

/// Against the body loads, of length 1; 0 where there are none at any time that is looked at.
Vec upwards(const Model& model, const BodyAcceleration& loads, const Vec& x, Index part) {
  for (const Real share : {0.0, 0.01, 0.1, 0.5, 1.0}) {
    const Vec g = loads(x, share * model.endtim, part);
    if (g.norm() > 0) return -g.normalized();
  }
  return Vec::Zero();
}

/// "part 3 (shells 17, 18 and 20 more)"
std::string shells_text(const Model& model, const World& world, const std::vector<Index>& segments) {
  constexpr std::size_t named = 2;
  std::map<Index, std::vector<Index>> of_part;
  for (const Index s : segments) of_part[world.segments.part[s]].push_back(s);
  std::string out;
  for (const auto& [part, mine] : of_part) {
    std::string shells;
    for (std::size_t k = 0; k < std::min(named, mine.size()); ++k)
      shells += fmt::format("{}{}", k > 0 ? ", " : "", world.segments.id[mine[k]]);
    if (mine.size() > named) shells += fmt::format(" and {} more", mine.size() - named);
    out += fmt::format("{}part {} (shells {})", out.empty() ? "" : ", ",
                       model.parts[static_cast<std::size_t>(part)].id, shells);
  }
  return out;
}

}  // namespace

std::shared_ptr<WallGhosts> build_wall_ghosts(const Deck& deck, const Model& model, const SphSettings& s,
                                              World& world, Diagnostics& diagnostics) {
  const std::vector<Index>& segments = s.walls.with_ghosts;
  const Particles& p = world.particles;
  if (segments.empty() || !diagnostics.ok()) return nullptr;
  const auto& card = *deck.last<CourantWallSupport>();
  std::vector<char> moves(static_cast<std::size_t>(world.segments.size()), 0);
  for (const Index segment : segments)
    moves[static_cast<std::size_t>(segment)] = segment_moves(world, segment);
  Index first = 0;
  while (first < p.size() && p.state[first] == particle_waiting) ++first;
  if (first == p.size()) {
    deck.error(diagnostics, card, "METHOD",
               "METHOD 2 finds the dry side of walls by the water that is there "
               "at the start, and there is none",
               "use METHOD 1, or let the scene start with some water");
    return nullptr;
  }
  const Vec x = p.x.vec(first);
  GhostLattice lattice;
  lattice.dim = s.dim;
  lattice.origin = s.dim == 2 ? Vec(x[0], x[1], 0) : x;
  lattice.spacing = std::pow(p.m[first] / p.rho[first], 1.0 / s.dim);
  lattice.reach = kernel_support(s.kernel) * p.h[first];
  lattice.planes = s.walls.planes;
  lattice.up = upwards(model, s.loads, x, p.part[first]);
  if (s.dim == 2) lattice.up[2] = 0;
  const LaidGhosts laid = lay_wall_ghosts(world, segments, moves, lattice);
  if (laid.too_large)
    deck.error(diagnostics, card, "METHOD",
               "METHOD 2 lays a lattice of the particles' spacing around the shells, which would have more "
               "than 5e8 points",
               "use METHOD 1, or name only shells near the water");
  if (!laid.wet_on_both_sides.empty())
    deck.error(diagnostics, card, "METHOD",
               "water can reach both sides of " + shells_text(model, world, laid.wet_on_both_sides) +
                   ": METHOD 2 cannot put ghost particles there",
               fmt::format("use METHOD 1 (wall_method: mirrors in a scene), or make the wall a closed body "
                           "at least {:.3g} thick; "
                           "a tank whose rim is below the highest water is wet outside, too",
                           lattice.reach));
  if (!laid.thin.empty())
    diagnostics.warning(deck.where(card),
                        fmt::format("*COURANT_WALL_SUPPORT: {} enclose less than the kernel's reach, "
                                    "{:.3g}: water acts through them",
                                    shells_text(model, world, laid.thin), lattice.reach),
                        "make the wall thicker, or use METHOD 1");
  if (!laid.open.empty())
    diagnostics.warning(
        deck.where(card),
        fmt::format("*COURANT_WALL_SUPPORT: {} moves and is not closed: METHOD 2 fills {:.3g} behind it "
                    "with ghost particles, which water that gets there meets",
                    shells_text(model, world, laid.open), lattice.reach),
        "fine for a piston with dry space behind it; let a gate be a METHOD 1 wall or a closed body");
  if (!laid.dry.empty())
    diagnostics.note(
        deck.where(card),
        fmt::format("*COURANT_WALL_SUPPORT: no water can reach {} at the start: no ghost particles "
                    "are there",
                    shells_text(model, world, laid.dry)));
  if (!diagnostics.ok()) return nullptr;
  std::vector<char> driven(model.parts.size(), 0);
  Diagnostics said;  // the builder of bodies reports it
  for (const PrescribedMotion& motion : prescribed_motions(deck, model, said))
    if (motion.part >= 0) driven[static_cast<std::size_t>(motion.part)] = 1;
  return std::make_shared<WallGhosts>(s, world, laid.ghosts, driven);
}

}  // namespace courant
