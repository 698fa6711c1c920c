#include "elements/nodal_assembly.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "state/shared_fields.hpp"

namespace courant {

namespace {

/// Elements write forces of their corners to places of their own; nobody adds to a node but the thread that
/// has its block. In meshes whose nodes are numbered as bricks usually are, a node is corner c of one element
/// at most: a table tells which, for each corner, and neighbouring nodes read neighbouring numbers. The rest
/// is a list.
class NodalAssembly : public Force {
 public:
  /// Elements, and what they left for their corners.
  struct Source {
    const ElementGroup* group;
    const Field<Real>* field;
  };
  NodalAssembly(const World& world, std::string name, Field<Real>& to, std::vector<Source> from)
      : name_(std::move(name)),
        to_(to),
        from_(std::move(from)),
        first_(static_cast<std::size_t>(world.nodes.size()) + 1, 0) {
    std::vector<Corner> rest;
    std::vector<Index> rest_node;
    for (std::size_t g = 0; g < from_.size(); ++g) fill_tables(*from_[g].group, g, rest, rest_node);
    for (const Index n : rest_node) ++first_[static_cast<std::size_t>(n) + 1];
    for (std::size_t n = 1; n < first_.size(); ++n) first_[n] += first_[n - 1];
    corners_.resize(rest.size());
    std::vector<Index> next(first_.begin(), first_.end() - 1);
    for (std::size_t k = 0; k < rest.size(); ++k)
      corners_[static_cast<std::size_t>(next[static_cast<std::size_t>(rest_node[k])]++)] = rest[k];
  }
  std::string name() const override { return name_; }
  const FieldSet& over(const World& world) const override { return world.nodes.fields; }
  void declare(const World&, Accesses& a) const override {
    a.updates(to_);
    for (const Source& source : from_) a.reads(*source.field, Reach::others);
  }

  void start(World&, const Clock&) override {
    forces_.clear();
    for (const Source& source : from_) {
      auto& of_group = forces_.emplace_back();
      for (int k = 0; k < 3 * source.group->corners(); ++k) of_group.push_back(source.field->data(k));
    }
  }
  void block(World&, const Clock&, Index begin, Index end) override {
    Real* const f[3] = {to_.data(0), to_.data(1), to_.data(2)};
    for (const Table& table : tables_) {
      const Index from = std::max(begin, table.begin), to = std::min(end, table.end);
      if (from >= to) continue;
      const Index* element = table.element.data() - table.begin;
      const Real* const* of = forces_[table.group].data() + 3 * table.corner;
      const Real *x = of[0], *y = of[1], *z = of[2];
      for (Index n = from; n < to; ++n) {
        const Index e = element[n];
        if (e < 0) continue;
        f[0][n] += x[e], f[1][n] += y[e], f[2][n] += z[e];
      }
    }
    for (Index n = begin; n < end && !corners_.empty(); ++n)
      for (Index k = first_[static_cast<std::size_t>(n)]; k < first_[static_cast<std::size_t>(n) + 1]; ++k) {
        const Corner& corner = corners_[static_cast<std::size_t>(k)];
        for (int c = 0; c < 3; ++c)
          f[c][n] += forces_[corner.group][3 * corner.corner + static_cast<std::size_t>(c)][corner.element];
      }
  }

 private:
  struct Corner {
    Index element;
    std::uint32_t group, corner;
  };
  /// Of which element a node is corner `corner`; -1: of none, or it stands in the list.
  struct Table {
    std::size_t group, corner;
    Index begin, end;  ///< of nodes
    std::vector<Index> element;
  };

  void fill_tables(const ElementGroup& group, std::size_t g, std::vector<Corner>& rest,
                   std::vector<Index>& rest_node) {
    constexpr Index most_room = 4;  // of a table, per element: nodes of a part may be strewn over the model
    for (int c = 0; c < group.corners(); ++c) {
      const Index* node = group.node.data(c);
      Table table{g, static_cast<std::size_t>(c), 0, 0, {}};
      if (group.size() > 0) {
        const auto [least, most] = std::minmax_element(node, node + group.size());
        if ((*most - *least) / most_room < group.size() + block_size) {
          table.begin = *least, table.end = *most + 1;
          table.element.assign(static_cast<std::size_t>(table.end - table.begin), -1);
        }
      }
      for (Index e = 0; e < group.size(); ++e) {
        const bool fits = node[e] >= table.begin && node[e] < table.end;
        Index* place = fits ? &table.element[static_cast<std::size_t>(node[e] - table.begin)] : nullptr;
        if (place && *place < 0) {
          *place = e;
        } else {
          rest.push_back({e, static_cast<std::uint32_t>(g), static_cast<std::uint32_t>(c)});
          rest_node.push_back(node[e]);
        }
      }
      if (!table.element.empty()) tables_.push_back(std::move(table));
    }
  }

  std::string name_;
  Field<Real>& to_;  ///< of nodes
  std::vector<Source> from_;
  std::vector<Table> tables_;                     ///< in the order of groups and corners
  std::vector<Index> first_;                      ///< of each node in corners_, and the end
  std::vector<Corner> corners_;                   ///< those of a node one after the other
  std::vector<std::vector<const Real*>> forces_;  ///< of each group, by component
};

}  // namespace

std::shared_ptr<Force> make_nodal_assembly(World& world) {
  std::vector<NodalAssembly::Source> from;
  for (const auto& group : world.groups)
    if (group->corners() > 1) from.push_back({group.get(), &group->corner_force});  // not of lumped masses
  return std::make_shared<NodalAssembly>(world, "assembly of nodal forces", world.nodes.f, std::move(from));
}

std::shared_ptr<Force> make_moment_assembly(World& world) {
  std::vector<NodalAssembly::Source> from;
  for (const auto& group : world.groups)
    if (group->corner_moment) from.push_back({group.get(), group->corner_moment});
  if (from.empty()) return nullptr;
  return std::make_shared<NodalAssembly>(world, "assembly of nodal moments",
                                         *shared_fields::moment.find(world.nodes.fields), std::move(from));
}

}  // namespace courant
