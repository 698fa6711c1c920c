#include "elements/nodal_assembly.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "state/block_sums.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

/// Elements write forces of their corners, or sums of blocks of them, to positions of their own; only
/// the thread that has the block of a node adds to it. In meshes whose nodes are numbered as bricks
/// usually are, a node is corner c of one element at most: a table states which, for each corner, and
/// neighbouring nodes read neighbouring numbers. The rest is a list.
class NodalAssembly : public Force {
 public:
  explicit NodalAssembly(const World& world, Field<Real>& force, Field<Real>* moment)
      : force_(force), moment_(moment), first_(static_cast<std::size_t>(world.nodes.size()) + 1, 0) {
    std::vector<Entry> list;
    std::vector<Index> list_node;
    for (const auto& group : world.groups)
      if (group->sums)
        list_sums(*group->sums, list, list_node);
      else if (group->pushes && group->corners() > 1)  // not of lumped masses
        fill_tables(*group, list, list_node);
    for (const Index n : list_node) ++first_[static_cast<std::size_t>(n) + 1];
    for (std::size_t n = 1; n < first_.size(); ++n) first_[n] += first_[n - 1];
    list_.resize(list.size());
    std::vector<Index> next(first_.begin(), first_.end() - 1);
    for (std::size_t k = 0; k < list.size(); ++k)
      list_[static_cast<std::size_t>(next[static_cast<std::size_t>(list_node[k])]++)] = list[k];
  }
  std::string name() const override {
    return moment_ ? "assembly of nodal forces and moments" : "assembly of nodal forces";
  }
  const FieldSet& over(const World& world) const override { return world.nodes.fields; }
  void declare(const World&, Accesses& a) const override {
    a.updates(force_);
    if (moment_) a.updates(*moment_);
    for (const Source& source : sources_) {
      a.reads(*source.force, Reach::others);
      if (source.moment) a.reads(*source.moment, Reach::others);
    }
  }

  void start(World&, const Clock&) override {
    for (Source& source : sources_)
      for (int k = 0; k < 3; ++k) {
        const auto at = static_cast<std::size_t>(k);
        source.f[at] = source.force->data(source.component + k);
        if (source.moment) source.m[at] = source.moment->data(source.component + k);
      }
  }
  void block(World&, const Clock&, Index begin, Index end) override {
    add(force_, &Source::f, begin, end);
    if (moment_) add(*moment_, &Source::m, begin, end);
  }

 private:
  /// Forces and moments on positions of a group.
  struct Source {
    const Field<Real>*force, *moment;  ///< null: no moments
    int component;                     ///< the first of three
    std::array<const Real*, 3> f{}, m{};
  };
  struct Entry {
    Index place;
    std::uint32_t source;
  };
  /// Which place of a source a node has; -1: none, or it is in the list.
  struct Table {
    std::size_t source;
    Index begin, end;  ///< of nodes
    std::vector<Index> place;
  };

  void add(Field<Real>& field, std::array<const Real*, 3> Source::*what, Index begin, Index end) const {
    Real* const to[3] = {field.data(0), field.data(1), field.data(2)};
    for (const Table& table : tables_) {
      const Index first = std::max(begin, table.begin), last = std::min(end, table.end);
      const auto& from = sources_[table.source].*what;
      if (first >= last || !from[0]) continue;
      const Index* place = table.place.data() - table.begin;
      const Real *x = from[0], *y = from[1], *z = from[2];
      for (Index n = first; n < last; ++n) {
        const Index e = place[n];
        if (e < 0) continue;
        to[0][n] += x[e], to[1][n] += y[e], to[2][n] += z[e];
      }
    }
    if (list_.empty()) return;
    for (Index n = begin; n < end; ++n)
      for (Index k = first_[static_cast<std::size_t>(n)]; k < first_[static_cast<std::size_t>(n) + 1]; ++k) {
        const Entry& entry = list_[static_cast<std::size_t>(k)];
        const auto& from = sources_[entry.source].*what;
        if (!from[0]) continue;
        for (std::size_t c = 0; c < 3; ++c) to[c][n] += from[c][entry.place];
      }
  }

  std::uint32_t add_source(const Field<Real>& force, const Field<Real>* moment, int component) {
    sources_.push_back({&force, moment_ ? moment : nullptr, component});
    return static_cast<std::uint32_t>(sources_.size() - 1);
  }

  void list_sums(const BlockSums& sums, std::vector<Entry>& list, std::vector<Index>& list_node) {
    const std::uint32_t source = add_source(sums.force, &sums.moment, 0);
    for (Index place = 0; place < static_cast<Index>(sums.nodes().size()); ++place) {
      list.push_back({place, source});
      list_node.push_back(sums.nodes()[static_cast<std::size_t>(place)]);
    }
  }

  void fill_tables(const ElementGroup& group, std::vector<Entry>& list, std::vector<Index>& list_node) {
    constexpr Index most_room = 4;  // of a table, per element: nodes of a part may be strewn over the model
    for (int c = 0; c < group.corners(); ++c) {
      const Index* node = group.node.data(c);
      Table table{add_source(*group.corner_force, group.corner_moment, 3 * c), 0, 0, {}};
      if (group.size() > 0) {
        const auto [least, most] = std::minmax_element(node, node + group.size());
        if ((*most - *least) / most_room < group.size() + block_size) {
          table.begin = *least, table.end = *most + 1;
          table.place.assign(static_cast<std::size_t>(table.end - table.begin), -1);
        }
      }
      for (Index e = 0; e < group.size(); ++e) {
        const bool fits = node[e] >= table.begin && node[e] < table.end;
        Index* place = fits ? &table.place[static_cast<std::size_t>(node[e] - table.begin)] : nullptr;
        if (place && *place < 0) {
          *place = e;
        } else {
          list.push_back({e, static_cast<std::uint32_t>(table.source)});
          list_node.push_back(node[e]);
        }
      }
      if (!table.place.empty()) tables_.push_back(std::move(table));
    }
  }

  Field<Real>& force_;   ///< of nodes
  Field<Real>* moment_;  ///< of their rotations; null: there are none
  std::vector<Source> sources_;
  std::vector<Table> tables_;  ///< in the order of groups and corners
  std::vector<Index> first_;   ///< of each node in list_, and the end
  std::vector<Entry> list_;    ///< those of a node one after the other
};

}  // namespace

std::shared_ptr<Force> make_nodal_assembly(World& world) {
  const bool turns = std::any_of(world.groups.begin(), world.groups.end(),
                                 [](const auto& group) { return group->sums || group->corner_moment; });
  return std::make_shared<NodalAssembly>(world, world.nodes.f,
                                         turns ? shared_fields::moment.find(world.nodes.fields) : nullptr);
}

}  // namespace courant
