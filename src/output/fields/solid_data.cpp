#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <string_view>

#include "output/fields/field_data.hpp"
#include "output/fields/stress_invariants.hpp"
#include "output/fields/vtk_arrays.hpp"
#include "output/fields/vtk_cell.hpp"
#include "state/shared_fields.hpp"

namespace courant {
namespace {

using Groups = std::vector<const ElementGroup*>;

Groups groups_shown(const World& world, const FieldWriterOptions& options) {
  Groups out;
  for (const auto& group : world.groups)
    if (!group->segment &&  // shells stand with the faces
        !std::binary_search(options.left_out.begin(), options.left_out.end(), group->part))
      out.push_back(group.get());
  return out;
}

/// Nodes that elements use, ascending, and where each stands among them.
std::vector<Index> nodes_used(const World& world, const Groups& groups, std::vector<Index>& place) {
  place.assign(static_cast<std::size_t>(world.nodes.size()), -1);
  for (const ElementGroup* group : groups)
    for (int c = 0; c < group->corners(); ++c)
      for (Index e = 0; e < group->size(); ++e) place[static_cast<std::size_t>(group->node.data(c)[e])] = 0;
  std::vector<Index> out;
  for (Index n = 0; n < world.nodes.size(); ++n)
    if (place[static_cast<std::size_t>(n)] == 0) {
      place[static_cast<std::size_t>(n)] = static_cast<Index>(out.size());
      out.push_back(n);
    }
  return out;
}

/// Elements that are not deleted.
std::vector<Index> elements_shown(const ElementGroup& group) {
  std::vector<Index> out = all_of(group.size());
  if (const Field<Index>* eroded = shared_fields::eroded.find(group.fields))
    std::erase_if(out, [&](Index e) { return (*eroded)[e] != 0; });
  return out;
}

VtkSection cells(const Groups& groups, const std::vector<Index>& place) {
  std::vector<Index> corners, ends;
  std::vector<std::uint8_t> types;
  for (const ElementGroup* group : groups)
    for (const Index e : elements_shown(*group)) {
      const VtkCell cell = vtk_cell(*group, e);
      for (const int c : cell.corners)
        corners.push_back(place[static_cast<std::size_t>(group->node.data(c)[e])]);
      ends.push_back(static_cast<Index>(corners.size()));
      types.push_back(cell.type);
    }
  const auto array = [](const char* name, const std::vector<Index>& values) {
    return make_array<Index, 1>(name, "", values.size(), [&](std::size_t i, Index* to) { *to = values[i]; });
  };
  return {"Cells",
          {array("connectivity", corners), array("offsets", ends),
           make_array<std::uint8_t, 1>("types", "", types.size(),
                                       [&](std::size_t i, std::uint8_t* to) { *to = types[i]; })}};
}

bool same_kind(const VtkArray& a, const VtkArray& b) {
  return std::string_view(a.type) == b.type && a.components == b.components && a.dimension == b.dimension;
}

/// The fields flagged `output`, each 0 in groups that have none of that name and kind.
std::vector<VtkArray> cell_data(const Groups& groups, const FieldWriterOptions& options) {
  std::vector<VtkArray> out;
  std::set<std::string> done;
  for (const ElementGroup* owner : groups)
    for (const auto& field : owner->fields.all()) {
      if (!field->info().output || !done.insert(field->info().name).second) continue;
      VtkArray all = copy_of(*field, {0}, options.float64, 0);
      const std::size_t width = all.bytes.size();
      all.bytes.clear();
      for (const ElementGroup* group : groups) {
        const std::vector<Index> shown = elements_shown(*group);
        const std::size_t end = all.bytes.size() + width * shown.size();
        if (const FieldBase* mine = group->fields.find(field->info().name)) {
          const VtkArray one = copy_of(*mine, shown, options.float64, 0);
          if (same_kind(one, all)) all.bytes.insert(all.bytes.end(), one.bytes.begin(), one.bytes.end());
        }
        all.bytes.resize(end);
      }
      out.push_back(std::move(all));
    }
  return out;
}

}  // namespace

VtkDataSet solid_data(const World& world, const FieldWriterOptions& options) {
  const Groups groups = groups_shown(world, options);
  std::vector<Index> place;
  const std::vector<Index> nodes = nodes_used(world, groups, place);
  std::vector<VtkArray> of_nodes, of_elements = cell_data(groups, options);
  for (const auto& field : world.nodes.fields.all())
    if (field->info().output) of_nodes.push_back(copy_of(*field, nodes, options.float64, 0));
  std::vector<Id> part;
  for (const ElementGroup* group : groups)
    part.insert(part.end(), elements_shown(*group).size(),
                group->part < 0 ? 0 : options.part_ids.at(static_cast<std::size_t>(group->part)));
  of_elements.push_back(
      make_array<Id, 1>("part", "", part.size(), [&](std::size_t i, Id* to) { *to = part[i]; }));
  VtkDataSet out{"UnstructuredGrid",
                 fmt::format("NumberOfPoints=\"{}\" NumberOfCells=\"{}\"", nodes.size(), part.size()),
                 0,
                 {}};
  add_stress_invariants(of_elements);
  out.sections.push_back({"PointData", std::move(of_nodes)});
  out.sections.push_back({"CellData", std::move(of_elements)});
  out.sections.push_back({"Points", {node_places(world, nodes, options)}});
  out.sections.push_back(cells(groups, place));
  return out;
}

}  // namespace courant
