// `courant check`: what walls of *COURANT_WALL_SUPPORT do to the water beside them.
#include <fmt/format.h>
#include <map>
#include <set>

#include "app/check/check.hpp"
#include "sph/walls/wall_surface.hpp"

namespace courant {

namespace {

/// What a hydraulic engineer chooses, for whom it is of use.
constexpr const char* smooth_hint =
    "    water slips; beds and banks: LAW 1 with their roughness KS (concrete 0.3 to 3 mm, gravel about\n"
    "    2 d90), glass KS 0; LAW 2 where rows resolve the viscous layer\n";

/// Of mirrors of bodies in space: their edges leave no closed form of the images.
constexpr const char* dear_hint =
    "    some 100 us per particle and step near edges of parts that move in space; METHOD 2, wall_method:\n"
    "    ghosts of a scene, takes some 3 us there: for calm water, positions within half a spacing\n";

std::string what_it_does(const WallFriction& wall) {
  if (wall.no_slip) return "no slip (LAW 2)";
  if (wall.log_law)
    return wall.ks > 0 ? fmt::format("rough, KS {:g} [L] (LAW 1)", wall.ks)
                       : std::string("hydraulically smooth (LAW 1, KS 0)");
  return wall.cf > 0 ? fmt::format("friction CF {:g} (LAW 0)", wall.cf) : std::string("smooth (LAW 0, CF 0)");
}

}  // namespace

std::string walls_text(const Simulation& s) {
  const SupportedWalls& walls = s.sph().walls;
  if (walls.segments.empty()) return {};
  std::map<Id, std::set<std::string>> parts;
  bool slips = false, moves = false;
  for (const Index segment : walls.segments) {
    const WallFriction& wall = walls.friction[static_cast<std::size_t>(segment)];
    std::string line = what_it_does(wall);
    if (const int belt = walls.belts.of(segment); belt >= 0) {
      const WallMotion& m = walls.belts.belts[static_cast<std::size_t>(belt)].motion;
      line += m.omega.isZero(0)
                  ? fmt::format(", a surface moving at {:g} [L/T] at factor 1", m.v.norm())
                  : fmt::format(", a surface rotating at {:g} [1/T] at factor 1", m.omega.norm());
    }
    slips |= !wall.no_slip && !wall.rubs();
    moves |= segment_moves(s.world(), segment);
    const auto part = static_cast<std::size_t>(s.world().segments.part[segment]);
    parts[s.model().parts[part].id].insert(line);
  }
  std::string out = fmt::format("Walls beside the particles, {} (METHOD {})\n",
                                walls.images ? "mirrors" : "integrals over shells", walls.images ? 1 : 0);
  for (const auto& [id, lines] : parts)
    for (const std::string& line : lines) out += fmt::format("  part {}: {}\n", id, line);
  if (walls.images && moves && s.world().dim == 3) out += dear_hint;
  return slips ? out + smooth_hint : out;
}

}  // namespace courant
