// *DEFINE_DEATH_TIMES: prescribed motions of nodes that end where these have come to.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "extension/builders.hpp"
#include "keyword/registry.hpp"
#include "loads/load_cards.hpp"
#include "loads/loads.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

struct DeathTimes : DeathTimesFields {
  bool of_sets() const { return name == 1; }  // names in the order of the table
};
const RegisterKeyword<DeathTimes> death_times{define_death_times_nodes_table()};

enum class Shape { plane = 1, cylinder = 2, sphere = 3 };

/// Where motions end: nodes of the world that carry the shape, -1: it stays at the points given.
struct DeadlyRegion {
  Shape shape = Shape::plane;
  Vec origin = Vec::Zero(), tail = Vec::Zero(), head = Vec::Zero();  ///< [L]
  std::array<Index, 3> node{-1, -1, -1};
  Real radius = 0;  ///< [L]
  int side = 1;     ///< FLAG
  std::vector<Index> watched{};

  bool contains(const Vec& x, const Nodes& nodes) const {
    const auto at = [&](std::size_t k, const Vec& given) {
      return node[k] < 0 ? given : nodes.x.vec(node[k]);
    };
    const Vec axis = (at(2, head) - at(1, tail)).normalized(), r = x - at(0, origin);
    const Real beyond = shape == Shape::plane      ? r.dot(axis)
                        : shape == Shape::cylinder ? (r - r.dot(axis) * axis).norm() - radius
                                                   : r.norm() - radius;
    return side * beyond > 0;
  }
};

/// A motion ends with the step that begins there. What drives a node is a number in a field that restart
/// files hold: 0 is nothing, so what has ended stays so.
class MotionDeaths : public Impact {
 public:
  MotionDeaths(std::vector<DeadlyRegion> regions, World& world)
      : regions_(std::move(regions)),
        driven_{shared_fields::prescribed_motion.find(world.nodes.fields),
                shared_fields::prescribed_rotation.find(world.nodes.fields)} {
    world.counters["motions_ended_by_position"] += 0;
  }
  std::string name() const override { return "ends of motions by position"; }
  void strike(World& world, const Clock&) override {
    for (const DeadlyRegion& region : regions_)
      for (const Index n : region.watched) {
        if (!drives(n) || !region.contains(world.nodes.x.vec(n), world.nodes)) continue;
        ++world.counters["motions_ended_by_position"];
        for (Field<Index>* driven : driven_)
          if (driven) (*driven)[n] = 0;
        if (Field<Index>* axes = shared_fields::driven_axes.find(world.nodes.fields)) (*axes)[n] = 0;
      }
  }

 private:
  bool drives(Index n) const {
    return std::any_of(driven_.begin(), driven_.end(),
                       [n](const Field<Index>* driven) { return driven && (*driven)[n] != 0; });
  }
  std::vector<DeadlyRegion> regions_;
  std::array<Field<Index>*, 2> driven_;  ///< of displacements, of rotations; null: nothing is driven
};

class DeathTimesReader {
 public:
  DeathTimesReader(const Deck& deck, const Model& model, const World& world, Diagnostics& diagnostics)
      : deck_(deck), model_(model), world_(world), diagnostics_(diagnostics) {
    for (Index n = 0; n < world.nodes.size(); ++n) node_of_id_.emplace(world.nodes.id[n], n);
  }
  std::vector<DeadlyRegion> regions;

  void take(const DeathTimes& card) {
    DeadlyRegion out{.shape = static_cast<Shape>(card.geo), .radius = card.r, .side = card.flag};
    out.tail = Vec(card.x_t, card.y_t, card.z_t), out.head = Vec(card.x_h, card.y_h, card.z_h);
    out.origin = out.tail;
    const std::pair<const char*, Id> carriers[] = {{"N1", card.n1}, {"N2", card.n2}, {"N3", card.n3}};
    for (std::size_t k = 0; k < 3; ++k)
      if (carriers[k].second != 0 && (out.node[k] = node(card, carriers[k].first, carriers[k].second)) < 0)
        return;
    if ((card.n2 == 0) != (card.n3 == 0))
      return error(card, card.n2 == 0 ? "N2" : "N3", "a direction needs two nodes, N2 and N3",
                   "give both, or neither");
    const bool directed = out.shape != Shape::sphere;
    if (directed && card.n2 == 0 && !((out.head - out.tail).norm() > 0))
      return error(card, "X_H", "the normal or axis has no direction", "give a head that is not the tail");
    if (out.shape != Shape::plane && !(card.r > 0))
      return error(card, "R", "a cylinder or sphere has a radius above 0", "give R");
    for (const Id id : card.ids)
      if (id != 0 && !watch(card, id, out.watched)) return;
    std::sort(out.watched.begin(), out.watched.end());
    out.watched.erase(std::unique(out.watched.begin(), out.watched.end()), out.watched.end());
    const auto* driven = shared_fields::prescribed_motion.find(world_.nodes.fields);
    const auto* turned = shared_fields::prescribed_rotation.find(world_.nodes.fields);
    const auto is_driven = [&](Index n) {
      return (driven && (*driven)[n] != 0) || (turned && (*turned)[n] != 0);
    };
    if (std::none_of(out.watched.begin(), out.watched.end(), is_driven))
      return deck_.warning(diagnostics_, card, "GEO",
                           "has no effect: no prescribed motion drives these nodes",
                           "name nodes of *BOUNDARY_PRESCRIBED_MOTION_NODE or _SET");
    regions.push_back(std::move(out));
  }

 private:
  void error(const DeathTimes& card, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
  }
  Index node(const DeathTimes& card, const char* field, Id id) {
    const auto found = node_of_id_.find(id);
    if (found != node_of_id_.end()) return found->second;
    error(card, field, fmt::format("node {} is no node of elements", id),
          "name nodes of solids, shells or beams; particles are not supported here");
    return -1;
  }
  bool watch(const DeathTimes& card, Id id, std::vector<Index>& out) {
    if (!card.of_sets()) {
      out.push_back(node(card, "ID", id));
      return out.back() >= 0;
    }
    const auto set = model_.node_sets.find(id);
    if (set == model_.node_sets.end()) {
      error(card, "ID", fmt::format("node set {} does not exist", id), "define it with *SET_NODE");
      return false;
    }
    for (const Index n : set->second) {
      out.push_back(node(card, "ID", model_.nodes[static_cast<std::size_t>(n)].id));
      if (out.back() < 0) return false;
    }
    return true;
  }

  const Deck& deck_;
  const Model& model_;
  const World& world_;
  Diagnostics& diagnostics_;
  std::unordered_map<Id, Index> node_of_id_;
};

void end_motions_by_position(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                             const std::vector<PrescribedMotion>&) {
  if (deck.all<DeathTimes>().empty()) return;
  DeathTimesReader reader(deck, model, world, diagnostics);
  for (const DeathTimes& card : deck.all<DeathTimes>()) reader.take(card);
  if (!reader.regions.empty())
    world.passes.add(std::make_shared<MotionDeaths>(std::move(reader.regions), world));
}

const RegisterBuilder motion_deaths(BuildPhase::conditions, "ends of motions by position",
                                    end_motions_by_position, Errors::go_on);

}  // namespace

}  // namespace courant
