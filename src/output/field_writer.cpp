#include "output/field_writer.hpp"

#include <fmt/format.h>

#include <chrono>
#include <limits>

#include "output/field_data.hpp"
#include "output/vtk_arrays.hpp"

namespace courant {

FieldWriter::FieldWriter(std::filesystem::path dir, FieldWriterOptions options)
    : dir_(std::move(dir)),
      options_(std::move(options)),
      particle_encoder_(options_.compression),
      shell_encoder_(options_.compression) {
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
  put(file, particle_encoder_, std::move(state.particles));
  add_entry(0, "particles", file);
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
  write_file(dir_ / file, {encoded.header, encoded.data});
  bytes_ += static_cast<std::int64_t>(encoded.header.size() + encoded.data.size());
}

void FieldWriter::write_failed(const World& world, Real t) {
  const Particles& p = world.particles;
  std::vector<Index> which = all_of(p.moving);  // where the others are is not sure in the middle of a step
  const auto has_place = [](const Vec& x) {
    return x.allFinite() && x.cwiseAbs().maxCoeff() < std::numeric_limits<float>::max();
  };
  std::erase_if(which, [&](Index i) { return !has_place(p.x.vec(i)); });
  if (which.empty()) return;
  FieldWriterOptions all = options_;  // of what went wrong nothing is rounded or hidden
  all.eps = all.epsx = 0;
  all.inside = {};
  const auto put_failed = [&](const char* file, VtkEncoder& encoder, VtkDataSet data) {
    data.t = t;
    put(std::string("fields/") + file, encoder, std::move(data));
  };
  put_failed("failed.vtp", particle_encoder_, particle_data(p, std::move(which), t, all));
  for (Index k = 0; k < world.nodes.size(); ++k)
    if (!has_place(world.nodes.x.vec(k))) return;
  if (world.segments.size() > 0) put_failed("failed_shells.vtu", shell_encoder_, shell_data(world, all));
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
