#include "output/fields/field_writer.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cmath>
#include <csignal>
#include <utility>

#include "../text.hpp"
#include "output_test.hpp"
#include "parallel/job_queue.hpp"

namespace courant {
namespace {

using test::ScratchFolder;

TEST(FieldWriter, ParticlesComeBackInOrderOfIds) {
  ScratchFolder dir;
  World world;
  test::fill_small_world(world);
  FieldWriter writer(dir.path(), {.part_ids = {7, 8}});
  writer.write(world, 0.25, 3);

  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((dir / "fields/particles_0003.vtp").c_str());
  reader->Update();
  vtkPolyData* data = reader->GetOutput();
  ASSERT_EQ(data->GetNumberOfPoints(), 3);
  EXPECT_EQ(data->GetNumberOfVerts(), 3);
  EXPECT_EQ(data->GetFieldData()->GetArray("TimeValue")->GetTuple1(0), 0.25);
  vtkPointData* fields = data->GetPointData();
  const double ids[] = {10, 20, 30}, parts[] = {8, 7, 7}, active[] = {1, 0, 1}, rho[] = {1001, 1002, 1000};
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(fields->GetArray("id")->GetTuple1(i), ids[i]);
    EXPECT_EQ(fields->GetArray("part")->GetTuple1(i), parts[i]);
    EXPECT_EQ(fields->GetArray("active")->GetTuple1(i), active[i]);
    EXPECT_EQ(fields->GetArray("density")->GetTuple1(i), rho[i]);
  }
  EXPECT_EQ(data->GetPoint(1)[0], 0.5);
  EXPECT_EQ(fields->GetArray("velocity")->GetComponent(1, 0), 2.0);
  EXPECT_EQ(fields->GetArray("velocity")->GetDataType(), VTK_FLOAT);
  EXPECT_STREQ(fields->GetArray("density")->GetInformation()->Get(vtkDataArray::UNITS_LABEL()), "M/L3");
  for (const char* name : {"pressure", "internal_energy", "mass", "smoothing_length"})
    EXPECT_TRUE(fields->HasArray(name)) << name;
  EXPECT_FALSE(fields->HasArray("density_rate"));  // not flagged for output
}

TEST(FieldWriter, AccelerationIsForceOverMassInsideTheBox) {
  ScratchFolder dir;
  World world;
  test::fill_small_world(world);
  Particles& p = world.particles;
  p.active = 2;  // the one with id 20 is beside the box
  for (Index i = 0; i < 3; ++i) p.m[i] = 0.5 * (i + 1), p.f.set(i, {3.0, -6.0, 1.5});
  FieldWriter(dir.path(), {.part_ids = {7, 8}, .extra = {"acceleration"}}).write(world, 0, 0);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((dir / "fields/particles_0000.vtp").c_str());
  reader->Update();
  vtkDataArray* a = reader->GetOutput()->GetPointData()->GetArray("acceleration");
  ASSERT_NE(a, nullptr);
  EXPECT_STREQ(a->GetInformation()->Get(vtkDataArray::UNITS_LABEL()), "L/T2");
  const double expected[3][3] = {{3, -6, 1.5}, {0, 0, 0}, {6, -12, 3}};  // ids 10, 20, 30
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c) EXPECT_EQ(a->GetComponent(i, c), expected[i][c]) << i << ' ' << c;
}

TEST(FieldWriter, ShellsComeBackWithContactForce) {
  ScratchFolder dir;
  World world;
  test::fill_small_world(world);
  FieldWriter(dir.path(), {.part_ids = {7, 8}}).write(world, 0, 0);

  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((dir / "fields/shells_0000.vtu").c_str());
  reader->Update();
  vtkUnstructuredGrid* data = reader->GetOutput();
  ASSERT_EQ(data->GetNumberOfCells(), 2);
  EXPECT_EQ(data->GetNumberOfPoints(), 5);
  EXPECT_EQ(data->GetCellType(0), VTK_QUAD);
  EXPECT_EQ(data->GetCellType(1), VTK_TRIANGLE);
  EXPECT_EQ(data->GetCellData()->GetArray("contact_force")->GetComponent(1, 1), -6.0);
  EXPECT_EQ(data->GetCellData()->GetArray("part")->GetTuple1(0), 8);
}

