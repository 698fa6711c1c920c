#include "generate/basin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "generate/expression.hpp"

namespace courant {

namespace {

/// Filled like the keywords of a scene; the names are those of basin_variables().
constexpr const char* basin_cards = R"(*CONTROL_TERMINATION
$#  endtim    endcyc     dtmin    endeng    endmas     nosol
${end:10}         0         0         0     1.0e8         0
*CONTROL_TIMESTEP
$#  dtinit    tssfac
         0       0.9
*CONTROL_SPH
$#    ncbs     boxid        dt      idim
         1         0    1.0e20${dim:10}
$ Water: p = C1 (rho/RO - 1) with C1 = RO c0^2 of the sound speed c0 = ${c0}; PC is the largest tension
*MAT_NULL
$#     mid        ro        pc        mu
         1${rho0:10}${pc:10}         0
*EOS_LINEAR_POLYNOMIAL
$#   eosid        c0        c1        c2        c3        c4        c5        c6
         1         0${rho0 * c0^2:10}         0         0         0         0         0
$#      e0        v0
         0       1.0
*SECTION_SPH
$#   secid      cslh      hmin      hmax
         1       1.2       1.0       1.0
$ Artificial viscosity: Q1 is the quadratic coefficient, off, Q2 the linear one
*HOURGLASS
$#    hgid       ihq        qm       ibq        q1        q2
         1         0         0         0   1.0e-20${q:10}
*DATABASE_BINARY_D3PLOT
$#      dt
${output:10}
*DATABASE_GLSTAT
$#      dt
${output / 10:10}
*DATABASE_MATSUM
$#      dt
${output / 10:10}
)";

constexpr const char* gravity_cards =
    R"($ Gravity: LOAD_BODY gives the acceleration of the base, so +g pushes the water down
*LOAD_BODY_{}
$#    lcid        sf
         1       1.0
*DEFINE_CURVE
$#    lcid
         1
$#                a1                  o1
                 0.0${{g:20}}
${{10 * end + 1:20}}${{g:20}}
)";

/// A particle's contact stiffness is SLSFAC SFSA = 1 of that of the water itself, rho c^2; walls are stiffer.
constexpr const char* wall_cards =
    R"($ Walls: fixed rigid shells; contact acts at half their thickness, which particles half a spacing off just touch
*MAT_RIGID
$#     mid        ro         e        pr
         2${7.85 * rho0:10}${5e4 * rho0 * c0^2:10}       0.3
$#     cmo      con1      con2
         1         7         7
$#      a1        a2        a3        v1        v2        v3
         0         0         0         0         0         0
*SECTION_SHELL
$#   secid    elform      shrf       nip
         2         2       1.0         2
$#      t1        t2        t3        t4
${t:10}${t:10}${t:10}${t:10}
*CONTROL_CONTACT
$#  slsfac    rwpnal    islchk    shlthk    penopt    thkchg     orien
       0.1         0         1         0         1         0         1
*CONTACT_AUTOMATIC_NODES_TO_SURFACE_ID
$#     cid title
         1water against walls
$#   surfa     surfb  surfatyp  surfbtyp
         1        11         3         3
$#      fs        fd        dc        vc       vdc    penchk        bt        dt
         0         0         0         0         0         0         0    1.0e20
$#    sfsa      sfsb
        10${sfsb:10}
*DATABASE_RCFORC
$#      dt
${output / 10:10}
)";

constexpr Id water_part = 1, wall_part = 11;

int up_axis(const Basin& basin) {
  return basin.dim - 1;
}

Variables basin_variables(const Basin& b) {
  constexpr Real no_tension_limit = -1e20, just_touching = 0.9999;
  return {{"end", b.end},
          {"dim", b.dim},
          {"c0", b.sound_speed},
          {"rho0", b.density},
          {"pc", b.tension ? no_tension_limit : 0},
          {"q", std::max(b.viscosity, Real(1e-20))},  // 0 would be the default
          {"output", b.output},
          {"g", b.gravity},
          {"t", just_touching * b.spacing},
          {"sfsb", b.dim == 2 ? 1000 : 1}};  // in 2D walls are narrow strips
}

