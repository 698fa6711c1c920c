#include "post/results.hpp"

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>
#include <vtkStringOutputWindow.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "post/field_file.hpp"

namespace courant {
namespace {

/// Collects what VTK would print.
class VtkMessages {
 public:
  VtkMessages()
      : before_(vtkOutputWindow::GetInstance()), verbosity_(vtkLogger::GetCurrentVerbosityCutoff()) {
    vtkOutputWindow::SetInstance(messages_);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  }
  VtkMessages(const VtkMessages&) = delete;
  VtkMessages& operator=(const VtkMessages&) = delete;
  ~VtkMessages() {
    vtkLogger::SetStderrVerbosity(verbosity_);
    vtkOutputWindow::SetInstance(before_);
  }

 private:
  vtkSmartPointer<vtkOutputWindow> before_;
  vtkLogger::Verbosity verbosity_;
  vtkNew<vtkStringOutputWindow> messages_;
};

bool is_readable(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored);
}

std::optional<FieldFile> load(const std::filesystem::path& file, Diagnostics& diagnostics) {
  if (!is_readable(file)) {
    diagnostics.error({file.string()}, "the file is missing",
                      "fields.pvd names it; was the folder copied in full?");
    return std::nullopt;
  }
  auto out = FieldFile::open(file);
  if (!out)
    diagnostics.error({file.string()}, "not a field file of `courant run`",
                      "it may be truncated; run the deck again");
  return out;
}

/// An array of points with so many components.
std::optional<std::vector<Real>> read_array(FieldFile& from, const std::string& section,
                                            const std::string& name, int components,
                                            const std::filesystem::path& file, Diagnostics& diagnostics) {
  if (from.components(section, name) != components) {
    diagnostics.error(
        {file.string()}, "the array '" + name + "' is missing or has the wrong shape",
        "the file must come from `courant run`, and FIELDS of *COURANT_OUTPUT, if the deck has it, must "
        "name the array");
    return std::nullopt;
  }
  auto values = from.values(section, name, from.points());
  if (!values)
    diagnostics.error({file.string()},
                      "not a field file of `courant run`: the data of '" + name + "' are damaged",
                      "run the deck again");
  return values;
}

}  // namespace

std::vector<StateFiles> read_states(const std::filesystem::path& dir, Diagnostics& diagnostics) {
  const std::filesystem::path file = dir / "fields.pvd";
  const std::string hint = "DIR must be the folder that `courant run -o DIR` wrote";
  if (!is_readable(file)) {
    diagnostics.error({file.string()}, "no results here: the file is missing", hint);
    return {};
  }
  VtkMessages messages;
  const auto root =
      vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(file.c_str()));
  vtkXMLDataElement* collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
  std::map<Real, StateFiles> states;
  for (int i = 0; collection && i < collection->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* entry = collection->GetNestedElement(i);
    double t = 0;
    const char* name = entry->GetAttribute("file");
    if (!name || !entry->GetScalarAttribute("timestep", t)) continue;
    StateFiles& state = states[t];
    state.t = t;
    const std::filesystem::path path = dir / name;
    (path.extension() == ".vtp" ? state.particles : state.shells) = path;
  }
  std::vector<StateFiles> out;
  for (auto& [t, state] : states)
    if (!state.particles.empty()) out.push_back(std::move(state));
  if (out.empty()) diagnostics.error({file.string()}, "the file lists no state with particles", hint);
  return out;
}

std::optional<ParticleFrame> read_particles(const StateFiles& state, bool with_speed,
                                            const std::vector<ParticleArray>& arrays,
                                            Diagnostics& diagnostics) {
  const std::filesystem::path& path = state.particles;
  auto file = load(path, diagnostics);
  if (!file) return std::nullopt;
  const auto read = [&](const char* section, const std::string& name, int components) {
    return read_array(*file, section, name, components, path, diagnostics);
  };
  const auto m = read("PointData", "mass", 1), rho = read("PointData", "density", 1);
  auto h = read("PointData", "smoothing_length", 1);
  const auto v = with_speed ? read("PointData", "velocity", 3) : std::optional<std::vector<Real>>();
  if (!m || !rho || !h || (with_speed && !v)) return std::nullopt;
  const auto x = read("Points", "Points", 3);
  if (!x) return std::nullopt;

  ParticleFrame out;
  for (const ParticleArray& array : arrays) {
    if (array.optional && !file->has("PointData", array.name)) continue;
    auto values = read("PointData", array.name, array.components);
    if (!values) return std::nullopt;
    out.arrays[array.name] = std::move(*values);
  }
  out.t = state.t;
  out.h = std::move(*h);
  for (std::size_t i = 0; i < m->size(); ++i) {
    const Real* place = x->data() + 3 * i;
    out.x.push_back(place[0]);
    out.y.push_back(place[1]);
    out.z.push_back(place[2]);
    out.V.push_back((*m)[i] / (*rho)[i]);
    if (!(std::isfinite(out.V.back()) && out.V.back() > 0 && std::isfinite(place[0] + place[1] + place[2]) &&
          out.h[i] > 0)) {
      diagnostics.error({path.string()},
                        "a particle has no finite position or no positive mass, density or smoothing length",
                        "the run was unstable there; look at an earlier time");
      return std::nullopt;
    }
    if (v) out.speed.push_back(std::hypot((*v)[3 * i], (*v)[3 * i + 1], (*v)[3 * i + 2]));
  }
  out.dim = std::all_of(out.z.begin(), out.z.end(), [&](Real z) { return z == out.z.front(); }) ? 2 : 3;
  return out;
}

std::vector<WallLine> read_walls(const StateFiles& state, Diagnostics& diagnostics) {
  if (state.shells.empty()) return {};
  auto file = load(state.shells, diagnostics);
  if (!file) return {};
  const auto x = read_array(*file, "Points", "Points", 3, state.shells, diagnostics);
  if (!x) return {};
  constexpr std::int64_t most_corners = 32;
  const auto corners = file->integers("Cells", "connectivity", most_corners * file->cells());
  const auto ends = file->integers("Cells", "offsets", file->cells());
  const auto damaged = [&] {
    diagnostics.error({state.shells.string()}, "not a field file of `courant run`: its cells are damaged",
                      "run the deck again");
    return std::vector<WallLine>();
  };
  if (!corners || !ends || static_cast<std::int64_t>(ends->size()) != file->cells()) return damaged();
  std::vector<WallLine> out;
  std::int64_t begin = 0;
  for (const std::int64_t end : *ends) {
    if (end < begin || end > static_cast<std::int64_t>(corners->size())) return damaged();
    WallLine longest{};
    Real length = -1;
    for (std::int64_t i = begin; i < end; ++i) {
      const std::int64_t from = (*corners)[static_cast<std::size_t>(i)],
                         to = (*corners)[static_cast<std::size_t>(i + 1 < end ? i + 1 : begin)];
      if (std::min(from, to) < 0 || std::max(from, to) >= file->points()) return damaged();
      const Real *a = x->data() + 3 * from, *b = x->data() + 3 * to;
      const Real l = std::hypot(b[0] - a[0], b[1] - a[1]);
      if (l > length) longest = {a[0], a[1], b[0], b[1]}, length = l;
    }
    out.push_back(longest);
    begin = end;
  }
  return out;
}

}  // namespace courant
