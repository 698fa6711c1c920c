// *BOUNDARY_SPH_SYMMETRY_PLANE and *BOUNDARY_SPH_PERIODIC: planes behind which particles have ghosts.
#include <cmath>
#include <optional>
#include <tuple>

#include <fmt/format.h>

#include "keyword/registry.hpp"
#include "search/nearest_distance.hpp"
#include "sph/boundaries/boundary_cards.hpp"
#include "sph/sph.hpp"

namespace courant {

namespace {

const RegisterKeyword<BoundarySphSymmetryPlane> symmetry_keyword{boundary_sph_symmetry_plane_table()};
const RegisterKeyword<BoundarySphPeriodic> periodic_keyword{boundary_sph_periodic_table()};

class PlaneBuilder {
 public:
  PlaneBuilder(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics)
      : deck_(deck), model_(model), world_(world), diagnostics_(diagnostics) {}

  std::vector<GhostPlane> build(const SphSettings& settings, Real reach) {
    for (const auto& card : deck_.all<BoundarySphSymmetryPlane>()) add_mirror(card);
    for (const auto& card : deck_.all<BoundarySphPeriodic>()) {
      add_periodic(card);
      if (settings.region) check_box(*settings.region, card);
    }
    if (diagnostics_.ok()) check_together(reach);
    if (diagnostics_.ok()) check_particles(settings.region ? &*settings.region : nullptr);
    return planes_;
  }

 private:
  void add_mirror(const BoundarySphSymmetryPlane& c) {
    const Vec tail(c.vtx, c.vty, c.vtz), head(c.vhx, c.vhy, c.vhz);
    if (!normal_is_good(c, tail, head)) return;
    add({GhostPlane::Kind::mirror, tail, (head - tail).normalized(), 0}, c);
  }

  void add_periodic(const BoundarySphPeriodic& c) {
    const auto first = model_.vectors.find(c.vid1), second = model_.vectors.find(c.vid2);
    for (const auto& [found, field, id] : {std::tuple{first, "VID1", c.vid1}, {second, "VID2", c.vid2}}) {
      if (found == model_.vectors.end())
        return deck_.error(diagnostics_, c, field, fmt::format("vector {} does not exist", id),
                           "define it with *DEFINE_VECTOR");
      if (found->second.moves)
        return deck_.error(diagnostics_, c, field, fmt::format("vector {} moves with nodes", id),
                           "give the plane by *DEFINE_VECTOR");
      if (!normal_is_good(c, found->second.tail, found->second.head)) return;
    }
    const Vec n = (first->second.head - first->second.tail).normalized(),
              other = (second->second.head - second->second.tail).normalized();
    const Real period = (second->second.tail - first->second.tail).dot(n);
    if ((n + other).norm() > parallel || !(period > 0))
      return deck_.error(diagnostics_, c, "VID2",
                         "the planes of VID1 and VID2 do not face each other: expected vectors in opposite "
                         "directions, each from its plane towards the other",
                         "*DEFINE_VECTOR: tail on the plane, head inside");
    add({GhostPlane::Kind::periodic, first->second.tail, n, period}, c);
  }

  /// The computational box must hold both planes: what leaves it leaves the run, and would not come back.
  void check_box(const Region& box, const BoundarySphPeriodic& c) {
    if (planes_.empty() || cards_.back() != &c) return;  // the card was refused
    const GhostPlane& plane = planes_.back();
    const Real slack = rounding_of_decks * plane.period;
    for (int k = 0; k < world_.dim; ++k) {
      const bool across = std::abs(plane.normal[k]) > parallel,
                 along = std::abs(plane.normal[k]) > 1 - parallel;
      const Real a = plane.point[k], b = a + plane.period * plane.normal[k];
      if (!across || (along && box.low[k] <= std::min(a, b) + slack && box.high[k] >= std::max(a, b) - slack))
        continue;
      diagnostics_.error(
          deck_.where(c),
          along
              ? fmt::format("{}: the computational box (BOXID of *CONTROL_SPH) ends between the planes, {:g} "
                            "to {:g} along {}",
                            deck_.keyword(c), box.low[k], box.high[k], "xyz"[k])
              : fmt::format(
                    "{}: beside a computational box (BOXID of *CONTROL_SPH) the planes must be at right "
                    "angles to an axis",
                    deck_.keyword(c)),
          along ? "let it reach over both planes" : "turn the scene, or leave BOXID blank");
      return;
    }
  }

  /// What comes into the box later, from an inlet or from where nothing is solved, must not have come through
  /// the planes before: when it is there follows from its straight path.
  void check_arrivals(std::size_t k, const Region* box) {
    constexpr Real anywhere = 1e300;
    const Particles& p = world_.particles;
    const Vec& normal = planes_[k].normal;
    std::optional<Region> between;  // the box, but across the planes
    if (box) between = *box;
    for (int c = 0; box && c < 3; ++c)
      if (std::abs(normal[c]) > parallel) between->low[c] = -anywhere, between->high[c] = anywhere;
    for (Index i = 0; i < p.size(); ++i) {
      const Vec x = p.x.vec(i), v = p.v.vec(i);
      const bool waits = p.state[i] == particle_waiting ||
                         (box && box->time_to_reach(x, v, 0) != between->time_to_reach(x, v, 0));
      if (!waits || std::abs(v.dot(normal)) <= parallel * v.norm()) continue;
      diagnostics_.error(
          deck_.where(model_.sph[i].card),
          fmt::format(
              "{}: the velocity of particle {}, which is not yet solved for, leads through the planes "
              "of {}",
              deck_.keyword(model_.sph[i].card), p.id[i], place(*cards_[k])),
          "beside periodic planes water must come in along them");
      return;
    }
  }

