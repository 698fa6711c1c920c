#include "output/field_writer.hpp"

#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>
#include <vtkTypeUInt8Array.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <numeric>
#include <type_traits>

namespace courant {
namespace {

template <class T>
using VtkArrayOf =
    std::conditional_t<std::is_same_v<T, Real>, vtkFloatArray,
                       std::conditional_t<std::is_same_v<T, Id>, vtkTypeInt64Array, vtkTypeInt32Array>>;

template <class T>
vtkSmartPointer<vtkDataArray> copy(const Field<T>& field, const std::vector<Index>& which) {
  vtkNew<VtkArrayOf<T>> out;
  const int components = field.info().components;
  out->SetName(field.info().name.c_str());
  out->SetNumberOfComponents(components);
  out->SetNumberOfTuples(static_cast<vtkIdType>(which.size()));
  auto* to = out->GetPointer(0);
  for (int k = 0; k < components; ++k) {
    const T* from = field.data(k);
    for (std::size_t i = 0; i < which.size(); ++i)
      to[i * components + k] = static_cast<typename VtkArrayOf<T>::ValueType>(from[which[i]]);
  }
  out->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), field.info().dimension.c_str());
  return out;
}

void add_fields(const FieldSet& fields, const std::vector<Index>& which, vtkDataSetAttributes* to) {
  for (const auto& field : fields.all()) {
    if (!field->info().output) continue;
    if (const auto* reals = dynamic_cast<const Field<Real>*>(field.get()))
      to->AddArray(copy(*reals, which));
    else if (const auto* ids = dynamic_cast<const Field<Id>*>(field.get()))
      to->AddArray(copy(*ids, which));
    else if (const auto* indices = dynamic_cast<const Field<Index>*>(field.get()))
      to->AddArray(copy(*indices, which));
    else
      throw std::logic_error("field '" + field->info().name + "' has a type the field files do not know");
  }
}

void add_part_ids(const Field<Index>& part, const std::vector<Index>& which, const std::vector<Id>& part_ids,
                  vtkDataSetAttributes* to) {
  vtkNew<vtkTypeInt64Array> out;
  out->SetName("part");
  out->SetNumberOfTuples(static_cast<vtkIdType>(which.size()));
  for (std::size_t i = 0; i < which.size(); ++i)
    out->SetValue(static_cast<vtkIdType>(i), part_ids.at(static_cast<std::size_t>(part[which[i]])));
  to->AddArray(out);
}

vtkSmartPointer<vtkPoints> points(const Field<Real>& x, const std::vector<Index>& which) {
  vtkNew<vtkPoints> out;
  out->SetDataTypeToFloat();
  out->SetNumberOfPoints(static_cast<vtkIdType>(which.size()));
  for (std::size_t i = 0; i < which.size(); ++i)
    out->SetPoint(static_cast<vtkIdType>(i), x.vec(which[i]).data());
  return out;
}

void add_time(vtkDataObject* data, Real t) {
  vtkNew<vtkDoubleArray> time;
  time->SetName("TimeValue");
  time->InsertNextValue(t);
  data->GetFieldData()->AddArray(time);
}

std::vector<Index> all_of(Index n) {
  std::vector<Index> out(static_cast<std::size_t>(n));
  std::iota(out.begin(), out.end(), 0);
  return out;
}

vtkSmartPointer<vtkPolyData> particle_data(const Particles& particles, const FieldWriterOptions& options) {
  std::vector<Index> which = all_of(particles.size());
  if (options.hide_inactive)
    std::erase_if(which, [&](Index i) { return particles.state[i] != particle_active; });
  std::sort(which.begin(), which.end(), [&](Index a, Index b) { return particles.id[a] < particles.id[b]; });

  vtkNew<vtkPolyData> out;
  out->SetPoints(points(particles.x, which));
  vtkNew<vtkCellArray> vertices;
  vtkNew<vtkTypeUInt8Array> active;
  active->SetName("active");
  active->SetNumberOfTuples(static_cast<vtkIdType>(which.size()));
  for (vtkIdType i = 0; i < static_cast<vtkIdType>(which.size()); ++i) {
    vertices->InsertNextCell(1, &i);
    active->SetValue(i, particles.state[which[static_cast<std::size_t>(i)]] == particle_active ? 1 : 0);
  }
  out->SetVerts(vertices);
  add_fields(particles.fields, which, out->GetPointData());
  add_part_ids(particles.part, which, options.part_ids, out->GetPointData());
  out->GetPointData()->AddArray(active);
  return out;
}