/// One side of the box: across `axis`, at `place` of it.
ScenePlate side_plate(const Basin& b, int axis, Real place, Real mesh) {
  ScenePlate plate;
  plate.origin = b.low;
  plate.origin[axis] = place;
  Vec edges[2] = {Vec::Zero(), Vec::Zero()};
  int k = 0;
  for (int other = 0; other < b.dim; ++other)
    if (other != axis) edges[k++][other] = b.high[other] - b.low[other];
  if (b.dim == 2) edges[1][2] = mesh, plate.origin[2] = -mesh / 2;  // one shell wide
  plate.edge1 = edges[0], plate.edge2 = edges[1];
  for (int e = 0; e < 2; ++e)
    plate.n[static_cast<std::size_t>(e)] =
        std::max<Id>(1, std::llround(std::ceil(edges[e].norm() / mesh - 1e-6)));
  return plate;
}

void add_walls(const Basin& b, Scene& scene) {
  ScenePart walls;
  walls.id = wall_part, walls.title = "walls", walls.section = 2, walls.material = 2, walls.merge = true;
  const Real mesh = b.dim == 2 ? b.spacing / 2 : 2 * b.spacing;
  const std::vector<std::string> sides = b.sides();
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const int axis = static_cast<int>(k / 2);
    if (b.open.count(sides[k]) == 0)
      walls.plates.push_back(side_plate(b, axis, (k % 2 == 0 ? b.low : b.high)[axis], mesh));
  }
  if (!walls.plates.empty()) scene.parts.push_back(std::move(walls));
}

}  // namespace

std::vector<std::string> Basin::sides() const {
  if (dim == 2) return {"left", "right", "bottom", "top"};
  return {"left", "right", "front", "back", "bottom", "top"};
}

std::string Basin::complete() {
  const int up = up_axis(*this);
  constexpr Real infinite = std::numeric_limits<Real>::infinity();
  Real bottom = has_box ? low[up] : infinite, top = -infinite;
  for (int k = 0; k < dim && has_box; ++k)
    if (!(high[k] > low[k])) return fmt::format("the box has no extent along {}", "xyz"[k]);
  for (const SceneLattice& block : water.lattices) {
    const Vec corner = block.low + block.spacing * Vec(Real(block.n[0]), Real(block.n[1]), Real(block.n[2]));
    bottom = std::min(bottom, block.low[up]), top = std::max(top, corner[up]);
    for (int k = 0; k < dim && has_box; ++k)
      if (block.low[k] < low[k] - 1e-6 * spacing || corner[k] > high[k] + 1e-6 * spacing)
        return fmt::format("a block reaches from {:g} to {:g} along {}, beyond the box from {:g} to {:g}",
                           block.low[k], corner[k], "xyz"[k], low[k], high[k]);
  }
  if (open.size() == sides().size()) return "a box with all sides open: leave it out";
  if (sound_speed > 0) return {};
  constexpr Real factor = 20;  // a blow squeezes the liquid by speed / sound speed
  const Real speed = std::sqrt(2 * gravity * (top - bottom) + water.velocity.squaredNorm());
  const bool varies = std::any_of(water.velocity_of_place.begin(), water.velocity_of_place.end(),
                                  [](const PlaceExpression& one) { return one.given(); });
  if (!(speed > 0) || varies)
    return "'sound_speed' is missing: it follows only from gravity and one velocity of all the water; give "
           "twenty times "
           "the largest speed";
  const Real digits = std::pow(10, std::floor(std::log10(factor * speed)) - 1);  // two of them
  sound_speed = std::ceil(factor * speed / digits - 1e-9) * digits;
  return {};
}

void add_basin(const Basin& basin, Scene& scene) {
  const Variables variables = basin_variables(basin);
  const auto add = [&](const std::string& cards) {
    scene.keywords.push_back(substitute(cards, variables).text);
  };
  ScenePart water = basin.water;
  water.id = water_part, water.title = "water",
  water.section = water.material = water.eos = water.hourglass = 1;
  scene.parts.push_back(std::move(water));
  add(basin_cards);
  if (basin.gravity > 0) add(fmt::format(gravity_cards, basin.dim == 2 ? 'Y' : 'Z'));
  if (!basin.has_box) return;
  add_walls(basin, scene);
  add(wall_cards);
}

}  // namespace courant
