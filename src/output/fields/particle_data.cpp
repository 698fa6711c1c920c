#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>

#include "output/fields/field_data.hpp"
#include "output/fields/vtk_arrays.hpp"
#include "state/force_of_now.hpp"

namespace courant {
namespace {

constexpr const char *part = "part", *active = "active", *acceleration = "acceleration";

/// Sorts by id. The ids of a deck are mostly numbered without large gaps: then a table does it, faster.
void sort_by_id(const Field<Id>& id, std::vector<Index>& which) {
  if (which.empty()) return;
  Id low = id[which.front()], high = low;
  for (const Index i : which) low = std::min(low, id[i]), high = std::max(high, id[i]);
  std::vector<Index> sorted;
  if (static_cast<std::size_t>(high - low) < 8 * which.size()) {
    std::vector<Index> at(static_cast<std::size_t>(high - low) + 1, -1);
    for (const Index i : which) at[static_cast<std::size_t>(id[i] - low)] = i;
    std::copy_if(at.begin(), at.end(), std::back_inserter(sorted), [](Index i) { return i >= 0; });
  }
  if (sorted.size() == which.size())
    which = std::move(sorted);
  else  // large gaps, or an id that stands twice
    std::sort(which.begin(), which.end(), [&](Index a, Index b) { return id[a] < id[b]; });
}

/// first, first + 1, ...
VtkArray count_up(std::string name, std::size_t n, Index first) {
  return make_array<Index, 1>(std::move(name), "", n,
                              [first](std::size_t i, Index* to) { *to = first + static_cast<Index>(i); });
}

std::vector<std::string> names_to_write(const Particles& particles, const FieldWriterOptions& options) {
  std::vector<std::string> names = options.fields;
  if (names.empty()) {
    for (const auto& field : particles.fields.all())
      if (field->info().output) names.push_back(field->info().name);
    names.insert(names.end(), {part, active});
  }
  for (const std::string& name : options.extra)
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

VtkArray array_of(const Particles& p, const std::string& name, const std::vector<Index>& which,
                  const FieldWriterOptions& options) {
  const std::size_t n = which.size();
  if (name == part)
    return make_array<Id, 1>(part, "", n, [&](std::size_t i, Id* to) {
      *to = options.part_ids.at(static_cast<std::size_t>(p.part[which[i]]));
    });
  if (name == active)
    return make_array<std::uint8_t, 1>(active, "", n, [&](std::size_t i, std::uint8_t* to) {
      *to = p.state[which[i]] == particle_active ? 1 : 0;
    });
  if (name == acceleration)  // outside the box forces are not known, and do nothing
    return make_reals_of_range<3>(acceleration, "L/T2", n, options.float64, options.eps,
                                  [&](std::size_t i, Real* to) {
                                    const Index k = which[i];
                                    for (int c = 0; c < 3; ++c)
                                      to[c] = k < p.active ? force_of_now(p).data(c)[k] / p.m[k] : 0;
                                  });
  return copy_of(*p.fields.find(name), which, options.float64, options.eps);
}

/// Places as float64 where float32 would be off by more than a thousandth of h, or than may be.
VtkArray places(const Particles& p, const std::vector<Index>& which, Real t,
                const FieldWriterOptions& options) {
  constexpr Real round_off = 0x1p-24, most = 1e-3;
  Real h = which.empty() ? 0 : std::numeric_limits<Real>::infinity(), far = 0;
  std::vector<Vec> place;
  place.reserve(which.size());
  for (const Index i : which) {
    place.push_back(p.place(i, t));
    h = std::min(h, p.h[i]);
    far = std::max(far, place.back().cwiseAbs().maxCoeff());
  }
  const bool too_far = far * round_off > std::max(most, options.epsx) * h;
  return make_reals<3>("Points", "", which.size(), {options.float64 || too_far, options.epsx * h},
                       [&](std::size_t i, Real* to) {
                         for (int k = 0; k < 3; ++k) to[k] = place[i][k];
                       });
}

bool is_left_out(const Particles& p, Index i, Real t, const FieldWriterOptions& options) {
  if (options.hide_inactive && p.state[i] != particle_active) return true;
  if (std::binary_search(options.left_out.begin(), options.left_out.end(), p.part[i])) return true;
  return options.inside && !options.inside(p.place(i, t));
}

}  // namespace

std::vector<std::string> particle_array_names(const World& world) {
  std::vector<std::string> names{part, active, acceleration};
  for (const auto& field : world.particles.fields.all())
    if (field->info().name != part && field->info().name != "position") names.push_back(field->info().name);
  std::sort(names.begin(), names.end());
  return names;
}

VtkDataSet particle_data(const Particles& particles, std::vector<Index> which, Real t,
                         const FieldWriterOptions& options) {
  std::erase_if(which, [&](Index i) { return is_left_out(particles, i, t, options); });
  sort_by_id(particles.id, which);
  const std::size_t n = which.size();
  std::vector<VtkArray> data;
  for (const std::string& name : names_to_write(particles, options))
    if (name == part || name == active || name == acceleration || particles.fields.find(name))
      data.push_back(array_of(particles, name, which, options));
  VtkDataSet out{"PolyData",
                 fmt::format("NumberOfPoints=\"{0}\" NumberOfVerts=\"{0}\" NumberOfLines=\"0\" "
                             "NumberOfStrips=\"0\" NumberOfPolys=\"0\"",
                             n),
                 0,
                 {}};
  out.sections.push_back({"PointData", std::move(data)});
  out.sections.push_back({"Points", {places(particles, which, t, options)}});
  out.sections.push_back({"Verts", {count_up("connectivity", n, 0), count_up("offsets", n, 1)}});
  return out;
}

}  // namespace courant
