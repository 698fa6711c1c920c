// *BOUNDARY_NON_REFLECTING.
#include "loads/non_reflecting.hpp"
#include "loads/load_cards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "keyword/registry.hpp"
#include "loads/middle_velocity.hpp"
#include "parallel/parallel.hpp"

namespace courant {

namespace {

using NR = NonReflecting;

const RegisterKeyword<NR> boundary_non_reflecting{boundary_non_reflecting_table()};

/// f -= C v with the v of the middle of the kick, as of damping by mass: f becomes (1 + dt/2m C)^-1 (f - C
/// v), which damps at any step. Lysmer & Kuhlemeyer 1969.
class WaveDampers : public Constraint, public EnergyTerm {
 public:
  /// `damping`: of each node of the world [M/T]
  WaveDampers(const std::map<Index, Matrix>& damping, World& world)
      : points_(points_of(world.nodes)),
        driven_(points_),
        at_(static_cast<std::size_t>(world.nodes.size()), -1) {
    for (const auto& [n, C] : damping) {
      at_[static_cast<std::size_t>(n)] = static_cast<Index>(nodes_.size());
      nodes_.push_back(n), damping_.push_back(C);
    }
    force_.resize(nodes_.size(), Vec::Zero());
  }
  std::string name() const override { return "boundaries that do not reflect"; }
  const FieldSet& over(const World&) const override { return points_.fields(); }
  void declare(const World&, Accesses& a) const override {
    a.reads(*points_.v).reads(*points_.m).revises(*points_.f);
    driven_.declare(a);
  }
  void start(World&, const Clock& clock) override { half_ = 0.5 * clock.dt_old; }
  void block(World&, const Clock&, Index begin, Index end) override {
    for (Index n = begin; n < end; ++n) {
      if (at_[static_cast<std::size_t>(n)] < 0) continue;
      const auto k = static_cast<std::size_t>(at_[static_cast<std::size_t>(n)]);
      force_[k].setZero();
      const Matrix& C = damping_[k];
      const Vec v = points_.v->vec(n), f = points_.f->vec(n);
      const Matrix more = Matrix::Identity() + half_ / (*points_.m)[n] * C;
      const Vec after = more.inverse() * (f - C * v);
      force_[k] = driven_.across(n, after - f);
      points_.f->set(n, f + force_[k]);
    }
  }
  void record(World&, const Clock& clock, EnergyLedger& ledger) override {
    const MiddleVelocity v(points_, clock);
    Real lost = 0;
    for (std::size_t k = 0; k < nodes_.size(); ++k) lost -= force_[k].dot(v(nodes_[k])) * clock.dt_mean();
    ledger.dissipated += lost;
    ledger.throughput += std::abs(lost);
  }
  void sample(const World&, const Clock&, EnergyLedger&) const override {}

 private:
  Points points_;
  DrivenPoints driven_;
  std::vector<Index> at_;  ///< of each node of the world its position below; -1: none
  std::vector<Index> nodes_;
  std::vector<Matrix> damping_;
  std::vector<Vec> force_;  ///< of the dampers now [ML/T2]
  Real half_ = 0;           ///< half of a step [T]
};

class NonReflectingReader {
 public:
  NonReflectingReader(const Deck& deck, const Model& model, const SpeedsOfPart& speeds, const World& world,
                      Diagnostics& diagnostics)
      : deck_(deck), model_(model), speeds_(speeds), world_(world), diagnostics_(diagnostics) {
    for (Index n = 0; n < world.nodes.size(); ++n) world_node_[world.nodes.id[n]] = n;
    for (std::size_t s = 0; s < model.solids.size(); ++s)
      for (const Index n : model.solids[s].node)
        if (n >= 0) solids_of_[n].push_back(s);
  }

  void add(const NR& card) {
    const auto set = model_.segment_sets.find(card.ssid);
    if (set == model_.segment_sets.end())
      return error(card, fmt::format("segment set {} does not exist", card.ssid),
                   "define it with *SET_SEGMENT");
    for (const Index s : set->second)
      if (!add_face(card, model_.segments[static_cast<std::size_t>(s)].node)) return;
  }
  const std::map<Index, Matrix>& damping() const { return damping_; }

 private:
  void error(const NR& card, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, "SSID", std::move(message), std::move(hint));
  }

