#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <string>

#include "output/fields/field_data.hpp"
#include "output/fields/stress_invariants.hpp"
#include "output/fields/vtk_arrays.hpp"
#include "state/shared_fields.hpp"

namespace courant {
namespace {

/// The cells of a .vtu: corners of all segments one after the other, where each ends, and its VTK type.
VtkSection cells(const Segments& segments, const std::vector<Index>& which) {
  constexpr std::uint8_t triangle = 5, quad = 9;  // VTK_TRIANGLE, VTK_QUAD
  std::vector<Index> corners, ends;
  std::vector<std::uint8_t> types;
  for (const Index s : which) {
    const auto n = segments.nodes(s);
    const bool three = n[2] == n[3];
    corners.insert(corners.end(), n.begin(), three ? n.end() - 1 : n.end());
    ends.push_back(static_cast<Index>(corners.size()));
    types.push_back(three ? triangle : quad);
  }
  const auto array = [](const char* name, const auto& values) {
    using T = typename std::decay_t<decltype(values)>::value_type;
    return make_array<T, 1>(name, "", values.size(), [&](std::size_t i, T* to) { *to = values[i]; });
  };
  return {"Cells", {array("connectivity", corners), array("offsets", ends), array("types", types)}};
}

bool is_force(const FieldInfo& info) {
  return info.dimension == "ML/T2";
}

void add_fields(const FieldSet& fields, const std::vector<Index>& which, const FieldWriterOptions& options,
                std::vector<VtkArray>& to) {
  for (const auto& field : fields.all())
    if (field->info().output && !(options.sparse_shells && is_force(field->info())))
      to.push_back(copy_of(*field, which, options.float64, options.eps));
}

/// The fields flagged `output` of shells that deform, each 0 on other faces.
void add_element_fields(const World& world, const std::vector<Index>& which,
                        const FieldWriterOptions& options, std::vector<VtkArray>& to) {
  std::vector<Index> place(static_cast<std::size_t>(world.segments.size()), -1);
  for (std::size_t k = 0; k < which.size(); ++k)
    place[static_cast<std::size_t>(which[k])] = static_cast<Index>(k);
  std::map<std::string, std::size_t> known;  // place in `to`
  for (const auto& group : world.groups) {
    if (!group->segment) continue;
    for (const auto& field : group->fields.all()) {
      const FieldInfo& info = field->info();
      if (!info.output || field.get() == &group->id) continue;
      const VtkArray one = copy_of(*field, all_of(group->size()), options.float64, 0);
      const std::size_t width = one.bytes.size() / static_cast<std::size_t>(group->size());
      const auto [at, is_new] = known.try_emplace(info.name, to.size());
      if (is_new) {
        to.push_back(one);
        to.back().bytes.assign(width * which.size(), {});
      }
      auto& bytes = to[at->second].bytes;
      if (bytes.size() != width * which.size()) continue;
      for (Index e = 0; e < group->size(); ++e)
        if (const Index k = place[static_cast<std::size_t>((*group->segment)[e])]; k >= 0)
          std::copy_n(one.bytes.begin() + static_cast<std::ptrdiff_t>(width * static_cast<std::size_t>(e)),
                      width,
                      bytes.begin() + static_cast<std::ptrdiff_t>(width * static_cast<std::size_t>(k)));
    }
  }
}

}  // namespace

// Shells are seldom far smaller than their distance from the origin; where a particle's places need float64,
// so may theirs.
VtkArray node_places(const World& world, const std::vector<Index>& nodes, const FieldWriterOptions& options) {
  constexpr Real round_off = 0x1p-24, most = 1e-3;
  Real h = std::numeric_limits<Real>::infinity(), far = 0;
  for (Index i = 0; i < world.particles.size(); ++i) h = std::min(h, world.particles.h[i]);
  for (const Index n : nodes) far = std::max(far, world.nodes.x.vec(n).cwiseAbs().maxCoeff());
  const bool too_far = far * round_off > most * h;
  VtkArray out = copy_of(world.nodes.x, nodes, options.float64 || too_far, 0);
  out.name = "Points";
  out.dimension.clear();  // VTK keeps none with the points
  return out;
}

VtkDataSet shell_data(const World& world, const FieldWriterOptions& options) {
  const std::vector<Index> nodes = all_of(world.nodes.size());
  std::vector<Index> segments = all_of(world.segments.size());
  const Field<Index>* eroded = shared_fields::eroded.find(world.segments.fields);
  std::erase_if(segments, [&](Index s) {
    if (eroded && (*eroded)[s] != 0) return true;
    return std::binary_search(options.left_out.begin(), options.left_out.end(), world.segments.part[s]);
  });
  std::vector<VtkArray> of_nodes, of_segments;
  add_fields(world.nodes.fields, nodes, options, of_nodes);
  add_fields(world.segments.fields, segments, options, of_segments);
  add_element_fields(world, segments, options, of_segments);
  add_stress_invariants(of_segments);
  of_segments.push_back(make_array<Id, 1>("part", "", segments.size(), [&](std::size_t i, Id* to) {
    *to = options.part_ids.at(static_cast<std::size_t>(world.segments.part[segments[i]]));
  }));
  VtkDataSet out{"UnstructuredGrid",
                 fmt::format("NumberOfPoints=\"{}\" NumberOfCells=\"{}\"", nodes.size(), segments.size()),
                 0,
                 {}};
  out.sections.push_back({"PointData", std::move(of_nodes)});
  out.sections.push_back({"CellData", std::move(of_segments)});
  out.sections.push_back({"Points", {node_places(world, nodes, options)}});
  out.sections.push_back(cells(world.segments, segments));
  return out;
}

}  // namespace courant
