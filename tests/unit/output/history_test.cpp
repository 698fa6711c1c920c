#include "output/history.hpp"

#include <hdf5.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <cmath>
#include <csignal>

#include "output/history_checksum.hpp"
#include "output_test.hpp"

namespace courant {
namespace {

using test::ScratchFolder;

Sample sample_at(Real t) {
  Sample s;
  s.t = t;
  s.dt = 1e-6;
  s.energy.kinetic = 2 * t;
  s.parts = {{.id = 5, .title = "water", .momentum = Vec(t, 2 * t, 3 * t)}};
  InterfaceForce contact;
  contact.id = 9;
  contact.on_surfa = Vec(0, t, 0);
  s.interfaces = {contact};
  s.particles = {{.id = 17, .p = 100 * t}};
  return s;
}

/// Whether all bytes are those that were written.
bool is_whole(const std::filesystem::path& file) {
  std::string content = test::read_text(file);
  return take_history_checksum(content);
}

std::vector<double> read(hid_t file, const char* path, std::vector<hsize_t>* shape = nullptr) {
  const hid_t dataset = H5Dopen2(file, path, H5P_DEFAULT);
  EXPECT_GE(dataset, 0) << path;
  if (dataset < 0) return {};
  const hid_t space = H5Dget_space(dataset);
  hsize_t size[2] = {0, 1};
  const int rank = H5Sget_simple_extent_dims(space, size, nullptr);
  if (shape) shape->assign(size, size + rank);
  std::vector<double> out(size[0] * size[1]);
  H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.data());
  H5Sclose(space);
  H5Dclose(dataset);
  return out;
}

std::string attribute(hid_t file, const char* path, const char* name) {
  const hid_t a = H5Aopen_by_name(file, path, name, H5P_DEFAULT, H5P_DEFAULT);
  EXPECT_GE(a, 0) << path << ' ' << name;
  if (a < 0) return {};
  const hid_t type = H5Aget_type(a);
  std::string out(H5Tget_size(type), ' ');
  H5Aread(a, type, out.data());
  H5Tclose(type);
  H5Aclose(a);
  return out;
}

TEST(History, IsWrittenAnewWhenWholeChunksAreThere) {
  ScratchFolder dir;
  History history(dir / "history.h5", 1024, std::chrono::seconds(1000));
  int taken = 0;
  const auto rows_after = [&](int samples) {
    while (taken < samples) history.record(sample_at(1e-3 * taken++));
    if (!std::filesystem::exists(dir / "history.h5")) return std::size_t{0};
    const hid_t file = H5Fopen((dir / "history.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    const auto t = read(file, "/global/time");
    H5Fclose(file);
    return t.size();
  };
  EXPECT_EQ(rows_after(1023), 0u);
  EXPECT_EQ(rows_after(1024), 1024u);
  EXPECT_EQ(rows_after(1500), 1024u);
  history.flush();
  EXPECT_EQ(rows_after(1500), 1500u);
  EXPECT_EQ(rows_after(3071), 1500u);  // at 2048 there are too few, then the last chunk is not whole
  EXPECT_EQ(rows_after(3072), 3072u);
  EXPECT_EQ(rows_after(20480), 20480u);
  EXPECT_EQ(rows_after(20480 + 2048), 20480u);  // an eighth is more than two chunks
  EXPECT_EQ(rows_after(20480 + 3072), 23552u);
}

TEST(History, GrowsOverSeveralFlushesAndComesBack) {
  ScratchFolder dir;
  History history(dir / "history.h5", 3);
  for (int i = 0; i < 8; ++i) history.record(sample_at(0.5 * i));
  history.flush();

  const hid_t file = H5Fopen((dir / "history.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  const auto t = read(file, "/global/time"), kinetic = read(file, "/global/kinetic"),
             p = read(file, "/particles/17/p");
  std::vector<hsize_t> shape;
  const auto momentum = read(file, "/parts/5/momentum", &shape), force = read(file, "/contacts/9/force");
  ASSERT_EQ(t.size(), 8u);
  EXPECT_EQ(shape, (std::vector<hsize_t>{8, 3}));
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(t[i], 0.5 * static_cast<double>(i));
    EXPECT_EQ(kinetic[i], 2 * t[i]);
    EXPECT_EQ(momentum[3 * i + 2], 3 * t[i]);
    EXPECT_EQ(force[3 * i + 1], t[i]);
    EXPECT_EQ(p[i], 100 * t[i]);
  }
  EXPECT_EQ(attribute(file, "/parts/5/momentum", "dimension"), "ML/T");
  EXPECT_EQ(attribute(file, "/parts/5", "title"), "water");
  H5Fclose(file);
}

// HDF5 crashes on some damaged files: none gets that far.
TEST(History, DamagedFilesAreKnown) {
  ScratchFolder dir;
  const auto name = dir / "history.h5";
  {
    History history(name);
    for (int i = 0; i < 3; ++i) history.record(sample_at(0.5 * i));
    history.flush();
  }
  EXPECT_EQ(History(name).resume(3), 3u) << "it goes on from there";
  const std::string whole = test::read_text(name);
  const auto opens = [&](const std::string& bytes) {
    write_file(name, bytes);
    return is_whole(name);
  };
  EXPECT_TRUE(opens(whole));
  for (std::size_t at = 0; at < whole.size(); at += 997) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 4);
    EXPECT_FALSE(opens(damaged)) << at;
    EXPECT_THROW(History(name).resume(3), OutputError) << at;
  }
  for (const std::size_t left : {std::size_t(0), std::size_t(5), whole.size() / 2, whole.size() - 1})
    EXPECT_FALSE(opens(whole.substr(0, left))) << left;
}

TEST(History, ForcesAndMomentsOnBodiesTellTheirDimensions) {
  ScratchFolder dir;
  Sample s = sample_at(1);
  s.bodies = {{.part = 3, .force = Vec(1, 2, 3), .moment = Vec(4, 5, 6)}};
  s.boundary_forces = {{.kind = BoundaryForce::Kind::driven_body, .id = 3, .moment = Vec(7, 8, 9)}};
  History history(dir / "history.h5");
  history.record(s);
  history.flush();
  const hid_t file = H5Fopen((dir / "history.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  EXPECT_EQ(read(file, "/rigid_bodies/3/moment"), (std::vector<double>{4, 5, 6}));
  EXPECT_EQ(read(file, "/driven_bodies/3/moment"), (std::vector<double>{7, 8, 9}));
  // force M L/T^2 times arm L; force times way L; M L^2 times (L/T over L)^2
  for (const char* path : {"/rigid_bodies/3/moment", "/driven_bodies/3/moment", "/driven_bodies/3/work",
                           "/rigid_bodies/3/kinetic"})
    EXPECT_EQ(attribute(file, path, "dimension"), "ML2/T2") << path;
  for (const char* path : {"/rigid_bodies/3/force", "/driven_bodies/3/force"})
    EXPECT_EQ(attribute(file, path, "dimension"), "ML/T2") << path;
  EXPECT_EQ(attribute(file, "/rigid_bodies/3/omega", "dimension"), "1/T");
  H5Fclose(file);
}

TEST(History, QuantityThatAppearsLateOrVanishesIsNaNElsewhere) {
  ScratchFolder dir;
  History history(dir / "history.h5", 2);
  for (int i = 0; i < 6; ++i) {
    Sample s = sample_at(i);
    if (i < 3 || i > 4) s.particles.clear();
    history.record(s);
  }
  history.flush();
  const hid_t file = H5Fopen((dir / "history.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const auto p = read(file, "/particles/17/p");
  ASSERT_EQ(p.size(), 6u);
  for (int i : {0, 1, 2, 5}) EXPECT_TRUE(std::isnan(p[static_cast<std::size_t>(i)])) << i;
  EXPECT_EQ(p[3], 300);
  EXPECT_EQ(p[4], 400);
  H5Fclose(file);
}

TEST(History, WhatIsSilentAfterARestartTakesNoSamplesFromOthersAtTheNext) {
  ScratchFolder dir;
  for (const int begin : {0, 3, 6}) {
    History history(dir / "history.h5");
    EXPECT_EQ(history.resume(static_cast<std::size_t>(begin)), static_cast<std::size_t>(begin));
    for (int i = begin; i < begin + 3; ++i) {
      Sample s = sample_at(i);
      if (begin > 0) s.particles.clear();  // it has left the box
      history.record(s);
    }
    history.flush();
  }
  const hid_t file = H5Fopen((dir / "history.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const auto t = read(file, "/global/time"), p = read(file, "/particles/17/p");
  H5Fclose(file);
  ASSERT_EQ(t.size(), 9u);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(t[i], static_cast<double>(i));
  ASSERT_GE(p.size(), 6u);
  EXPECT_EQ(p[2], 200);
  for (std::size_t i = 3; i < p.size(); ++i) EXPECT_TRUE(std::isnan(p[i])) << i;
}

TEST(History, FullDiskThrowsAndLeavesNoFile) {
  ScratchFolder dir;
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{2000, 2000};
    setrlimit(RLIMIT_FSIZE, &limit);
    History history(dir / "history.h5");
    history.record(sample_at(1));
    try {
      history.flush();
    } catch (const OutputError& e) {
      _exit(std::string(e.what()).find("history.h5'") != std::string::npos ? 0 : 2);
    }
    _exit(1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_TRUE(std::filesystem::is_empty(dir.path()));
}

TEST(History, UnwritableFolderNamesTheReason) {
  History history("/nowhere/history.h5");
  history.record(sample_at(0));
  EXPECT_THROW(history.flush(), OutputError);
}

}  // namespace
}  // namespace courant
