// What *COURANT_WAVE_MAKER brings into a world.
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "extension/builders.hpp"
#include "keyword/registry.hpp"
#include "loads/body_acceleration.hpp"
#include "model/definitions/named_curve.hpp"
#include "parallel/parallel.hpp"
#include "sph/sph.hpp"
#include "waves/wave_maker.hpp"
#include "waves/wave_maker_cards.hpp"

namespace courant {

namespace {

const RegisterKeyword<WaveMakerCard> wave_maker_keyword{courant_wave_maker_table()};

class WaveMakerBuilder {
 public:
  WaveMakerBuilder(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                   const SphSettings& settings, std::shared_ptr<RigidBodies>& bodies,
                   const std::shared_ptr<Neighbours>& neighbours)
      : deck_(deck),
        model_(model),
        world_(world),
        diagnostics_(diagnostics),
        settings_(settings),
        bodies_(bodies),
        neighbours_(neighbours) {}

  void add(const WaveMakerCard& c) {
    const int before = diagnostics_.errors();
    WaveMakerSettings s;
    s.id = c.pid, s.paddle = paddle(c), s.sf = c.sf, s.drift = c.tdrift;
    read_curves(c, s);
    if (c.absorb > 0) read_absorption(c, s);
    const std::size_t body = body_of(c);
    if (diagnostics_.errors() > before) return;
    check_free(c, bodies_->bodies()[body], s.paddle);
    if (s.paddle.kind == Paddle::Kind::flap) check_flap(c, s.paddle);
    if (diagnostics_.errors() > before) return;
    world_.passes.add(make_wave_maker(std::move(s), bodies_, body, settings_.kernel, neighbours_));
  }

 private:
  void error(const WaveMakerCard& c, const char* field, std::string what, std::string hint) {
    deck_.error(diagnostics_, c, field, std::move(what), std::move(hint));
  }

  Paddle paddle(const WaveMakerCard& c) {
    Paddle p{.kind = c.kind == 1 ? Paddle::Kind::flap : Paddle::Kind::piston,
             .bed = Vec(c.x, c.y, world_.dim == 2 ? 0 : c.z),
             .up = world_.dim == 2 ? Vec(Vec::UnitY()) : Vec(Vec::UnitZ()),
             .depth = c.d,
             .hinge = c.hinge};
    const Vec along(c.vx, c.vy, world_.dim == 2 ? 0 : c.vz);
    constexpr Real level = 1e-6;  // sine
    if (!(along.norm() > 0))
      error(c, "VX", "the direction towards the water is 0", "1, 0, 0 for water towards larger x");
    else if (std::abs(along.normalized().dot(p.up)) > level)
      error(c, "VX",
            fmt::format("the direction has a part along {}, which is upwards", world_.dim == 2 ? "y" : "z"),
            "paddles move along a level bed");
    else
      p.along = along.normalized();
    if (p.kind == Paddle::Kind::piston && c.hinge != 0)
      error(c, "HINGE", "a piston has no hinge", "KIND 1 is a flap");
    if (p.kind == Paddle::Kind::flap && !(c.hinge < c.d))
      error(c, "HINGE",
            fmt::format("the hinge is {:g} above the bed, not below the still level {:g}", c.hinge, c.d),
            "a flap turns about a hinge in the water or below the bed");
    return p;
  }

  void read_curves(const WaveMakerCard& c, WaveMakerSettings& s) {
    if (c.lcid == 0 && c.absorb == 0)
      error(c, "LCID", "the paddle neither follows a curve nor absorbs", "give LCID or ABSORB");
    if (c.lceta != 0 && c.absorb == 0)
      error(c, "LCETA", "the elevation has no effect without ABSORB", "give ABSORB, or leave LCETA out");
    if (c.lcid != 0 && c.lceta == 0 && c.absorb > 0)
      error(c, "LCETA", "absorption takes the waves of the paddle itself for waves that come back",
            "give the elevation that LCID makes at the paddle");
    if (c.lcid != 0)
      if (const Curve* curve = curve_named(deck_, model_, c, "LCID", c.lcid, diagnostics_))
        s.displacement = *curve;
    if (c.lceta != 0)
      if (const Curve* curve = curve_named(deck_, model_, c, "LCETA", c.lceta, diagnostics_))
        s.elevation = *curve;
  }

  void read_absorption(const WaveMakerCard& c, WaveMakerSettings& s) {
    if (world_.particles.size() == 0)
      error(c, "ABSORB", "absorption measures particles, and the deck has none", "leave ABSORB out");
    Real g = c.g;
    if (g == 0) g = -acceleration_of_particles(model_).at(0).everywhere().dot(s.paddle.up);
    if (!(g > 0))
      return error(c, "G", "no body load at the start acts downwards", "give G, which absorption needs");
    constexpr Real least = 1e-12;
    s.g = g;
    s.gain = c.absorb * s.paddle.long_wave_gain(g);
    s.distance = distance(c);
    // a wave that comes back is at the level DIST/c before it is at the paddle
    s.filter = c.tau > 0 ? c.tau : s.distance / std::sqrt(g * c.d);
    s.most = c.xmax > 0 ? c.xmax : c.d;
    check_level(c, s);
    if (s.drift > 0 && s.drift * s.gain < 1 + least)
      deck_.warning(
          diagnostics_, c, "TDRIFT",
          fmt::format("drift goes back within {:g}, faster than absorption acts, {:g}", s.drift, 1 / s.gain),
          "a few periods of the waves leave absorption as it is");
  }

