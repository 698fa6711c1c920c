// The world as data sets of VTK: the world's own memory, the right cells, and values of the next step seen
// through the same arrays.
#include "vtk/data_sets.hpp"

#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkPointData.h>
#include <vtkSOADataArrayTemplate.h>

#include <stdexcept>

#include "../app/small_scene.hpp"

namespace courant {
namespace {

using test::SmallScene;

/// Water above a cube and a plate of a quadrilateral and a triangle.
SmallScene water_and_elements() {
  SmallScene scene;
  scene.dim = 3, scene.n = 3;
  scene.extra =
      "*NODE\n901,9.,0.,0.\n902,10.,0.,0.\n903,10.,1.,0.\n904,9.,1.,0.\n905,9.,0.,1.\n906,10.,0.,1.\n907,10.,"
      "1.,1.\n"
      "908,9.,1.,1.\n909,9.,9.,0.\n910,10.,9.,0.\n911,10.,10.,0.\n912,9.,10.,0.\n913,11.,9.5,0.\n"
      "*ELEMENT_SOLID\n1,5,901,902,903,904,905,906,907,908\n"
      "*ELEMENT_SHELL\n1,6,909,910,911,912\n2,6,910,913,911,911\n"
      "*SECTION_SOLID\n5,1\n*SECTION_SHELL\n6,2\n0.05\n*MAT_ELASTIC\n5,1000.,1.E7,0.3\n*PART\ncube\n5,5,5\n*"
      "PART\nplate\n6,6,5\n";
  return scene;
}

TEST(VtkDataSets, ParticlesAreTheWorldsOwnMemory) {
  const auto run = test::build(SmallScene{});
  ASSERT_TRUE(run);
  World& world = run->world();
  const auto data = vtk_particles(world);
  ASSERT_EQ(data->GetNumberOfPoints(), 36);
  EXPECT_EQ(data->GetNumberOfVerts(), 36);
  auto* x = vtkSOADataArrayTemplate<Real>::SafeDownCast(data->GetPoints()->GetData());
  ASSERT_TRUE(x);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(x->GetComponentArrayPointer(c), world.particles.x.data(c)) << c;
  vtkDataArray* density = data->GetPointData()->GetArray("density");
  ASSERT_TRUE(density);
  EXPECT_EQ(density->GetVoidPointer(0), world.particles.rho.data());
  world.particles.rho[7] = 1234;
  EXPECT_EQ(density->GetTuple1(7), 1234) << "seen without a new data set";
  vtkDataArray* id = data->GetPointData()->GetArray("id");
  ASSERT_TRUE(id);
  EXPECT_EQ(id->GetTuple1(35), static_cast<double>(world.particles.id[35]));
}

TEST(VtkDataSets, ElementsAndFaces) {
  const auto run = test::build(water_and_elements());
  ASSERT_TRUE(run);
  World& world = run->world();
  ASSERT_EQ(world.groups.size(), 3u) << "solids, quadrilaterals, triangles";
  double volume = 0, area = 0;
  for (const auto& group : world.groups) {
    const auto grid = vtk_elements(world, *group);
    ASSERT_EQ(grid->GetNumberOfCells(), group->size());
    EXPECT_EQ(grid->GetCellData()->GetArray("mass")->GetVoidPointer(0), group->mass.data());
    for (vtkIdType e = 0; e < grid->GetNumberOfCells(); ++e) {
      double box[6];
      vtkCell* cell = grid->GetCell(e);
      cell->GetBounds(box);
      if (cell->GetCellDimension() == 3) volume += (box[1] - box[0]) * (box[3] - box[2]) * (box[5] - box[4]);
      if (cell->GetCellDimension() == 2)
        area += (box[1] - box[0]) * (box[3] - box[2]) * (cell->GetNumberOfPoints() == 3 ? 0.5 : 1);
    }
  }
  EXPECT_DOUBLE_EQ(volume, 1);
  EXPECT_DOUBLE_EQ(area, 1.5);
  const auto faces = vtk_segments(world);
  EXPECT_EQ(faces->GetNumberOfPolys(), world.segments.size());
  EXPECT_TRUE(faces->GetCellData()->GetArray("thickness"));
  EXPECT_TRUE(faces->GetPointData()->GetArray("velocity"));
}

TEST(VtkDataSets, NodesOfTheNextStep) {
  SmallScene scene = water_and_elements();
  scene.extra += "*INITIAL_VELOCITY_GENERATION\n5,2,0.,0.,0.,3.\n0\n";
  const auto run = test::build(scene);
  ASSERT_TRUE(run);
  const auto grid = vtk_elements(run->world(), *run->world().groups.front());
  const auto top = [&] { return grid->GetPoint(grid->GetCell(0)->GetPointId(4))[2]; };
  const double before = top();
  run->step([](World&, const Clock&, const std::string&) {});
  EXPECT_NEAR(top() - before, 3 * run->clock().t, 1e-9 * before);
  EXPECT_GT(run->clock().t, 0);
}

TEST(VtkDataSets, GroupOfAnotherWorld) {
  const auto one = test::build(water_and_elements()), other = test::build(water_and_elements());
  ASSERT_TRUE(one && other);
  EXPECT_THROW(vtk_elements(one->world(), *other->world().groups.front()), std::invalid_argument);
}

}  // namespace
}  // namespace courant