  bool add_face(const NR& card, const std::array<Index, 4>& corner) {
    const std::set<Index> nodes(corner.begin(), corner.end());
    const Id first = model_.nodes[static_cast<std::size_t>(corner[0])].id;
    if (!faces_.insert(nodes).second) {
      error(card, fmt::format("the face of node {} is given twice", first), "name each face once");
      return false;
    }
    const auto speeds = speeds_behind(nodes);
    if (!speeds) {
      error(card, fmt::format("the face of node {} is no outer face of a solid that deforms", first),
            "waves leave through faces of solids");
      return false;
    }
    const auto x = [&](std::size_t c) { return model_.nodes[static_cast<std::size_t>(corner[c])].x; };
    const Vec area = nodes.size() == 3 ? Vec(0.5 * (x(1) - x(0)).cross(x(2) - x(0)))
                                       : Vec(0.5 * (x(2) - x(0)).cross(x(3) - x(1)));
    const Vec n = area.normalized();
    const Matrix along = n * n.transpose(), across = Matrix::Identity() - along;
    const Matrix C =
        speeds->ro * area.norm() *
        ((card.ad == 0 ? speeds->dilatation : 0) * along + (card.as == 0 ? speeds->shear : 0) * across);
    for (const auto& [node, share] : shares_of(nodes)) {
      const Index at = world_node_.at(model_.nodes[static_cast<std::size_t>(node)].id);
      if (world_.nodes.follow[at] != 0) {
        error(card,
              fmt::format("node {} goes with a rigid body, or with a face to which it is tied",
                          world_.nodes.id[at]),
              "leave its faces out");
        return false;
      }
      damping_.try_emplace(at, Matrix::Zero()).first->second += share * C;
    }
    return true;
  }
  /// Of the area of a face: equal ones, or as four triangles, of quadrilaterals around a fifth face, where it
  /// has nodes on its edges.
  std::map<Index, Real> shares_of(const std::set<Index>& corners) const {
    const bool triangle = corners.size() == 3;
    std::map<Index, Real> out, with_edges;
    for (const Index a : corners) {
      out[a] = 1 / static_cast<Real>(corners.size()), with_edges[a] = triangle ? 1.0 / 12 : 1.0 / 24;
      for (const Index b : corners)
        if (const auto found = on_edge_.find({a, b}); found != on_edge_.end())
          with_edges[found->second] = triangle ? 1.0 / 4 : 5.0 / 24;
    }
    return with_edges.size() == 2 * corners.size() ? with_edges : out;
  }

  /// Of the one solid that has this face; nothing: there is none, or the face lies between two.
  std::optional<WaveSpeeds> speeds_behind(const std::set<Index>& face) const {
    const auto known = solids_of_.find(*face.begin());
    if (known == solids_of_.end()) return std::nullopt;
    std::optional<WaveSpeeds> out;
    for (const std::size_t s : known->second) {
      if (!has_face(model_.solids[s], face)) continue;
      if (out) return std::nullopt;
      out = speeds_(model_.solids[s].part);
    }
    return out;
  }
  static bool has_face(const ModelSolid& solid, const std::set<Index>& face) {
    constexpr std::size_t faces[6][4] = {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                         {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    const std::array<Index, 8> corner = solid.corners();
    return std::any_of(std::begin(faces), std::end(faces), [&](const auto& f) {
      return std::set<Index>{corner[f[0]], corner[f[1]], corner[f[2]], corner[f[3]]} == face;
    });
  }

  const Deck& deck_;
  const Model& model_;
  const SpeedsOfPart& speeds_;
  const World& world_;
  Diagnostics& diagnostics_;
  std::map<Id, Index> world_node_;
  std::unordered_map<Index, std::vector<std::size_t>> solids_of_;  ///< of nodes of the model
  std::map<std::array<Index, 2>, Index> on_edge_ = nodes_on_edges(model_.solids);
  std::set<std::set<Index>> faces_;
  std::map<Index, Matrix> damping_;  ///< of nodes of the world [M/T]
};

}  // namespace

std::shared_ptr<Constraint> make_non_reflecting(const Deck& deck, const Model& model,
                                                const SpeedsOfPart& speeds, World& world,
                                                Diagnostics& diagnostics) {
  const auto& cards = deck.all<NR>();
  if (cards.empty()) return nullptr;
  NonReflectingReader reader(deck, model, speeds, world, diagnostics);
  for (const NR& card : cards) reader.add(card);
  return diagnostics.ok() ? std::make_shared<WaveDampers>(reader.damping(), world) : nullptr;
}

}  // namespace courant
