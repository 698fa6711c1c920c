#include "vtk/data_sets.hpp"

#include <vtkAOSDataArrayTemplate.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSOADataArrayTemplate.h>

#include <algorithm>
#include <stdexcept>

#include "output/fields/vtk_cell.hpp"

namespace courant {
namespace {

constexpr bool kept_by_courant = true;  // VTK frees nothing of it

template <class T>
vtkSmartPointer<vtkDataArray> array_of(Field<T>& field, Index n) {
  const FieldInfo& info = field.info();
  vtkSmartPointer<vtkDataArray> out;
  if (info.components == 1) {
    const auto array = vtkSmartPointer<vtkAOSDataArrayTemplate<T>>::New();
    array->SetArray(field.data(), n, kept_by_courant);
    out = array;
  } else {
    const auto array = vtkSmartPointer<vtkSOADataArrayTemplate<T>>::New();
    array->SetNumberOfComponents(info.components);
    for (int c = 0; c < info.components; ++c)
      array->SetArray(c, field.data(c), n, c + 1 == info.components, kept_by_courant);
    out = array;
  }
  out->SetName(info.name.c_str());
  return out;
}

/// Null for a field of another type than those that VTK has.
vtkSmartPointer<vtkDataArray> array_of(FieldBase& field, Index n) {
  if (auto* reals = dynamic_cast<Field<Real>*>(&field)) return array_of(*reals, n);
  if (auto* indices = dynamic_cast<Field<Index>*>(&field)) return array_of(*indices, n);
  if (auto* ids = dynamic_cast<Field<Id>*>(&field)) return array_of(*ids, n);
  return nullptr;
}

void add_fields(const FieldSet& set, vtkDataSetAttributes& to) {
  for (const auto& field : set.all())
    if (const auto array = array_of(*field, set.size())) to.AddArray(array);
}

template <class DataSet>
vtkSmartPointer<DataSet> at_places(Field<Real>& x, const FieldSet& set) {
  const auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(array_of(x, set.size()));
  const auto out = vtkSmartPointer<DataSet>::New();
  out->SetPoints(points);
  add_fields(set, *out->GetPointData());
  return out;
}

}  // namespace

vtkSmartPointer<vtkPolyData> vtk_particles(World& world) {
  Particles& p = world.particles;
  auto out = at_places<vtkPolyData>(p.x, p.fields);
  const auto vertices = vtkSmartPointer<vtkCellArray>::New();
  vertices->AllocateExact(p.size(), p.size());
  for (vtkIdType i = 0; i < p.size(); ++i) vertices->InsertNextCell(1, &i);
  out->SetVerts(vertices);
  return out;
}

vtkSmartPointer<vtkPolyData> vtk_segments(World& world) {
  auto out = at_places<vtkPolyData>(world.nodes.x, world.nodes.fields);
  const auto faces = vtkSmartPointer<vtkCellArray>::New();
  for (Index s = 0; s < world.segments.size(); ++s) {
    const auto node = world.segments.nodes(s);
    const vtkIdType corners[] = {node[0], node[1], node[2], node[3]};
    faces->InsertNextCell(node[2] == node[3] ? 3 : 4, corners);
  }
  out->SetPolys(faces);
  add_fields(world.segments.fields, *out->GetCellData());
  return out;
}

vtkSmartPointer<vtkUnstructuredGrid> vtk_elements(World& world, const ElementGroup& group) {
  if (std::none_of(world.groups.begin(), world.groups.end(),
                   [&](const auto& one) { return one.get() == &group; }))
    throw std::invalid_argument("vtk_elements: the group of elements is none of this world");
  auto out = at_places<vtkUnstructuredGrid>(world.nodes.x, world.nodes.fields);
  for (Index e = 0; e < group.size(); ++e) {
    const VtkCell cell = vtk_cell(group, e);
    vtkIdType corners[8];
    std::transform(cell.corners.begin(), cell.corners.end(), corners,
                   [&](int c) { return vtkIdType(group.node.data(c)[e]); });
    out->InsertNextCell(cell.type, static_cast<vtkIdType>(cell.corners.size()), corners);
  }
  add_fields(group.fields, *out->GetCellData());
  return out;
}

}  // namespace courant
