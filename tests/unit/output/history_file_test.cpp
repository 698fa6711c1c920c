// history.h5 and the files beside it as a whole: every dataset with its numbers and its dimension, gauges
// with rows of their own, and what a restart cuts and goes on with.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>
#include <map>

#include "../text.hpp"
#include "full_sample.hpp"
#include "output/ascii/ascii.hpp"
#include "output/history.hpp"
#include "output_test.hpp"

namespace courant::history_file_test {
namespace {

struct Dataset {
  std::string dimension{};
  std::vector<Real> values{};
};

/// What is in a file, and titles of its groups.
struct Content {
  std::map<std::string, Dataset> datasets{};
  std::map<std::string, std::string> titles{};

  explicit Content(const std::filesystem::path& path) {
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    EXPECT_GE(file, 0) << path;
    std::vector<std::pair<std::string, bool>> names;
    const auto note = [](hid_t, const char* name, const H5O_info_t* info, void* to) -> herr_t {
      static_cast<std::vector<std::pair<std::string, bool>>*>(to)->emplace_back(
          name, info->type == H5O_TYPE_DATASET);
      return 0;
    };
    H5Ovisit(file, H5_INDEX_NAME, H5_ITER_NATIVE, note, &names);
    for (const auto& [name, is_dataset] : names)
      if (is_dataset)
        read(file, name);
      else if (const std::string title = text(file, name, "title"); !title.empty())
        titles[name] = title;
    H5Fclose(file);
  }
  std::vector<Real> operator[](const std::string& path) const {
    const auto found = datasets.find(path);
    return found == datasets.end() ? std::vector<Real>() : found->second.values;
  }

