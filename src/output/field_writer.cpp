#include "output/field_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <type_traits>

namespace courant {
namespace {

template <class T>
constexpr const char* vtk_type = nullptr;
template <>
constexpr const char* vtk_type<float> = "Float32";
template <>
constexpr const char* vtk_type<std::int64_t> = "Int64";
template <>
constexpr const char* vtk_type<std::int32_t> = "Int32";
template <>
constexpr const char* vtk_type<std::uint8_t> = "UInt8";

/// An array of n tuples, each filled by `put(i, to)`.
template <class T, class Put>
VtkArray make_array(std::string name, int components, std::string dimension, std::size_t n, const Put& put) {
  VtkArray out{std::move(name), vtk_type<T>, components, std::move(dimension), {}};
  const std::size_t width = sizeof(T) * static_cast<std::size_t>(components);
  out.bytes.resize(n * width);
  for (std::size_t i = 0; i < n; ++i) {
    T tuple[4];
    put(i, tuple);
    std::memcpy(out.bytes.data() + i * width, tuple, width);
  }
  return out;
}

/// first, first + 1, ...
VtkArray count_up(std::string name, std::size_t n, Index first) {
  return make_array<Index>(std::move(name), 1, "", n,
                           [first](std::size_t i, Index* to) { *to = first + static_cast<Index>(i); });
}

/// Reals as float32.
template <class T>
VtkArray copy(const Field<T>& field, const std::vector<Index>& which, const char* name) {
  using Value = std::conditional_t<std::is_same_v<T, Real>, float, T>;
  const FieldInfo& info = field.info();
  if (info.components == 1)
    return make_array<Value>(
        name, 1, info.dimension, which.size(),
        [&, from = field.data()](std::size_t i, Value* to) { *to = static_cast<Value>(from[which[i]]); });
  const T *x = field.data(0), *y = field.data(1), *z = field.data(2);
  return make_array<Value>(name, 3, info.dimension, which.size(), [&](std::size_t i, Value* to) {
    const Index k = which[i];
    to[0] = static_cast<Value>(x[k]), to[1] = static_cast<Value>(y[k]), to[2] = static_cast<Value>(z[k]);
  });
}

void add_fields(const FieldSet& fields, const std::vector<Index>& which, std::vector<VtkArray>& to) {
  for (const auto& field : fields.all()) {
    const FieldInfo& info = field->info();
    if (!info.output) continue;
    if (const auto* reals = dynamic_cast<const Field<Real>*>(field.get()))
      to.push_back(copy(*reals, which, info.name.c_str()));
    else if (const auto* ids = dynamic_cast<const Field<Id>*>(field.get()))
      to.push_back(copy(*ids, which, info.name.c_str()));
    else if (const auto* indices = dynamic_cast<const Field<Index>*>(field.get()))
      to.push_back(copy(*indices, which, info.name.c_str()));
    else
      throw std::logic_error("field '" + info.name + "' has a type the field files do not know");
  }
}

VtkArray part_numbers(const Field<Index>& part, const std::vector<Index>& which,
                      const std::vector<Id>& part_ids) {
  return make_array<Id>("part", 1, "", which.size(), [&](std::size_t i, Id* to) {
    *to = part_ids.at(static_cast<std::size_t>(part[which[i]]));
  });
}

VtkArray points(const Field<Real>& x, const std::vector<Index>& which) {
  VtkArray out = copy(x, which, "Points");
  out.dimension.clear();  // VTK keeps none with the points
  return out;
}

std::vector<Index> all_of(Index n) {
  std::vector<Index> out(static_cast<std::size_t>(n));
  std::iota(out.begin(), out.end(), 0);
  return out;
}

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

VtkDataSet particle_data(const Particles& particles, std::vector<Index> which, Real t,
                         const FieldWriterOptions& options) {
  if (options.hide_inactive)
    std::erase_if(which, [&](Index i) { return particles.state[i] != particle_active; });
  sort_by_id(particles.id, which);
  const std::size_t n = which.size();

  std::vector<VtkArray> data;
  add_fields(particles.fields, which, data);
  data.push_back(part_numbers(particles.part, which, options.part_ids));
  data.push_back(make_array<std::uint8_t>("active", 1, "", n, [&](std::size_t i, std::uint8_t* to) {
    *to = particles.state[which[i]] == particle_active ? 1 : 0;
  }));
  VtkDataSet out{"PolyData",
                 fmt::format("NumberOfPoints=\"{0}\" NumberOfVerts=\"{0}\" NumberOfLines=\"0\" "
                             "NumberOfStrips=\"0\" NumberOfPolys=\"0\"",
                             n),
                 0,
                 {}};
  out.sections.push_back({"PointData", std::move(data)});
  out.sections.push_back({"Points", {make_array<float>("Points", 3, "", n, [&](std::size_t i, float* to) {
                            const Vec x = particles.place(which[i], t);
                            for (int k = 0; k < 3; ++k) to[k] = static_cast<float>(x[k]);
                          })}});
  out.sections.push_back({"Verts", {count_up("connectivity", n, 0), count_up("offsets", n, 1)}});
  return out;
}

/// The cells of a .vtu: corners of all segments one after the other, where each ends, and its VTK type.
VtkSection cells(const Segments& segments) {
  constexpr std::uint8_t triangle = 5, quad = 9;  // VTK_TRIANGLE, VTK_QUAD
  std::vector<Index> corners, ends;
  std::vector<std::uint8_t> types;
  for (Index s = 0; s < segments.size(); ++s) {
    const auto n = segments.nodes(s);
    const bool three = n[2] == n[3];
    corners.insert(corners.end(), n.begin(), three ? n.end() - 1 : n.end());
    ends.push_back(static_cast<Index>(corners.size()));
    types.push_back(three ? triangle : quad);
  }
  const auto array = [](const char* name, const auto& values) {
    using T = typename std::decay_t<decltype(values)>::value_type;
    return make_array<T>(name, 1, "", values.size(), [&](std::size_t i, T* to) { *to = values[i]; });
  };
  return {"Cells", {array("connectivity", corners), array("offsets", ends), array("types", types)}};
}

VtkDataSet shell_data(const World& world, const FieldWriterOptions& options) {
  const std::vector<Index> nodes = all_of(world.nodes.size()), segments = all_of(world.segments.size());
  std::vector<VtkArray> of_nodes, of_segments;
  add_fields(world.nodes.fields, nodes, of_nodes);
  add_fields(world.segments.fields, segments, of_segments);
  of_segments.push_back(part_numbers(world.segments.part, segments, options.part_ids));
  VtkDataSet out{"UnstructuredGrid",
                 fmt::format("NumberOfPoints=\"{}\" NumberOfCells=\"{}\"", nodes.size(), segments.size()),
                 0,
                 {}};
  out.sections.push_back({"PointData", std::move(of_nodes)});
  out.sections.push_back({"CellData", std::move(of_segments)});
  out.sections.push_back({"Points", {points(world.nodes.x, nodes)}});
  out.sections.push_back(cells(world.segments));
  return out;
}

}  // namespace

FieldWriter::FieldWriter(std::filesystem::path dir, FieldWriterOptions options)
    : dir_(std::move(dir)), options_(std::move(options)) {
  make_folder(dir_ / "fields");
}

FieldState FieldWriter::take(const World& world, Real t, int number) const {
  FieldState state{
      number, t, particle_data(world.particles, all_of(world.particles.size()), t, options_), {}};
  if (world.segments.size() > 0) state.shells = shell_data(world, options_);
  state.particles.t = t;
  if (state.shells) state.shells->t = t;
  return state;
}

void FieldWriter::write(FieldState state) {
  const auto add_entry = [&](int part, const char* name, const std::string& file) {
    entries_ +=
        fmt::format("    <DataSet timestep=\"{:.9g}\" group=\"\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n",
                    state.t, part, name, file);
  };
  ++states_not_listed_;
  std::string file = fmt::format("fields/particles_{:04d}.vtp", state.number);
  const VtkEncoder::File particles = particle_encoder_.encode(std::move(state.particles));
  write_file(dir_ / file, {particles.header, particles.data});
  add_entry(0, "particles", file);
  if (state.shells) {
    file = fmt::format("fields/shells_{:04d}.vtu", state.number);
    const VtkEncoder::File shells = shell_encoder_.encode(std::move(*state.shells));
    write_file(dir_ / file, {shells.header, shells.data});
    add_entry(1, "shells", file);
  }
  ++states_;
  if (16 * states_not_listed_ >= states_ || std::chrono::steady_clock::now() - listed_at_ >= longest_wait_)
    write_index();
}

void FieldWriter::write_failed(const World& world, Real t) {
  const Particles& p = world.particles;
  std::vector<Index> which = all_of(p.moving);  // where the others are is not sure in the middle of a step
  const auto has_place = [](const Vec& x) {
    return x.allFinite() && x.cwiseAbs().maxCoeff() < std::numeric_limits<float>::max();
  };
  std::erase_if(which, [&](Index i) { return !has_place(p.x.vec(i)); });
  if (which.empty()) return;
  const auto put = [&](const char* file, VtkEncoder& encoder, VtkDataSet data) {
    data.t = t;
    const VtkEncoder::File encoded = encoder.encode(std::move(data));
    write_file(dir_ / "fields" / file, {encoded.header, encoded.data});
  };
  put("failed.vtp", particle_encoder_, particle_data(p, std::move(which), t, options_));
  for (Index k = 0; k < world.nodes.size(); ++k)
    if (!has_place(world.nodes.x.vec(k))) return;
  if (world.segments.size() > 0) put("failed_shells.vtu", shell_encoder_, shell_data(world, options_));
}

void FieldWriter::keep(Archive& archive) {
  const Archive::Group inside(archive, "fields");
  archive("entries", entries_);
  archive("states", states_);
}

void FieldWriter::cut(int number) {
  std::error_code error;
  std::vector<std::filesystem::path> later;
  for (std::filesystem::directory_iterator it(dir_ / "fields", error), end; !error && it != end;
       it.increment(error)) {
    const std::string name = it->path().stem().string();
    const std::size_t at = name.find_last_of('_') + 1;
    int found = 0;
    if (std::from_chars(name.data() + at, name.data() + name.size(), found).ec == std::errc() &&
        found >= number)
      later.push_back(it->path());
  }
  write_index();  // first, so that it never names a file that is gone
  for (const auto& file : later)
    if (!std::filesystem::remove(file, error) && error) throw OutputError(file, error.message());
}

void FieldWriter::write_index() {
  write_file(
      dir_ / "fields.pvd",
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n" +
          entries_ + "  </Collection>\n</VTKFile>\n");
  states_not_listed_ = 0;
  listed_at_ = std::chrono::steady_clock::now();
}

void FieldWriter::finish() {
  if (states_not_listed_ > 0) write_index();
}

}  // namespace courant