vtkSmartPointer<vtkUnstructuredGrid> shell_data(const World& world, const FieldWriterOptions& options) {
  const std::vector<Index> nodes = all_of(world.nodes.size()), segments = all_of(world.segments.size());
  vtkNew<vtkUnstructuredGrid> out;
  out->SetPoints(points(world.nodes.x, nodes));
  out->Allocate(world.segments.size());
  for (Index s : segments) {
    const auto n = world.segments.nodes(s);
    const vtkIdType corners[] = {n[0], n[1], n[2], n[3]};
    const bool triangle = n[2] == n[3];
    out->InsertNextCell(triangle ? VTK_TRIANGLE : VTK_QUAD, triangle ? 3 : 4, corners);
  }
  add_fields(world.nodes.fields, nodes, out->GetPointData());
  add_fields(world.segments.fields, segments, out->GetCellData());
  add_part_ids(world.segments.part, segments, options.part_ids, out->GetCellData());
  return out;
}

/// The writer works in memory and the bytes go through write_file: only there is every byte checked. Its
/// errors are caught by an observer, because VTK would print them.
template <class Writer>
void write_data(vtkDataObject* data, const std::filesystem::path& file) {
  vtkNew<Writer> writer;
  std::string complaint;
  vtkNew<vtkCallbackCommand> on_error;
  on_error->SetClientData(&complaint);
  on_error->SetCallback([](vtkObject*, unsigned long, void* client, void* text) {
    if (text) *static_cast<std::string*>(client) += static_cast<const char*>(text);
  });
  writer->AddObserver(vtkCommand::ErrorEvent, on_error);
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
  writer->SetCompressionLevel(1);  // higher levels cost several times the time for little
  writer->WriteToOutputStringOn();
  if (writer->Write() != 1 || writer->GetErrorCode() != 0)
    throw OutputError(file,
                      fmt::format("VTK's writer failed with code {} {}", writer->GetErrorCode(), complaint));
  write_file(file, writer->GetOutputString());
}

}  // namespace

FieldWriter::FieldWriter(std::filesystem::path dir, FieldWriterOptions options)
    : dir_(std::move(dir)), options_(std::move(options)) {
  make_folder(dir_ / "fields");
}

void FieldWriter::write(const World& world, Real t, int state) {
  const auto add_entry = [&](int part, const char* name, const std::string& file) {
    entries_ +=
        fmt::format("    <DataSet timestep=\"{:.9g}\" group=\"\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n", t,
                    part, name, file);
  };
  index_written_ = false;
  const auto particles = particle_data(world.particles, options_);
  add_time(particles, t);
  std::string file = fmt::format("fields/particles_{:04d}.vtp", state);
  write_data<vtkXMLPolyDataWriter>(particles, dir_ / file);
  add_entry(0, "particles", file);
  if (world.segments.size() > 0) {
    const auto shells = shell_data(world, options_);
    add_time(shells, t);
    file = fmt::format("fields/shells_{:04d}.vtu", state);
    write_data<vtkXMLUnstructuredGridWriter>(shells, dir_ / file);
    add_entry(1, "shells", file);
  }
  write_index();
}

void FieldWriter::write_index() {
  write_file(
      dir_ / "fields.pvd",
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n" +
          entries_ + "  </Collection>\n</VTKFile>\n");
  index_written_ = true;
}

void FieldWriter::finish() {
  if (!index_written_) write_index();
}

}  // namespace courant
