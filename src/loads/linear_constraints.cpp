// *CONSTRAINED_LINEAR_GLOBAL and _LOCAL.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>

#include "extension/additions.hpp"
#include "keyword/registry.hpp"
#include "loads/load_cards.hpp"
#include "model/cards.hpp"
#include "model/transforms/transformation.hpp"
#include "state/shared_fields.hpp"
#include "state/tied_mass.hpp"

namespace courant {

namespace {

using CL = ConstrainedLinear;

const RegisterKeyword<CL> constrained_linear_global{constrained_linear_global_table()};
const RegisterKeyword<CL> constrained_linear_local{constrained_linear_local_table()};

using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using Square = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

/// COEF times the direction, without axes that supports hold.
struct LinearTerm {
  Index node = -1;  ///< index into World::nodes
  bool turns = false;
  Vec c = Vec::Zero();
};
/// sum c . u = 0.
using LinearConstraint = std::vector<LinearTerm>;

/// Translations, or rotations of nodes.
struct Movable {
  Field<Real>*force = nullptr, *speed = nullptr, *mass = nullptr;
};

/// Constraints that share no node with other ones. Their forces c lambda make sum c . a = 0:
/// sum_j (sum c_i . c_j / m) lambda_j = -sum c_i . f / m.
struct LinearSystem {
  std::vector<LinearConstraint> rows{};
  Vector lambda{};  ///< of this step

  Square matrix(const std::array<Movable, 2>& of) const {
    const auto n = static_cast<Eigen::Index>(rows.size());
    Square out = Square::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j <= i; ++j) {
        for (const LinearTerm& a : rows[static_cast<std::size_t>(i)])
          for (const LinearTerm& b : rows[static_cast<std::size_t>(j)])
            if (a.node == b.node && a.turns == b.turns)
              out(i, j) += a.c.dot(b.c) / (*of[a.turns].mass)[a.node];
        out(j, i) = out(i, j);
      }
    return out;
  }
  /// sum c . (force or speed) over `by`.
  template <class Value>
  Vector sums(const Value& value) const {
    Vector out = Vector::Zero(static_cast<Eigen::Index>(rows.size()));
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (const LinearTerm& t : rows[i]) out[static_cast<Eigen::Index>(i)] += t.c.dot(value(t));
    return out;
  }
};

std::array<Movable, 2> movables(World& world) {
  FieldSet& set = world.nodes.fields;
  return {Movable{&world.nodes.f, &world.nodes.v, &world.nodes.m},
          Movable{shared_fields::moment.find(set), shared_fields::angular_velocity.find(set),
                  shared_fields::rotary_inertia.find(set)}};
}

/// Forces of the constraints, which do no work, as velocities obey them.
class LinearConstraints : public Constraint {
 public:
  LinearConstraints(std::vector<LinearSystem> systems, World& world)
      : systems_(std::move(systems)),
        of_(movables(world)),
        part_of_(static_cast<std::size_t>(world.nodes.size())) {
    Field<Index>& joined = shared_fields::joined_nodes.add(world.nodes.fields);
    for (const LinearSystem& s : systems_)
      for (const LinearConstraint& row : s.rows)
        for (const LinearTerm& t : row) joined[t.node] = 1 + s.rows.front().front().node;
    for (std::size_t s = 0; s < systems_.size(); ++s)
      for (std::size_t row = 0; row < systems_[s].rows.size(); ++row)
        for (const LinearTerm& t : systems_[s].rows[row]) {
          part_of_[static_cast<std::size_t>(t.node)].push_back({s, row, t});
          turns_ = turns_ || t.turns;
        }
  }
  std::string name() const override { return "linear constraints"; }
  const FieldSet& over(const World& world) const override { return world.nodes.fields; }
  void declare(const World& world, Accesses& a) const override {
    a.in_start().reads(world.nodes.f, Reach::others).reads(world.nodes.m, Reach::others);
    if (turns_) a.reads(*of_[1].force, Reach::others).reads(*of_[1].mass, Reach::others);
    a.in_block().revises(world.nodes.f);
    if (turns_) a.revises(*of_[1].force);
  }
  void start(World&, const Clock&) override {
    for (LinearSystem& s : systems_)
      s.lambda = s.matrix(of_).llt().solve(s.sums([&](const LinearTerm& t) {
        return Vec(-of_[t.turns].force->vec(t.node) / (*of_[t.turns].mass)[t.node]);
      }));
  }
  void block(World&, const Clock&, Index begin, Index end) override {
    for (Index n = begin; n < end; ++n)
      for (const Part& part : part_of_[static_cast<std::size_t>(n)])
        of_[part.term.turns].force->add(
            n, systems_[part.system].lambda[static_cast<Eigen::Index>(part.row)] * part.term.c);
  }