  bool normal_is_good(const Entry& card, const Vec& tail, const Vec& head) {
    const Vec n = head - tail;
    const bool in_plane = world_.dim == 3 || std::abs(n[2]) <= parallel * n.norm();
    if (n.norm() > 0 && in_plane) return true;
    diagnostics_.error(deck_.where(card),
                       fmt::format("{}: {}", deck_.keyword(card),
                                   in_plane ? "tail and head of the vector are the same point"
                                            : "in 2D the plane must be normal to the plane of the particles: "
                                              "the vector points out of it"),
                       "give a vector from a point on the plane into the material");
    return false;
  }

  std::string place(const Entry& card) const {
    const Location at = deck_.where(card);
    return fmt::format("{}:{}", at.file, at.line);
  }

  void add(GhostPlane plane, const Entry& card) {
    planes_.push_back(std::move(plane));
    cards_.push_back(&card);
  }

  void check_together(Real reach) {
    for (std::size_t a = 0; a < planes_.size(); ++a) {
      if (planes_[a].period > 0 && planes_[a].period < reach) report_narrow(a, planes_[a].period, reach);
      for (std::size_t b = 0; b < a; ++b) check_pair(a, b, reach);
    }
  }

  void check_pair(std::size_t a, std::size_t b, Real reach) {
    const Real cosine = planes_[a].normal.dot(planes_[b].normal);
    if (std::abs(cosine) <= parallel) return;
    const Real apart = std::abs((planes_[a].point - planes_[b].point).dot(planes_[a].normal));
    const bool mirrors = planes_[a].period == 0 && planes_[b].period == 0;
    if (std::abs(cosine + 1) <= parallel && mirrors) {
      if (apart < reach) report_narrow(a, apart, reach);
      return;
    }
    diagnostics_.error(deck_.where(*cards_[a]),
                       fmt::format("{}: the plane is neither normal to that of {} nor opposite to it",
                                   deck_.keyword(*cards_[a]), place(*cards_[b])),
                       "planes with ghost particles must be at right angles, or face each other");
  }

  void report_narrow(std::size_t a, Real apart, Real reach) {
    diagnostics_.error(deck_.where(*cards_[a]),
                       fmt::format("{}: the planes are {:.4g} [L] apart; particles reach {:.4g}, and would "
                                   "see ghost particles twice",
                                   deck_.keyword(*cards_[a]), apart, reach),
                       "make the domain wider or h smaller");
  }

  void check_particles(const Region* box) {
    const Particles& p = world_.particles;
    for (std::size_t k = 0; k < planes_.size(); ++k) {
      if (planes_[k].period > 0) {
        check_arrivals(k, box);
        wrap(k);
      }
      for (Index i = 0; i < p.size(); ++i) {
        const Real d = (p.x.vec(i) - planes_[k].point).dot(planes_[k].normal);
        if (d >= 0 && (planes_[k].period == 0 || d < planes_[k].period)) continue;
        diagnostics_.error(
            deck_.where(model_.sph[i].card),
            fmt::format("{}: particle {} is behind the {}plane of {}", deck_.keyword(model_.sph[i].card),
                        p.id[i], d < 0 ? "" : "second ", place(*cards_[k])),
            d < 0 ? "the vector of the plane points into the material"
                  : fmt::format("the second plane is {:.6g} [L] from the first, the particle "
                                "{:.6g}: move the plane, or the particle",
                                planes_[k].period, d));
        break;
      }
    }
  }

  /// Lattices that end on both planes count each particle there twice.
  void wrap(std::size_t k) {
    Particles& p = world_.particles;
    const GhostPlane& plane = planes_[k];
    std::vector<Index> wrapped;
    for (Index i = 0; i < p.size(); ++i) {
      const Real d = (p.x.vec(i) - plane.point).dot(plane.normal);
      const Real rounding = rounding_of_decks * plane.period;
      if (std::abs(d - plane.period) > rounding && !(d < 0 && d > -rounding)) continue;
      const Vec before = p.x.vec(i);
      Vec x = before - d * plane.normal;
      for (Real push = 1e-16 * plane.period; (x - plane.point).dot(plane.normal) < 0; push *= 2)
        x = before - (d - push) * plane.normal;  // round-off must not leave it behind the plane
      p.x.set(i, x);
      wrapped.push_back(i);
    }
    if (wrapped.empty()) return;
    const std::vector<Real> nearest = nearest_distance(p.x.data(0), p.x.data(1), p.x.data(2), p.size());
    for (const Index i : wrapped) {
      if (nearest[i] > rounding_of_decks * plane.period) continue;
      diagnostics_.error(deck_.where(model_.sph[i].card),
                         fmt::format("{}: particle {} is on a plane of {}, which is the same position as "
                                     "the other one, where another particle is",
                                     deck_.keyword(model_.sph[i].card), p.id[i], place(*cards_[k])),
                         "leave out the particles on one of the two planes");
      return;
    }
  }

  static constexpr Real parallel = 1e-9;
  static constexpr Real rounding_of_decks = 1e-6;  ///< of a period
  const Deck& deck_;
  const Model& model_;
  World& world_;
  Diagnostics& diagnostics_;
  std::vector<GhostPlane> planes_;
  std::vector<const Entry*> cards_;
};

}  // namespace

std::vector<GhostPlane> build_ghost_planes(const Deck& deck, const Model& model, const SphSettings& settings,
                                           Real reach, World& world, Diagnostics& diagnostics) {
  return PlaneBuilder(deck, model, world, diagnostics).build(settings, reach);
}

}  // namespace courant