TEST(FieldWriter, HidesInactiveParticles) {
  ScratchFolder dir;
  World world;
  test::fill_small_world(world);
  FieldWriter(dir.path(), {.part_ids = {7, 8}, .hide_inactive = true}).write(world, 0, 0);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((dir / "fields/particles_0000.vtp").c_str());
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 2);
}

TEST(FieldWriter, IndexNamesEachStateAndNoShellsWithoutSegments) {
  ScratchFolder dir;
  World world;
  world.particles.fields.resize(1);
  FieldWriter writer(dir.path(), {.part_ids = {1}});
  writer.write(world, 0, 0);
  writer.write(world, 0.5, 1);
  const std::string pvd = test::read_text(dir / "fields.pvd");
  EXPECT_NE(
      pvd.find(
          "timestep=\"0.5\" group=\"\" part=\"0\" name=\"particles\" file=\"fields/particles_0001.vtp\""),
      std::string::npos);
  EXPECT_EQ(pvd.find("shells"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(dir / "fields.pvd.tmp"));
}

/// Many states that share blocks with the state before, and arrays that are stored for a while: what is read
/// back must be what was written, whatever the encoder kept from earlier states.
TEST(FieldWriter, EveryStateComesBackAsItWasWritten) {
  ScratchFolder dir;
  World world;
  Particles& p = world.particles;
  const Index n = 6000;  // some blocks and a part of one
  p.fields.resize(n);
  p.active = p.moving = n;
  FieldWriter writer(dir.path(), {.part_ids = {1}, .hide_inactive = true});
  const auto noise = [](Index i, int state, int k) {
    return std::sin(1e4 * std::sin(1.0 + i + 0.37 * state + k));
  };
  const auto velocity = [&](Index i, int state) { return Vec(noise(i, state, 0), noise(i, state, 1), 0); };
  const auto pressure = [&](Index i, int state) { return state < 60 ? 5.0 : noise(i, state, 2); };
  const auto density = [&](Index i, int state) {
    return state < 20 ? noise(i, state, 3) : 1000.0 + (i >= n / 2);
  };
  for (int state = 0; state < 150; ++state) {
    for (Index i = 0; i < n; ++i) {
      p.id[i] = n - i;
      p.state[i] = i >= n / 3 + 20 * state ? particle_outside : particle_active;
      p.v.set(i, velocity(i, state));
      p.p[i] = pressure(i, state);
      p.rho[i] = density(i, state);
    }
    writer.write(world, state, state);
  }
  for (int state = 0; state < 150; ++state) {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName((dir / fmt::format("fields/particles_{:04d}.vtp", state)).c_str());
    reader->Update();
    vtkPointData* data = reader->GetOutput()->GetPointData();
    const Index active = n / 3 + 20 * state;
    ASSERT_EQ(reader->GetOutput()->GetNumberOfVerts(), active);
    int wrong = 0;
    for (Index k = 0; k < active; ++k) {
      const Index i = active - 1 - k;  // in order of the ids
      const Vec v = velocity(i, state);
      wrong += data->GetArray("id")->GetTuple1(k) != n - i;
      wrong += data->GetArray("pressure")->GetTuple1(k) != static_cast<float>(pressure(i, state));
      wrong += data->GetArray("density")->GetTuple1(k) != static_cast<float>(density(i, state));
      for (int c = 0; c < 3; ++c)
        wrong += data->GetArray("velocity")->GetComponent(k, c) != static_cast<float>(v[c]);
    }
    ASSERT_EQ(wrong, 0) << "state " << state;
  }
}

TEST(FieldWriter, SameBytesWhetherWrittenAtOnceOrByTheQueue) {
  ScratchFolder at_once, queued;
  World world;
  test::fill_small_world(world);
  for (const auto& [dir, capacity] : {std::pair(&at_once, 0), std::pair(&queued, 2)}) {
    FieldWriter writer(dir->path(), {.part_ids = {7, 8}});
    JobQueue queue(capacity);
    for (int state = 0; state < 40; ++state) {
      world.particles.p[1] = state;
      world.segments.contact_force->set(0, {0, 1.0 * state, 0});
      queue.submit([&writer, taken = writer.take(world, 0.1 * state, state)] { writer.write(taken); });
      world.particles.p[1] = -1;  // the world goes on
    }
    queue.wait();
    writer.finish();
  }
  std::vector<std::string> files = {"fields.pvd"};
  for (int state = 0; state < 40; ++state) {
    files.push_back(fmt::format("fields/particles_{:04d}.vtp", state));
    files.push_back(fmt::format("fields/shells_{:04d}.vtu", state));
  }
  for (const std::string& file : files) {
    EXPECT_EQ(test::read_text(at_once / file), test::read_text(queued / file)) << file;
    EXPECT_FALSE(test::read_text(at_once / file).empty()) << file;
  }
}

/// Of a run that is killed after any state the index must be whole and lack few states.
TEST(FieldWriter, IndexIsWholeAndNeverFarBehind) {
  ScratchFolder dir;
  World world;
  test::fill_small_world(world);
  FieldWriter writer(dir.path(), {.part_ids = {7, 8}});
  const auto listed = [&] {
    const std::string pvd = test::read_text(dir / "fields.pvd");
    const std::string end = "</VTKFile>\n";
    EXPECT_TRUE(pvd.size() > end.size() && pvd.substr(pvd.size() - end.size()) == end);
    return static_cast<int>(test::count(pvd, "particles_"));
  };
  for (int state = 0; state < 100; ++state) {
    writer.write(world, 0.1 * state, state);
    EXPECT_LE(16 * (state + 1 - listed()), state + 1);
  }
  writer.finish();
  EXPECT_EQ(listed(), 100);
}

TEST(FieldWriter, IdsWithLargeGapsAreSortedToo) {
  ScratchFolder dir;
  World world;
  test::fill_small_world(world);
  world.particles.id[0] = Id(1) << 40;
  FieldWriter(dir.path(), {.part_ids = {7, 8}}).write(world, 0, 0);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((dir / "fields/particles_0000.vtp").c_str());
  reader->Update();
  vtkDataArray* ids = reader->GetOutput()->GetPointData()->GetArray("id");
  EXPECT_EQ(ids->GetTuple1(0), 10);
  EXPECT_EQ(ids->GetTuple1(1), 20);
  EXPECT_EQ(ids->GetTuple1(2), 1099511627776.0);
}

/// Runs `body` in a child whose files may not grow beyond `bytes`; gives its exit status.
template <class Body>
int with_file_limit(rlim_t bytes, const Body& body) {
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, bytes};
    setrlimit(RLIMIT_FSIZE, &limit);
    _exit(body());
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 99;
}

TEST(FieldWriter, FullDiskThrowsAndLeavesNoTruncatedFile) {
  ScratchFolder dir;
  World world;
  test::fill_small_world(world);
  const int status = with_file_limit(500, [&] {
    try {
      FieldWriter(dir.path(), {.part_ids = {7, 8}}).write(world, 0, 0);
    } catch (const OutputError& e) {
      const std::string text = e.what();
      const bool helpful =
          text.find("particles_0000.vtp") != std::string::npos && text.find("hint:") != std::string::npos;
      return helpful ? 0 : 2;
    }
    return 1;
  });
  EXPECT_EQ(status, 0);
  EXPECT_TRUE(std::filesystem::is_empty(dir / "fields"));
}

TEST(FieldWriter, UnwritableFolderThrows) {
  EXPECT_THROW(FieldWriter("/proc/courant", {}), OutputError);
}

TEST(NamedFile, FullDeviceThrows) {
  try {
    write_named_file("/dev/full", "a line\n");
    FAIL() << "no error";
  } catch (const OutputError& e) {
    EXPECT_NE(std::string(e.what()).find("No space left on device"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("free some space"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace courant
