#include "output/fields/field_writer.hpp"

#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <limits>

#include "output/fields/field_data.hpp"
#include "output/fields/vtk_arrays.hpp"
#include "output/result_names.hpp"

namespace courant {

namespace {

/// Names and values of arrays, which is what sections are compared by.
void keep_sections(const std::string& name, std::vector<VtkSection>& sections, Archive& archive) {
  const Archive::Group inside(archive, name);
  std::vector<std::int64_t> arrays, sizes;
  std::vector<std::string> names;
  std::vector<char> values;
  for (const VtkSection& section : sections) {
    arrays.push_back(static_cast<std::int64_t>(section.arrays.size()));
    for (const VtkArray& array : section.arrays) {
      names.push_back(array.name);
      sizes.push_back(static_cast<std::int64_t>(array.bytes.size()));
      values.insert(values.end(), array.bytes.begin(), array.bytes.end());
    }
  }
  archive("arrays", arrays);
  archive("names", names);
  archive("sizes", sizes);
  archive("values", values);
  if (!archive.loading()) return;
  sections.clear();
  std::size_t k = 0;
  auto at = values.begin();
  for (const std::int64_t count : arrays) {
    VtkSection section{"", {}};
    for (std::int64_t n = 0; n < count; ++n, ++k) {
      if (k >= names.size() || k >= sizes.size() || sizes[k] < 0 || sizes[k] > values.end() - at)
        archive.stop("sizes", "counts values that are not there");
      VtkArray array;
      array.name = names.at(k);
      array.bytes.assign(at, at + sizes.at(k));
      at += sizes.at(k);
      section.arrays.push_back(std::move(array));
    }
    sections.push_back(std::move(section));
  }
}

/// A number each, whose name has the title: meshio stops at field data of text.
std::vector<VtkArray> titles_of(const FieldWriterOptions& options) {
  std::vector<VtkArray> out;
  for (std::size_t k = 0; k < options.part_ids.size() && k < options.part_titles.size(); ++k) {
    if (options.part_titles[k].empty()) continue;
    const std::string name = fmt::format("part {}: {}", options.part_ids[k], options.part_titles[k]);
    out.push_back(
        make_array<Id, 1>(in_xml(name), "", 1, [&](std::size_t, Id* to) { *to = options.part_ids[k]; }));
  }
  return out;
}

/// Groups of shells are shown with the faces.
bool has_solids(const World& world) {
  return std::any_of(world.groups.begin(), world.groups.end(),
                     [](const auto& group) { return group->segment == nullptr; });
}

}  // namespace

FieldWriter::FieldWriter(std::filesystem::path dir, FieldWriterOptions options)
    : dir_(std::move(dir)),
      options_(std::move(options)),
      particle_encoder_(options_.compression),
      shell_encoder_(options_.compression),
      solid_encoder_(options_.compression) {
  make_folder(dir_ / "fields");
  titles_ = titles_of(options_);
}

FieldState FieldWriter::take(const World& world, Real t, int number) const {
  FieldState state{.number = number, .t = t, .particles = {}, .shells = {}, .solids = {}};
  if (world.particles.size() > 0)
    state.particles = particle_data(world.particles, all_of(world.particles.size()), t, options_);
  if (world.segments.size() > 0) state.shells = shell_data(world, options_);
  if (has_solids(world)) state.solids = solid_data(world, options_);
  for (auto* data : {&state.particles, &state.shells, &state.solids})
    if (*data) (*data)->t = t, (*data)->facts = titles_;
  return state;
}

void FieldWriter::write(FieldState state) {
  const auto add_entry = [&](int part, const char* name, const std::string& file) {
    entries_ +=
        fmt::format("    <DataSet timestep=\"{:.9g}\" group=\"\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n",
                    state.t, part, name, file);
  };
  ++states_not_listed_;
  if (state.particles) {
    const std::string file = fmt::format("fields/particles_{:04d}.vtp", state.number);
    put(file, particle_encoder_, std::move(*state.particles));
    add_entry(0, "particles", file);
  }
  if (state.solids) {
    const std::string file = fmt::format("fields/solids_{:04d}.vtu", state.number);
    put(file, solid_encoder_, std::move(*state.solids));
    add_entry(2, "solids", file);
  }
  if (state.shells) {
    if (!options_.sparse_shells || shell_file_.empty() || state.shells->sections != shells_before_) {
      shell_file_ = fmt::format("fields/shells_{:04d}.vtu", state.number);
      if (options_.sparse_shells) shells_before_ = state.shells->sections;
      put(shell_file_, shell_encoder_, std::move(*state.shells));
    }
    add_entry(1, "shells", shell_file_);
  }
  ++states_;
  if (16 * states_not_listed_ >= states_ || std::chrono::steady_clock::now() - listed_at_ >= longest_wait_)
    write_index();
}

void FieldWriter::put(const std::string& file, VtkEncoder& encoder, VtkDataSet data) {
  const VtkEncoder::File encoded = encoder.encode(std::move(data));
  write_file(result_path(dir_, file), {encoded.header, encoded.data});
  bytes_ += static_cast<std::int64_t>(encoded.header.size() + encoded.data.size());
}

void FieldWriter::write_failed(const World& world, Real t) {
  const Particles& p = world.particles;
  std::vector<Index> which = all_of(p.moving);  // where the others are is not sure in the middle of a step
  const auto has_place = [](const Vec& x) {
    return x.allFinite() && x.cwiseAbs().maxCoeff() < std::numeric_limits<float>::max();
  };
  std::erase_if(which, [&](Index i) { return !has_place(p.x.vec(i)); });
  FieldWriterOptions all = options_;  // of what went wrong nothing is rounded or hidden
  all.eps = all.epsx = 0;
  all.inside = {};
  const auto put_failed = [&](const char* file, VtkEncoder& encoder, VtkDataSet data) {
    data.t = t;
    put(std::string("fields/") + file, encoder, std::move(data));
  };
  if (!which.empty()) put_failed("failed.vtp", particle_encoder_, particle_data(p, std::move(which), t, all));
  for (Index k = 0; k < world.nodes.size(); ++k)
    if (!has_place(world.nodes.x.vec(k))) return;
  if (has_solids(world)) put_failed("failed_solids.vtu", solid_encoder_, solid_data(world, all));
  if (world.segments.size() > 0) put_failed("failed_shells.vtu", shell_encoder_, shell_data(world, all));
}

void FieldWriter::keep(Archive& archive) {
  const Archive::Group inside(archive, "fields");
  archive("entries", entries_);
  archive("states", states_);
  archive("bytes", bytes_);
  archive("shell_file", shell_file_);
  keep_sections("shells_before", shells_before_, archive);
  const auto keep_encoder = [&](const char* name, VtkEncoder& encoder) {
    const Archive::Group group(archive, name);
    encoder.keep(archive);
  };
  keep_encoder("particles", particle_encoder_);
  keep_encoder("shells", shell_encoder_);
  keep_encoder("solids", solid_encoder_);
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
      result_path(dir_, result_names::fields_index),
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
