#pragma once
// The world as data sets of VTK, for programs that embed Courant and read a run in progress. Arrays are the
// world's own, nothing is copied: they hold until the next step, as fields may move when particles are
// sorted; what a filter keeps longer has to be copied (DeepCopy). Values may change through them, at your own
// risk.
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include "state/world.hpp"

namespace courant {

/// All particles as vertices; each field of theirs is point data under its name (docs/notation.md), in units
/// of the deck. Those behind `world.particles.moving` stand where they were at `dormant_time`.
vtkSmartPointer<vtkPolyData> vtk_particles(World& world);

/// Faces of shells and skins of solids as quadrilaterals and triangles between all nodes; fields of the
/// segments are cell data, those of the nodes point data.
vtkSmartPointer<vtkPolyData> vtk_segments(World& world);

/// Elements of one group, that is of one part, between all nodes; fields of the group are cell data, those of
/// the nodes point data. Throws std::invalid_argument for a group of another world.
vtkSmartPointer<vtkUnstructuredGrid> vtk_elements(World& world, const ElementGroup& group);

}  // namespace courant
