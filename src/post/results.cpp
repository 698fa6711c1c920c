#include "post/results.hpp"

#include <vtkCell.h>
#include <vtkDataArray.h>
#include <vtkDataArraySelection.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringOutputWindow.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "post/field_file_sizes.hpp"

namespace courant {
namespace {

/// Collects what VTK would print. Some of its readers' failures can be told by nothing else.
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
  bool any() { return !messages_->GetOutput().empty(); }

 private:
  vtkSmartPointer<vtkOutputWindow> before_;
  vtkLogger::Verbosity verbosity_;
  vtkNew<vtkStringOutputWindow> messages_;
};

bool is_readable(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored);
}

template <class Reader>
bool load(Reader* reader, VtkMessages& messages, const std::filesystem::path& file,
          Diagnostics& diagnostics) {
  if (!is_readable(file)) {
    diagnostics.error({file.string()}, "the file is missing",
                      "fields.pvd names it; was the folder copied in full?");
    return false;
  }
  reader->SetFileName(file.c_str());
  if (sizes_fit(file) && reader->CanReadFile(file.c_str()) == 1) {
    reader->Update();
    if (reader->GetErrorCode() == 0 && !messages.any()) return true;
  }
  diagnostics.error({file.string()}, "not a field file that VTK can read",
                    "it may be truncated; run the deck again");
  return false;
}

vtkDataArray* find_array(vtkPolyData* data, const char* name, int components,
                         const std::filesystem::path& file, Diagnostics& diagnostics) {
  vtkDataArray* array = data->GetPointData()->GetArray(name);
  if (array && array->GetNumberOfComponents() == components &&
      array->GetNumberOfTuples() == data->GetNumberOfPoints())
    return array;
  diagnostics.error(
      {file.string()}, std::string("the array '") + name + "' is missing or has the wrong shape",
      "the file must come from `courant run`, and FIELDS of *COURANT_OUTPUT, if the deck has it, must "
      "name the array");
  return nullptr;
}

void copy(vtkDataArray* from, std::vector<Real>& to) {
  const int components = from->GetNumberOfComponents();
  to.reserve(static_cast<std::size_t>(from->GetNumberOfTuples() * components));
  for (vtkIdType i = 0; i < from->GetNumberOfTuples(); ++i)
    for (int k = 0; k < components; ++k) to.push_back(from->GetComponent(i, k));
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
  VtkMessages messages;
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(state.particles.c_str());
  if (is_readable(state.particles) && sizes_fit(state.particles)) reader->UpdateInformation();
  reader->GetPointDataArraySelection()->DisableAllArrays();  // reading less is most of the speed
  for (const char* name : {"mass", "density", "smoothing_length"})
    reader->GetPointDataArraySelection()->EnableArray(name);
  if (with_speed) reader->GetPointDataArraySelection()->EnableArray("velocity");
  for (const ParticleArray& array : arrays)
    reader->GetPointDataArraySelection()->EnableArray(array.name.c_str());
  if (!load(reader.Get(), messages, state.particles, diagnostics)) return std::nullopt;

  vtkPolyData* data = reader->GetOutput();
  vtkDataArray* m = find_array(data, "mass", 1, state.particles, diagnostics);
  vtkDataArray* rho = find_array(data, "density", 1, state.particles, diagnostics);
  vtkDataArray* h = find_array(data, "smoothing_length", 1, state.particles, diagnostics);
  vtkDataArray* v = with_speed ? find_array(data, "velocity", 3, state.particles, diagnostics) : nullptr;
  if (!m || !rho || !h || (with_speed && !v)) return std::nullopt;

  ParticleFrame out;
  for (const ParticleArray& array : arrays) {
    if (array.optional && !data->GetPointData()->HasArray(array.name.c_str())) continue;
    vtkDataArray* from = find_array(data, array.name.c_str(), array.components, state.particles, diagnostics);
    if (!from) return std::nullopt;
    copy(from, out.arrays[array.name]);
  }
  out.t = state.t;
  const vtkIdType n = data->GetNumberOfPoints();
  for (vtkIdType i = 0; i < n; ++i) {
    const double* x = data->GetPoint(i);
    out.x.push_back(x[0]);
    out.y.push_back(x[1]);
    out.z.push_back(x[2]);
    out.V.push_back(m->GetComponent(i, 0) / rho->GetComponent(i, 0));
    out.h.push_back(h->GetComponent(i, 0));
    if (!(std::isfinite(out.V.back()) && out.V.back() > 0 && std::isfinite(x[0] + x[1] + x[2]) &&
          out.h.back() > 0)) {
      diagnostics.error({state.particles.string()},
                        "a particle has no finite position or no positive mass, density or smoothing length",
                        "the run was unstable there; look at an earlier time");
      return std::nullopt;
    }
    if (v)
      out.speed.push_back(std::hypot(v->GetComponent(i, 0), v->GetComponent(i, 1), v->GetComponent(i, 2)));
  }
  out.dim = std::all_of(out.z.begin(), out.z.end(), [&](Real z) { return z == out.z.front(); }) ? 2 : 3;
  return out;
}

std::vector<WallLine> read_walls(const StateFiles& state, Diagnostics& diagnostics) {
  if (state.shells.empty()) return {};
  VtkMessages messages;
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  if (!load(reader.Get(), messages, state.shells, diagnostics)) return {};
  std::vector<WallLine> out;
  vtkUnstructuredGrid* data = reader->GetOutput();
  for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c) {
    vtkCell* cell = data->GetCell(c);
    WallLine longest{};
    Real length = -1;
    for (vtkIdType i = 0; i < cell->GetNumberOfPoints(); ++i) {
      std::array<double, 3> a{}, b{};
      data->GetPoint(cell->GetPointId(static_cast<int>(i)), a.data());
      data->GetPoint(cell->GetPointId(static_cast<int>((i + 1) % cell->GetNumberOfPoints())), b.data());
      const Real l = std::hypot(b[0] - a[0], b[1] - a[1]);
      if (l > length) longest = {a[0], a[1], b[0], b[1]}, length = l;
    }
    out.push_back(longest);
  }
  return out;
}

}  // namespace courant
