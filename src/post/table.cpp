#include "post/table.hpp"

#include <fmt/format.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkXMLImageDataWriter.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "output/file.hpp"
#include "output/hdf5.hpp"

namespace courant {
namespace {

void write_column(hid_t file, const std::string& path, const PostColumn& column) {
  const hsize_t rows = column.values.size();
  const Hdf5Handle space(H5Screate_simple(1, &rows, nullptr), H5Sclose),
      links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links, 1);
  const Hdf5Handle dataset(
      H5Dcreate2(file, path.c_str(), H5T_IEEE_F64LE, space, links, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose), scalar(H5Screate(H5S_SCALAR), H5Sclose);
  H5Tset_size(type, std::max<std::size_t>(1, column.unit.size()));
  const Hdf5Handle unit(H5Acreate2(dataset, "unit", type, scalar, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (dataset < 0 || unit < 0 ||
      (rows > 0 &&
       H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, column.values.data()) < 0) ||
      H5Awrite(unit, type, column.unit.empty() ? "-" : column.unit.c_str()) < 0)
    throw OutputError(path, "HDF5 failed");
}

}  // namespace

const PostColumn* PostTable::find(const std::string& column) const {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const PostColumn& c) { return c.name == column; });
  return found == columns.end() ? nullptr : &*found;
}

std::string csv_text(const PostTable& table) {
  fmt::memory_buffer out;
  const auto to = std::back_inserter(out);
  const char* comma = "";
  for (const PostColumn& column : table.columns) {
    fmt::format_to(to, "{}{} [{}]", comma, column.name, column.unit);
    comma = ",";
  }
  out.push_back('\n');
  for (std::size_t row = 0; row < table.rows(); ++row) {
    comma = "";
    for (const PostColumn& column : table.columns) {
      const Real value = column.values[row];
      if (std::isnan(value))
        fmt::format_to(to, "{}nan", comma);  // without the sign that some NaN have
      else
        fmt::format_to(to, "{}{:.9g}", comma, value);
      comma = ",";
    }
    out.push_back('\n');
  }
  return fmt::to_string(out);
}

void write_tables_h5(const std::filesystem::path& file, const std::vector<PostTable>& tables) {
  const Hdf5Silence silence;
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST);
  H5Pset_fapl_core(access, 1 << 20, false);  // in memory: a full disk is then a failed write, not a crash
  const std::string name = file.string() + ".in_memory";
  const Hdf5Handle h5(H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
  if (h5 < 0) throw OutputError(file, "HDF5 failed");
  for (const PostTable& table : tables)
    for (const PostColumn& column : table.columns) {
      std::string leaf = column.name;  // a slash would make a group
      std::replace(leaf.begin(), leaf.end(), '/', '|');
      write_column(h5, "/" + table.name + "/" + leaf, column);
    }
  H5Fflush(h5, H5F_SCOPE_LOCAL);
  const ssize_t size = H5Fget_file_image(h5, nullptr, 0);
  if (size <= 0) throw OutputError(file, "HDF5 failed");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(h5, bytes.data(), bytes.size()) < 0) throw OutputError(file, "HDF5 failed");
  write_file(file, bytes);
}

void write_vti(const std::filesystem::path& file, const PostImage& image) {
  vtkNew<vtkImageData> data;
  data->SetDimensions(image.n.data());
  data->SetOrigin(image.origin.data());
  data->SetSpacing(image.spacing.data());
  for (const PostColumn& field : image.fields) {
    vtkNew<vtkFloatArray> array;
    array->SetName(field.name.c_str());
    array->SetNumberOfTuples(static_cast<vtkIdType>(field.values.size()));
    for (std::size_t i = 0; i < field.values.size(); ++i)
      array->SetValue(static_cast<vtkIdType>(i), static_cast<float>(field.values[i]));
    data->GetPointData()->AddArray(array);
  }
  vtkNew<vtkDoubleArray> time;
  time->SetName("TimeValue");
  time->InsertNextValue(image.t);
  data->GetFieldData()->AddArray(time);
  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetInputData(data);
  writer->WriteToOutputStringOn();
  writer->Write();
  write_file(file, writer->GetOutputString());
}

}  // namespace courant