 private:
  struct Part {
    std::size_t system, row;
    LinearTerm term;
  };
  std::vector<LinearSystem> systems_;
  std::array<Movable, 2> of_;
  std::vector<std::vector<Part>> part_of_;  ///< of each node
  bool turns_ = false;
};

class LinearBuilder {
 public:
  LinearBuilder(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics)
      : deck_(deck), model_(model), world_(world), diagnostics_(diagnostics), of_(movables(world)) {
    for (Index n = 0; n < world.nodes.size(); ++n) world_node_[world.nodes.id[n]] = n;
    for (std::size_t n = 0; n < model.nodes.size(); ++n)
      model_node_[model.nodes[n].id] = static_cast<Index>(n);
    for (const ModelInertia& one : model.inertias)
      if (one.turns()) tops_.insert(one.node);
    for (const auto& card : deck.all<BoundarySpcNodeCard>())
      if (is_oblique(card)) oblique_.insert(card.nid);
    for (const auto& card : deck.all<BoundarySpcSetCard>())
      if (const auto set = model.node_sets.find(card.nid); is_oblique(card) && set != model.node_sets.end())
        for (const Index n : set->second) oblique_.insert(model.nodes[static_cast<std::size_t>(n)].id);
  }

  void add(const CL& card) {
    for (const auto& [name, use] : deck_.keywords)
      if (name.starts_with("RIGIDWALL") || name.starts_with("CONSTRAINED_NODE_SET"))
        return error(
            card, "", fmt::format("it is not supported beside *{}", name),
            "use plates of *MAT_RIGID with *CONTACT as walls, and this keyword for nodes that move alike");
    LinearConstraint row;
    for (std::size_t k = 0; k < card.nid.size(); ++k)
      if (!add_term(card, k, row)) return;
    if (row.empty())
      return error(card, "COEF", "all that it names is held, or has the coefficient 0: it constrains nothing",
                   "leave it out");
    rows_.push_back(std::move(row)), cards_.push_back(&card);
  }

  void finish() {
    std::vector<LinearSystem> systems;
    for (const std::vector<std::size_t>& group : groups()) {
      LinearSystem& s = systems.emplace_back();
      for (const std::size_t row : group) s.rows.push_back(rows_[row]);
      const Square A = s.matrix(of_);
      const Eigen::LDLT<Square> factors(A);
      constexpr Real dependent = 1e-10;
      if (!(factors.vectorD().minCoeff() > dependent * A.diagonal().maxCoeff()))
        return error(*cards_[group.back()], "", "it follows from others, or contradicts them",
                     "leave out what is said twice");
      start(s, factors, *cards_[group.front()]);
    }
    world_.passes.add(std::make_shared<LinearConstraints>(std::move(systems), world_));
  }

 private:
  void error(const CL& card, const char* field, std::string message, std::string hint) {
    if (field[0] != 0) return deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
    diagnostics_.error(deck_.where(card), deck_.keyword(card) + ": " + message, std::move(hint));
  }
  bool is_oblique(const BoundarySpcCard& card) const {
    if (holds_for_a_time(card, model_.endtim)) return true;
    const auto system = model_.coordinate_systems.find(card.cid);
    if (card.cid == 0 || system == model_.coordinate_systems.end()) return false;
    constexpr Real along = 1 - 1e-9;  // cosine
    return (system->second.axes.cwiseAbs().colwise().maxCoeff().array() < along).any();
  }

  bool add_term(const CL& card, std::size_t k, LinearConstraint& row) {
    const Id id = card.nid[k];
    const auto refuse = [&](const std::string& message, const char* hint) {
      error(card, "NID", fmt::format("node {} {}", id, message), hint);
      return false;
    };
    const auto known = model_node_.find(id);
    const auto found = world_node_.find(id);
    if (known == model_node_.end()) return refuse("does not exist", "define it with *NODE");
    if (found == world_node_.end()) return refuse("belongs to no element", "name nodes of elements");
    LinearTerm term{.node = found->second, .turns = card.dof[k] > 3};
    const auto* driven = (term.turns ? shared_fields::prescribed_rotation : shared_fields::prescribed_motion)
                             .find(world_.nodes.fields);
    const auto* carries = shared_fields::tied_mass.find(world_.nodes.fields);
    if (world_.nodes.follow[term.node] != 0)
      return refuse("goes with a rigid body, or with a face to which it is tied", "name others");
    if (carries && (*carries)[term.node] > 0)
      return refuse("is a corner of a face to which others are tied exactly",
                    "use that contact with _OFFSET, whose springs may act beside it");
    if (driven && (*driven)[term.node] != 0)
      return refuse("is driven by *BOUNDARY_PRESCRIBED_MOTION", "drive the other nodes of the sum, too");
    if (oblique_.contains(id) && !term.turns)
      return refuse("is held along axes that are not the global ones, or for a time",
                    "hold it by a constraint of its own");
    if (term.turns && tops_.contains(known->second))
      return refuse("has an *ELEMENT_INERTIA, which differs by axis", "constrain its displacements");
    const Field<Real>* mass = of_[term.turns].mass;
    if (!mass || !((*mass)[term.node] > 0))
      return refuse(
          term.turns ? "does not turn" : "has no mass",
          term.turns ? "only nodes of shells that deform and of beams do" : "give it one by *ELEMENT_MASS");
    if (!take_direction(card, k, term)) return false;
    remove_held(known->second, term);
    if (term.c.norm() > 0) row.push_back(term);
    return true;
  }