 private:
  void read(hid_t file, const std::string& name) {
    const hid_t dataset = H5Dopen2(file, name.c_str(), H5P_DEFAULT), space = H5Dget_space(dataset);
    Dataset& to = datasets[name];
    to.values.resize(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, to.values.data());
    H5Sclose(space), H5Dclose(dataset);
    to.dimension = text(file, name, "dimension");
  }
  static std::string text(hid_t file, const std::string& object, const char* name) {
    if (H5Aexists_by_name(file, object.c_str(), name, H5P_DEFAULT) <= 0) return "";
    const hid_t a = H5Aopen_by_name(file, object.c_str(), name, H5P_DEFAULT, H5P_DEFAULT),
                type = H5Aget_type(a);
    std::string out(H5Tget_size(type), ' ');
    H5Aread(a, type, out.data());
    H5Tclose(type), H5Aclose(a);
    return out;
  }
};

Sample sample_at(Real t) {
  Sample s = test::sample_of_all();
  s.t = t, s.dt = 0.25, s.cycle = 7;
  s.parts[0].title = "water", s.interfaces[0].title = "floor", s.rigid_walls[1].title = "wall";
  s.particles[0].x = Vec(1.5, 2.5, 3.5), s.particles[0].v = Vec(4.5, 5.5, 6.5), s.particles[0].E = 7.5;
  s.particles[0].neighbours = 21;
  s.added.emplace_back();
  s.added[0].numbers.values = {{"/joints/4/force", "ML/T2", {1.25, 2.25, 3.25}},
                               {"/joints/4/angle", "-", {0.5}}};
  s.added[0].numbers.titles = {{"/joints/4", "hinge"}, {"/joints/5", ""}};
  return s;
}

}  // namespace

// What a force is, a force is in every group, and so on; nothing is without a dimension.
TEST(HistoryFile, EachDatasetHasItsDimension) {
  const std::map<std::string, std::string> of_name = {{"time", "T"},
                                                      {"dt", "T"},
                                                      {"cycle", "-"},
                                                      {"mass", "M"},
                                                      {"velocity", "L/T"},
                                                      {"v", "L/T"},
                                                      {"x", "L"},
                                                      {"displacement", "L"},
                                                      {"a", "L/T2"},
                                                      {"omega", "1/T"},
                                                      {"angular_a", "1/T2"},
                                                      {"rotation", "-"},
                                                      {"force", "ML/T2"},
                                                      {"moment", "ML2/T2"},
                                                      {"work", "ML2/T2"},
                                                      {"impulse", "ML/T"},
                                                      {"momentum", "ML/T"},
                                                      {"p", "M/LT2"},
                                                      {"tau", "M/LT2"},
                                                      {"E", "M/LT2"},
                                                      {"rho", "M/L3"},
                                                      {"h", "L"},
                                                      {"neighbours", "-"},
                                                      {"active", "-"},
                                                      {"angle", "-"},
                                                      {"kinetic", "ML2/T2"},
                                                      {"internal", "ML2/T2"},
                                                      {"potential", "ML2/T2"},
                                                      {"contact", "ML2/T2"},
                                                      {"hourglass", "ML2/T2"},
                                                      {"bulk_viscosity", "ML2/T2"},
                                                      {"dissipated", "ML2/T2"},
                                                      {"external_work", "ML2/T2"},
                                                      {"total", "ML2/T2"},
                                                      {"residual", "ML2/T2"},
                                                      {"throughput", "ML2/T2"},
                                                      {"energy_stored", "ML2/T2"},
                                                      {"energy_damping", "ML2/T2"},
                                                      {"energy_friction", "ML2/T2"}};
  test::ScratchFolder folder;
  History history(folder / "history.h5");
  history.record(sample_at(3)), history.flush();
  const Content file(folder / "history.h5");
  EXPECT_GT(file.datasets.size(), 70u);
  for (const auto& [path, dataset] : file.datasets) {
    const auto expected = of_name.find(path.substr(path.rfind('/') + 1));
    ASSERT_NE(expected, of_name.end()) << path;
    EXPECT_EQ(dataset.dimension, expected->second) << path;
  }
  EXPECT_EQ(file.titles, (std::map<std::string, std::string>{{"parts/5", "water"},
                                                             {"parts/6", std::string(1, '\0')},
                                                             {"contacts/5", "floor"},
                                                             {"contacts/6", std::string(1, '\0')},
                                                             {"rigid_walls/5", std::string(1, '\0')},
                                                             {"rigid_walls/6", "wall"},
                                                             {"joints/4", "hinge"}}));
}

TEST(HistoryFile, ParticlesAndTheClockHaveTheirNames) {
  test::ScratchFolder folder;
  const Sample s = sample_at(3);
  const ParticleSample& p = s.particles[0];
  History history(folder / "history.h5");
  history.record(s), history.flush();
  const Content file(folder / "history.h5");
  using Values = std::vector<Real>;
  EXPECT_EQ(file["global/time"], Values{3});
  EXPECT_EQ(file["global/dt"], Values{0.25});
  EXPECT_EQ(file["global/cycle"], Values{7});
  EXPECT_EQ(file["global/bulk_viscosity"], Values{s.energy.bulk_viscosity});
  EXPECT_EQ(file["particles/17/x"], (Values{1.5, 2.5, 3.5}));
  EXPECT_EQ(file["particles/17/v"], (Values{4.5, 5.5, 6.5}));
  EXPECT_EQ(file["particles/17/p"], Values{p.p});
  EXPECT_EQ(file["particles/17/rho"], Values{p.rho});
  EXPECT_EQ(file["particles/17/h"], Values{p.h});
  EXPECT_EQ(file["particles/17/E"], Values{7.5});
  EXPECT_EQ(file["particles/17/tau"], Values(p.tau.begin(), p.tau.end()));
  EXPECT_EQ(file["particles/17/neighbours"], Values{21});
  EXPECT_EQ(file["particles/17/active"], Values{1});
  EXPECT_EQ(file["joints/4/force"], (Values{1.25, 2.25, 3.25}));
  EXPECT_EQ(file["joints/4/angle"], Values{0.5});
  Sample gone = s;
  gone.particles[0].active = false, gone.nodes[0].turns = false;
  History second(folder / "second.h5");
  second.record(gone), second.flush();
  const Content other(folder / "second.h5");
  EXPECT_EQ(other["particles/17/active"], Values{0});
  EXPECT_TRUE(other.datasets.contains("nodes/3/a"));
  EXPECT_FALSE(other.datasets.contains("nodes/3/omega")) << "of a node that does not turn";
}

namespace {

const GaugeLayout level{.name = "level", .title = "at the wall", .columns = {{"h", "L", 1}, {"u", "L/T", 3}}};
/// A sample at t with the values of one gauge, each another one.
Sample gauge_at(Real t) {
  Sample s;
  s.t = t, s.dt = 0.1, s.gauges = {{1, {9, 9, 9, 9}}, {0, {10 + t, 20 + t, 30 + t, 40 + t}}};
  return s;
}

}  // namespace

// A gauge is in a file of columns and in a group of history.h5 at its own times, and goes on in both.
TEST(HistoryFile, GaugesHaveRowsOfTheirOwn) {
  test::ScratchFolder folder;
  HistoryRequests wanted{.h5 = OutputSchedule(0.5)};
  wanted.ask_gauge(0, level, 0.1);
  HistoryPositions then;
  const auto run = [&](Histories& histories, int begin, int end) {
    for (int k = begin; k < end; ++k)
      if (histories.is_due(0.1 * k, 0.1)) histories.write(gauge_at(0.1 * k));
    histories.finish();
  };
  {
    Histories histories(folder.path(), wanted);
    run(histories, 0, 7);
    then = histories.positions();
    run(histories, 7, 9);  // which the restart takes back
  }
  EXPECT_EQ(then.rows, 2);
  EXPECT_EQ(then.gauge_rows, (std::map<std::string, std::int64_t>{{"level", 7}}));
  Histories histories(folder.path(), wanted, &then);
  {
    SavedState none;
    Archive archive = Archive::saver(none);
    Histories(folder / "other", wanted).keep(archive, 0);
    Archive back = Archive::loader(none);
    histories.keep(back, 0.7);  // what was due before 0.7 is taken as written
  }
  run(histories, 7, 11);
  const Content file(folder / "history.h5");
  std::vector<Real> t, h, u;
  std::string text = "time,h,u.x,u.y,u.z\n";
  for (int k = 0; k < 11; ++k) {
    const Real now = 0.1 * k;
    t.push_back(now), h.push_back(10 + now), u.insert(u.end(), {20 + now, 30 + now, 40 + now});
    text += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", now, 10 + now, 20 + now, 30 + now, 40 + now);
  }
  EXPECT_EQ(file["gauges/level/time"], t);
  EXPECT_EQ(file["gauges/level/h"], h);
  EXPECT_EQ(file["gauges/level/u"], u);
  EXPECT_EQ(file["global/time"], (std::vector<Real>{0, 0.5, 1.0}));
  EXPECT_EQ(file.datasets.at("gauges/level/u").dimension, "L/T");
  EXPECT_EQ(file.datasets.at("gauges/level/time").dimension, "T");
  EXPECT_EQ(file.titles.at("gauges/level"), "at the wall");
  EXPECT_EQ(test::read_text(folder / "gauges/level.csv"), text);
}

// A gauge that is due alone needs no whole sample; which numbers are due is known.
TEST(HistoryFile, GaugesAreDueByThemselves) {
  test::ScratchFolder folder;
  HistoryRequests wanted;
  wanted.ask("glstat", 0.5);
  wanted.ask_gauge(3, {.name = "a"}, 0.1), wanted.ask_gauge(5, {.name = "b"}, 0.2);
  Histories histories(folder.path(), wanted);
  const auto due = [&](Real t) { return histories.take(t, 0.1); };
  const Histories::Due all = due(0), one = due(0.1), two = due(0.2);
  EXPECT_EQ(all, (Histories::Due{true, true, true, true})) << "history.h5 goes with glstat";
  EXPECT_EQ(one, (Histories::Due{false, true, false, false}));
  EXPECT_TRUE(histories.needs_whole_sample(all));
  EXPECT_FALSE(histories.needs_whole_sample(one));
  EXPECT_EQ(histories.due_gauges(one), std::vector<std::size_t>{3});
  EXPECT_EQ(histories.due_gauges(two), (std::vector<std::size_t>{3, 5}));
}

// history.h5 has the shortest interval of the text files, or that which it is asked for with.
TEST(HistoryFile, IntervalOfHistoryH5) {
  for (const bool asked : {false, true}) {
    test::ScratchFolder folder;
    HistoryRequests wanted;
    if (asked) wanted.h5 = OutputSchedule(0.7);
    wanted.ask("matsum", 0.5), wanted.ask("glstat", 0.2), wanted.ask("rcforc", 0.3);
    wanted.ask_gauge(0, {.name = "a"}, 0.1);
    Histories histories(folder.path(), wanted);
    std::vector<int> due;
    for (int k = 0; k < 10; ++k)
      if (histories.take(0.1 * k, 0.1).back()) due.push_back(k);
    EXPECT_EQ(due, asked ? (std::vector<int>{0, 7}) : (std::vector<int>{0, 2, 4, 6, 8}));
  }
}

// Behind a restart the last sample is not written twice, and the next is due when it would have been.
TEST(HistoryFile, ARestartKnowsTheLastSample) {
  test::ScratchFolder folder;
  HistoryRequests wanted;
  wanted.ask("glstat", 0.5), wanted.ask("matsum", 0.25);
  SavedState saved;
  HistoryPositions then;
  {
    Histories histories(folder.path(), wanted);
    for (const Real t : {0.0, 0.25, 0.5, 0.6}) {
      Sample s;
      s.t = t, s.dt = 0.1;
      histories.write(s, t == 0.6);  // as at the end of a run
    }
    histories.finish();
    Archive archive = Archive::saver(saved);
    histories.keep(archive, 0.6);
    then = histories.positions();
  }
  Histories histories(folder.path(), wanted, &then);
  Archive archive = Archive::loader(saved);
  histories.keep(archive, 0.6);
  EXPECT_EQ(histories.take(0.6, 0.1, true), (Histories::Due{false, false, false})) << "they have t = 0.6";
  EXPECT_FALSE(histories.is_due(0.6, 0.1));
  EXPECT_EQ(histories.take(0.7, 0.1), (Histories::Due{false, true, true})) << "matsum at 0.75";
  EXPECT_EQ(histories.take(1.0, 0.1), (Histories::Due{true, true, true}));
  EXPECT_EQ(histories.bytes(), static_cast<std::int64_t>(std::filesystem::file_size(folder / "glstat") +
                                                         std::filesystem::file_size(folder / "matsum") +
                                                         std::filesystem::file_size(folder / "history.h5")));
}

}  // namespace courant::history_file_test