  /// A paddle within the kernel's reach cuts colours at and below the surface: alike where it is upright, but
  /// where it leans the level is too high or too low by that.
  Real distance(const WaveMakerCard& c) {
    const Particles& p = world_.particles;
    const Real h = p.size() > 0 ? maximum(p.size(), [&](Index i) { return p.h[i]; }) : 0;
    const Real least = c.kind == 1 ? kernel_support(settings_.kernel) * h : h;
    if (c.dist == 0) return least;
    constexpr Real round_off = 1e-6;  // of a deck's columns
    if (c.kind == 1 && c.dist < (1 - round_off) * least)
      deck_.warning(diagnostics_, c, "DIST",
                    fmt::format("the level is measured {:g} from the flap, within the {:g} that the kernel "
                                "reaches: an inclined flap changes it",
                                c.dist, least),
                    "leave DIST 0, or make it larger");
    return c.dist;
  }

  /// The water that the paddle would measure at the start.
  void check_level(const WaveMakerCard& c, const WaveMakerSettings& s) {
    const Particles& p = world_.particles;
    const Paddle& paddle = s.paddle;
    Real top = -std::numeric_limits<Real>::infinity(), spacing = 0;
    for (Index i = 0; i < p.size(); ++i) {
      Vec at = p.x.vec(i) - paddle.bed;
      if (world_.dim == 2) at.z() = 0;
      const Real along = at.dot(paddle.along) - s.distance, aside = at.dot(paddle.axis());
      if (std::max(std::abs(along), std::abs(aside)) > p.h[i]) continue;
      const Real V = p.m[i] / p.rho[i], dx = world_.dim == 2 ? std::sqrt(V) : std::cbrt(V);
      top = std::max(top, at.dot(paddle.up) + 0.5 * dx), spacing = std::max(spacing, dx);
    }
    if (spacing == 0)
      return error(c, "DIST",
                   fmt::format("there is no water {:g} in front of the paddle, where it measures the level",
                               s.distance),
                   "check X, Y, Z, the direction VX, VY, VZ and DIST");
    constexpr Real some = 1.5;  // spacings
    if (std::abs(top - c.d) > some * spacing)
      deck_.warning(diagnostics_, c, "D",
                    fmt::format("the water at the paddle is {:.4g} deep at the start, D is {:g}: absorption "
                                "moves the paddle until they are equal",
                                top, c.d),
                    "D is the depth of the still water above X, Y, Z");
  }

  std::size_t body_of(const WaveMakerCard& c) {
    if (bodies_)
      for (std::size_t k = 0; k < bodies_->bodies().size(); ++k) {
        const RigidBody& body = bodies_->bodies()[k];
        if (body.part != c.pid) continue;
        if (!body.motions.empty())
          error(c, "PID", fmt::format("the motion of {} is prescribed already", body.name),
                "leave out its *BOUNDARY_PRESCRIBED_MOTION_RIGID or the other wave maker");
        return k;
      }
    error(c, "PID", fmt::format("part {} is no rigid body", c.pid), "it needs elements and a *MAT_RIGID");
    return 0;
  }

  /// What turns about the hinge is above it: below, it would move in the other direction, which no theory of
  /// flaps has.
  void check_flap(const WaveMakerCard& c, const Paddle& p) {
    Real lowest = std::numeric_limits<Real>::infinity();
    for (Index s = 0; s < world_.segments.size(); ++s) {
      if (model_.parts[static_cast<std::size_t>(world_.segments.part[s])].id != c.pid) continue;
      for (const Index n : world_.segments.nodes(s))
        lowest = std::min(lowest, (world_.nodes.x.vec(n) - p.bed).dot(p.up));
    }
    constexpr Real some = 0.01;  // of the depth
    if (c.hinge > 0 && lowest < c.hinge - some * c.d)
      error(c, "HINGE",
            fmt::format(
                "the paddle begins {:g} above the bed, below its hinge at {:g}, and would turn the other "
                "direction there",
                lowest, c.hinge),
            "let the paddle begin at the hinge, above a wall that is held");
  }

  void check_free(const WaveMakerCard& c, const RigidBody& body, const Paddle& p) {
    Vec moves = p.along.cwiseAbs(), turns = Vec::Zero();
    if (p.kind == Paddle::Kind::flap) moves += p.up.cwiseAbs(), turns = p.axis().cwiseAbs();
    constexpr Real some = 1e-9;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const auto n = static_cast<std::size_t>(k);
      if ((moves[k] > some && body.held[n]) || (turns[k] > some && body.no_turn[n]))
        return error(
            c, "PID",
            fmt::format("{} cannot {} {}, as CON1 or CON2 of its *MAT_RIGID, or the plane of a 2D "
                        "scene, holds it",
                        body.name, moves[k] > some && body.held[n] ? "move along" : "turn about", "xyz"[n]),
            "free the directions in which the paddle moves; the wave maker holds all others");
    }
  }

  const Deck& deck_;
  const Model& model_;
  World& world_;
  Diagnostics& diagnostics_;
  const SphSettings& settings_;
  std::shared_ptr<RigidBodies>& bodies_;
  std::shared_ptr<Neighbours> neighbours_;
};

void build_wave_makers(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                       const SphSettings& settings, std::shared_ptr<RigidBodies>& bodies,
                       const std::shared_ptr<Neighbours>& neighbours) {
  WaveMakerBuilder builder(deck, model, world, diagnostics, settings, bodies, neighbours);
  for (const WaveMakerCard& card : deck.all<WaveMakerCard>()) builder.add(card);
}

const RegisterBuilder wave_makers(BuildPhase::body_passes, "wave makers", build_wave_makers);

}  // namespace

}  // namespace courant