  bool take_direction(const CL& card, std::size_t k, LinearTerm& term) {
    const auto axis = static_cast<int>((card.dof[k] - 1) % 3);
    term.c = card.coef[k] * Vec::Unit(axis);
    const Id cid = k < card.cid.size() ? card.cid[k] : 0;
    if (cid == 0) return true;
    const auto system = model_.coordinate_systems.find(cid);
    if (system == model_.coordinate_systems.end()) {
      error(card, "CID", fmt::format("coordinate system {} does not exist", cid),
            "define it with *DEFINE_COORDINATE_SYSTEM");
      return false;
    }
    if (system->second.moves) {
      error(card, "CID", fmt::format("system {} turns with nodes", cid), "give one that does not move");
      return false;
    }
    term.c = card.coef[k] * system->second.axes.col(axis);
    return true;
  }
  void remove_held(Index node, LinearTerm& term) const {
    std::array<bool, 3> held = model_.nodes[static_cast<std::size_t>(node)].fixed;
    if (term.turns) {
      const auto turns = model_.held_rotations.find(node);
      held = turns == model_.held_rotations.end() ? std::array<bool, 3>{} : turns->second;
    }
    for (int k = 0; k < 3; ++k)
      if (held[static_cast<std::size_t>(k)]) term.c[k] = 0;
  }

  /// Rows that share nodes, also through others.
  std::vector<std::vector<std::size_t>> groups() const {
    std::vector<std::size_t> root(rows_.size());
    std::iota(root.begin(), root.end(), std::size_t(0));
    const auto find = [&](std::size_t k) {
      while (root[k] != k) k = root[k] = root[root[k]];
      return k;
    };
    std::map<std::pair<Index, bool>, std::size_t> owner;
    for (std::size_t row = 0; row < rows_.size(); ++row)
      for (const LinearTerm& t : rows_[row]) {
        const auto [first, is_new] = owner.try_emplace({t.node, t.turns}, row);
        if (!is_new) root[find(row)] = find(first->second);
      }
    std::map<std::size_t, std::vector<std::size_t>> by_root;
    for (std::size_t row = 0; row < rows_.size(); ++row) by_root[find(row)].push_back(row);
    std::vector<std::vector<std::size_t>> out;
    for (auto& [first, members] : by_root) out.push_back(std::move(members));
    return out;
  }

  /// Velocities that obey, with the least change of kinetic energy.
  void start(const LinearSystem& s, const Eigen::LDLT<Square>& factors, const CL& card) {
    Real before = 0, after = 0;
    std::set<std::pair<Index, bool>> all;
    for (const LinearConstraint& row : s.rows)
      for (const LinearTerm& t : row) all.insert({t.node, t.turns});
    const auto energy = [&] {
      Real sum = 0;
      for (const auto& [n, turns] : all)
        sum += 0.5 * (*of_[turns].mass)[n] * of_[turns].speed->vec(n).squaredNorm();
      return sum;
    };
    before = energy();
    const Vector lambda =
        factors.solve(-s.sums([&](const LinearTerm& t) { return of_[t.turns].speed->vec(t.node); }));
    for (std::size_t i = 0; i < s.rows.size(); ++i)
      for (const LinearTerm& t : s.rows[i])
        of_[t.turns].speed->add(t.node,
                                lambda[static_cast<Eigen::Index>(i)] / (*of_[t.turns].mass)[t.node] * t.c);
    after = energy();
    constexpr Real rounding = 1e-6;
    if (before - after > rounding * before)
      deck_.warning(
          diagnostics_, card, "NID",
          fmt::format(
              "velocities at the start do not fit: {:.4g} of {:.4g} of kinetic energy [ML2/T2] of the "
              "nodes is lost, as in a plastic impact",
              before - after, before),
          "give them velocities whose sum with COEF is 0");
  }

  const Deck& deck_;
  const Model& model_;
  World& world_;
  Diagnostics& diagnostics_;
  std::array<Movable, 2> of_;
  std::map<Id, Index> world_node_, model_node_;
  std::set<Index> tops_;  ///< nodes with an inertia of their own
  std::set<Id> oblique_;
  std::vector<LinearConstraint> rows_;
  std::vector<const CL*> cards_;
};

const RegisterAddition linear_constraints{
    "*CONSTRAINED_LINEAR", [](const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics) {
      if (deck.all<CL>().empty()) return;
      const int errors = diagnostics.errors();
      LinearBuilder builder(deck, model, world, diagnostics);
      for (const CL& card : deck.all<CL>()) builder.add(card);
      if (diagnostics.errors() == errors) builder.finish();
    }};

}  // namespace

std::string keep_linear_axes(ConstrainedLinear& card, const Affine& motion) {
  const bool local =
      !card.cid.empty() && std::all_of(card.cid.begin(), card.cid.end(), [](Id c) { return c > 0; });
  if (local || motion.linear() == Matrix::Identity()) return {};
  return "its directions are axes, which a transformation that turns or stretches the file would change";
}

}  // namespace courant
