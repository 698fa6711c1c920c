// Analyses from recipes over particles with known fields.
#include "post/analysis.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>

#include "../output/output_test.hpp"
#include "output/file.hpp"
#include "output/history.hpp"
#include "particle_sets.hpp"
#include "post/history_file.hpp"
#include "post/recipe.hpp"
#include "post/run_analyses.hpp"

namespace courant {
namespace {

using test::ScratchFolder;

/// A recipe that was read and sees frames.
class Analyses {
 public:
  explicit Analyses(const std::string& text) {
    write_file(folder_ / "recipe.yaml", text);
    auto recipe = read_recipe(folder_ / "recipe.yaml", diagnostics_);
    if (recipe) analyses_ = std::move(recipe->analyses);
    EXPECT_TRUE(recipe) << diagnostics_.text();
  }
  void take(ParticleFrame frame, Real t) {
    frame.t = t;
    const PostState state(frame, 0.0025, out_);
    for (const auto& analysis : analyses_)
      if (analysis->needs_states() && analysis->looks_at(t, 0.0025)) analysis->take(state);
  }
  void finish() {
    finish_analyses(
        analyses_, folder_.path(), out_, [this](std::string_view text) { said_ += text; }, diagnostics_);
    EXPECT_TRUE(diagnostics_.ok()) << diagnostics_.text();
  }
  /// Without a look at faults.
  std::string fail() {
    finish_analyses(
        analyses_, folder_.path(), out_, [](std::string_view) {}, diagnostics_);
    return diagnostics_.text();
  }
  const std::vector<Real>& column(const std::string& table, const std::string& name) const {
    static const std::vector<Real> nothing;
    for (const auto& analysis : analyses_)
      for (const PostTable& one : analysis->result().tables)
        if (one.name == table)
          if (const PostColumn* found = one.find(name)) return found->values;
    ADD_FAILURE() << "no column " << name << " in " << table;
    return nothing;
  }
  Real scalar(const std::string& analysis, const std::string& name) const {
    for (const auto& one : analyses_)
      for (const PostScalar& number : one->result().scalars)
        if (one->name() == analysis && number.name == name) return number.value;
    ADD_FAILURE() << "no number " << name << " of " << analysis;
    return 0;
  }
  std::filesystem::path out() const { return out_; }
  const ScratchFolder& folder() const { return folder_; }

 private:
  ScratchFolder folder_;
  std::filesystem::path out_ = folder_ / "post";
  Diagnostics diagnostics_;
  std::vector<std::unique_ptr<Analysis>> analyses_;
  std::string said_;
};

/// Gives the particles a velocity.
ParticleFrame moving(ParticleFrame frame, const std::function<Point(Real, Real)>& v) {
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const Point u = v(frame.x[i], frame.y[i]);
    for (std::size_t a = 0; a < 3; ++a) frame.arrays["velocity"][3 * i + a] = u[a];
  }
  return frame;
}

TEST(Profile, MeansLeaveOutWhatIsNotWater) {
  Analyses run(
      "analyses:\n"
      "  - {kind: profile, name: u, of: [vx], x: [0.1], y: {from: 0.01, to: 0.09, step: 0.02}, "
      "interpolation: mls}\n");
  const auto shear = [](Real, Real y) { return Point{1 + 10 * y, 0, 0}; };
  for (int s = 0; s < 4; ++s)  // three states of deep water, one of shallow
    run.take(moving(test::water({.x1 = 0.2, .y1 = s == 2 ? 0.04 : 0.1, .jitter = 0.3}), shear), 0.01 * s);
  run.finish();
  const auto &mean = run.column("u", "vx_mean"), &wet = run.column("u", "wet"), &y = run.column("u", "y");
  ASSERT_EQ(mean.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(mean[i], 1 + 10 * y[i], 1e-10) << i;  // no zeros among them
  EXPECT_EQ(wet[0], 1);
  EXPECT_EQ(wet[4], 0.75);
  EXPECT_NEAR(run.column("u", "colour")[2], 0.75, 0.05);
}

TEST(Profile, RarelyWetPointsHaveNoMean) {
  Analyses run(
      "analyses:\n  - {kind: profile, name: u, of: [vx], x: 0.1, y: [0.01, 0.09], from: 0.02, least_wet: "
      "0.6}\n");
  for (int s = 0; s < 4; ++s)
    run.take(moving(test::water({.x1 = 0.2, .y1 = s % 2 ? 0.04 : 0.1}),
                    [s](Real, Real) {
                      return Point{1.0 * s, 0, 0};
                    }),
             0.01 * s);
  run.finish();
  EXPECT_NEAR(run.column("u", "vx_mean")[0], 2.5, 1e-12);  // states 2 and 3: the window begins at 0.02
  EXPECT_NEAR(run.column("u", "vx_deviation")[0], 0.5, 1e-12);
  EXPECT_TRUE(std::isnan(run.column("u", "vx_mean")[1]));
  EXPECT_EQ(run.column("u", "wet")[1], 0.5);
}

TEST(Grid, FilesForParaView) {
  Analyses run(
      "units: {length: mm, mass: g, time: ms}\n"
      "analyses:\n"
      "  - kind: grid\n    name: field\n    of: [vx, {name: q, of: 0.5 * rho * speed^2, unit: Pa}]\n"
      "    x: {from: 0, to: 0.2, step: 0.02}\n    y: {from: 0.01, to: 0.15, step: 0.02}\n    states: true\n");
  for (int s = 0; s < 2; ++s)
    run.take(moving(test::water({.x1 = 0.2}), [](Real, Real) { return Point{2, 0, 0}; }), 0.01 * s);
  run.finish();
  const std::string csv = test::read_text(run.out() / "field.csv");
  EXPECT_EQ(
      csv.substr(0, csv.find('\n')),
      "x [mm],y [mm],vx_mean [mm/ms],vx_deviation [mm/ms],q_mean [Pa],q_deviation [Pa],wet [-],colour [-]");
  EXPECT_NEAR(run.column("field", "q_mean")[5], 2000, 1e-9);
  for (const char* file :
       {"field.vti", "field/field_0000.vti", "field/field_0001.vti", "field.pvd", "tables.h5"})
    EXPECT_GT(std::filesystem::file_size(run.out() / file), 200u) << file;
  EXPECT_NE(test::read_text(run.out() / "field.pvd")
                .find("timestep=\"0.01\" part=\"0\" file=\"field/field_0001.vti\""),
            std::string::npos);
}

TEST(Surface, DepthOverBedWithoutSpray) {
  const std::string keys = "x: {from: 0.1, to: 0.4, step: 0.1}, bed: 0.01 + 0 * x";
  Analyses run("analyses:\n  - {kind: surface, name: top, layers: true, " + keys + "}\n" +
               "  - {kind: surface, name: first, surface: first, " + keys + "}\n" +
               "  - {kind: surface, name: all, share: 0, " + keys + "}\n");
  ParticleFrame frame = test::water({.x1 = 0.5, .y0 = 0.01, .y1 = 0.05});
  test::fill(frame, {.x0 = 0.19, .x1 = 0.21, .y0 = 0.07, .y1 = 0.08});  // a drop over 0.2
  test::fill(frame, {.x0 = 0.29, .x1 = 0.43, .y0 = 0.08, .y1 = 0.10});  // a tongue over 0.3 and 0.4
  test::fill(frame, {.x0 = 0.42, .x1 = 0.43, .y0 = 0.05, .y1 = 0.08});
  run.take(frame, 0);
  run.finish();
  const Real slack = 6e-4;  // a tenth of h
  const auto &top = run.column("top_mean", "mean"), &first = run.column("first_mean", "mean"),
             &all = run.column("all_mean", "mean");
  EXPECT_NEAR(top[0], 0.04, slack);
  EXPECT_NEAR(top[1], 0.04, slack);  // the drop is spray
  EXPECT_NEAR(top[2], 0.09, slack);
  EXPECT_NEAR(first[2], 0.04, slack);
  EXPECT_NEAR(all[1], 0.07, 2 * slack);
  EXPECT_EQ(run.column("top_layers", "low").size(), 6u);  // four places, two with two pieces
  EXPECT_EQ(run.column("top", "depth@0.3").size(), 1u);
}

/// Columns of particles up to y = 0.06 times stretch(x).
ParticleFrame stretched_columns(const std::function<Real(Real)>& stretch_at) {
  ParticleFrame frame;
  for (int i = 0; i < 50; ++i)
    for (int j = 0; j < 12; ++j) {
      const Real x = (i + 0.5) * 0.01, stretch = stretch_at(x);
      test::add(frame, x, (j + 0.5) * 0.005 * stretch, 0.005 * std::sqrt(2 * stretch));
    }
  return frame;
}

TEST(Surface, SpectrumOfATravellingWave) {
  Analyses run(
      "analyses:\n"
      "  - {kind: surface, name: gauges, x: [0.2, 0.3, 0.4]}\n"
      "  - {kind: spectrum, name: spectra, of: gauges, segment: 1.5, band: [0.7, 15]}\n");
  const Real f = 2.6, k = 2 * pi / 0.4, amplitude = 0.01;
  for (int s = 0; s < 120; ++s) {
    const Real t = 0.025 * s;
    run.take(
        stretched_columns([&](Real x) { return 1 + amplitude / 0.06 * std::sin(k * x - 2 * pi * f * t); }),
        t);
  }
  run.finish();
  for (Real peak : run.column("spectra_peaks", "f")) EXPECT_NEAR(peak, f, 0.05);
  for (Real deviation : run.column("gauges_mean", "deviation"))
    EXPECT_NEAR(deviation, amplitude / std::sqrt(2.0), 0.08 * amplitude);
  EXPECT_NEAR(run.scalar("spectra", "dominant_of_mean"), f, 0.05);
  EXPECT_NEAR(run.scalar("spectra", "resolution"), 1 / 1.5, 0.01);
}

TEST(Flux, UniformStream) {
  Analyses run("analyses:\n  - {kind: flux, name: through, at: [0.3, 0.503], g: 10, level: -1}\n");
  ParticleFrame frame = moving(test::water({.y1 = 0.1}), [](Real, Real) { return Point{2, -1, 0}; });
  for (std::size_t i = 0; i < frame.size(); ++i) frame.arrays["pressure"][i] = 500;
  run.take(frame, 0);
  run.finish();
  const Real m = 1000 * 2 * 0.1, close = 0.002;  // of the kernel's sum over a lattice with h = 1.2 spacings
  const auto expect = [&](const char* column, Real exact) {
    for (Real value : run.column("through_mean", std::string(column) + "_mean"))
      EXPECT_NEAR(value, exact, close * std::abs(exact)) << column;
  };
  expect("mass", m);
  expect("volume", 0.2);
  expect("momentum_x", 2 * m);
  expect("momentum_y", -m);
  expect("pressure_force", 50);
  expect("kinetic", 2.5 * m);
  expect("potential", m * 10 * 1.05);
  expect("pressure_work", 100);
  const std::string csv = test::read_text(run.out() / "through_mean.csv");
  EXPECT_NE(csv.find("mass_mean [kg/(m s)]"), std::string::npos) << csv;
  EXPECT_NE(csv.find("momentum_x_mean [N/m]"), std::string::npos);
  EXPECT_NE(csv.find("kinetic_mean [W/m]"), std::string::npos);
}

TEST(Flux, AcrossTheFlowAndWithinAnExtent) {
  Analyses run(
      "analyses:\n"
      "  - {kind: flux, name: across, normal: y, at: 0.05, x: [0.25, 0.75]}\n"
      "  - {kind: flux, name: outside, at: 3}\n");
  run.take(moving(test::water({.y1 = 0.1}), [](Real, Real) { return Point{2, -1, 0}; }), 0);
  run.finish();
  EXPECT_NEAR(run.column("across_mean", "mass_mean")[0], -500, 1.5);
  EXPECT_EQ(run.column("outside_mean", "mass_mean")[0], 0);
}

TEST(Flux, InactiveParticlesDoNotCount) {
  Analyses run("analyses:\n  - {kind: flux, name: q, at: 0.5}\n  - {kind: surface, name: s, x: 0.5}\n");
  ParticleFrame frame = moving(test::water({.y1 = 0.1}), [](Real, Real) { return Point{2, 0, 0}; });
  for (std::size_t i = 0; i < frame.size(); ++i) frame.arrays["active"][i] = frame.y[i] < 0.05;
  run.take(frame, 0);
  run.finish();
  EXPECT_NEAR(run.column("q_mean", "mass_mean")[0], 100, 0.2);
  EXPECT_NEAR(run.column("s", "depth")[0], 0.05, 6e-4);
}

TEST(Probe, ValuesOverTimeAndSelection) {
  Analyses run(
      "analyses:\n"
      "  - {kind: probe, name: p, of: [vx, vx * y], at: [[0.1, 0.05], [0.1, 0.3]], interpolation: mls, "
      "where: 0.08 - y}\n");
  for (int s = 0; s < 3; ++s)
    run.take(moving(test::water({.x1 = 0.2}), [s](Real x, Real) { return Point{s + x, 0, 0}; }), 0.1 * s);
  run.finish();
  for (std::size_t s = 0; s < 3; ++s) {
    EXPECT_NEAR(run.column("p", "vx_1")[s], static_cast<Real>(s) + 0.1, 1e-10);
    EXPECT_TRUE(std::isnan(run.column("p", "vx_2")[s]));
  }
  EXPECT_NEAR(run.scalar("p", "vx_1_mean"), 1.1, 1e-10);
}

TEST(Surface, UpIsZ) {
  Analyses run(
      "up: z\nanalyses:\n  - {kind: surface, name: s, x: [0.02], across: 0.03, bed: 0.01}\n"
      "  - {kind: flux, name: q, at: 0.03, g: 10}\n");
  ParticleFrame frame;
  frame.dim = 3;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j)
      for (int k = 0; k < 8; ++k)
        test::add(frame, (i + 0.5) * 0.005, (j + 0.5) * 0.005, 0.005, (k + 0.5) * 0.005);
  run.take(moving(frame, [](Real, Real) { return Point{3, 0, 0}; }), 0);
  run.finish();
  EXPECT_NEAR(run.column("s", "depth")[0], 0.03, 6e-4);
  const Real mass = 1000 * 3 * 0.06 * 0.04;
  EXPECT_NEAR(run.column("q_mean", "mass_mean")[0], mass, 0.002 * mass);
  EXPECT_NEAR(run.column("q_mean", "potential_mean")[0], mass * 10 * 0.02, 0.002 * mass * 0.2);
  EXPECT_NE(test::read_text(run.out() / "q_mean.csv").find("mass_mean [kg/s]"), std::string::npos);
}

TEST(Toe, FollowsAStep) {
  Analyses run(
      "analyses:\n"
      "  - {kind: surface, name: s, x: {from: 0.05, to: 0.95, step: 0.01}}\n"
      "  - {kind: toe, name: toe, of: s, depth: 0.05, from: 0.1}\n");
  for (int s = 0; s < 5; ++s) {
    const Real at = s == 0 ? 0.9 : 0.7 - 0.1 * s;
    ParticleFrame frame = test::water({.x1 = at, .y1 = 0.02});
    test::fill(frame, {.x0 = at, .y1 = 0.08});
    run.take(frame, 0.1 * s);
  }
  run.finish();
  for (std::size_t s = 1; s < 5; ++s)
    EXPECT_NEAR(run.column("toe", "toe")[s], 0.7 - 0.1 * static_cast<Real>(s), 0.006);  // half an h and a bit
  EXPECT_NEAR(run.scalar("toe", "toe_speed"), -1, 0.01);
  EXPECT_NEAR(run.scalar("toe", "toe_mean"), 0.45, 0.006);
}

TEST(Toe, WithoutStatesIsAFault) {
  Analyses run(
      "analyses:\n  - {kind: surface, name: s, x: 0.1}\n"
      "  - {kind: toe, name: toe, of: s, depth: 0.05, from: 5}\n"
      "  - {kind: spectrum, name: spectra, of: toe}\n");
  for (int s = 0; s < 9; ++s) run.take(test::water({.x1 = 0.2}), 0.1 * s);
  const std::string fault = run.fail();
  EXPECT_NE(fault.find("analysis 'toe': the results have no state in its window"), std::string::npos)
      << fault;
}

/// Mean velocity 1.5 m/s exp(-0.028 (x - x1)/d1) at the bed and a straight line to a surface velocity that
/// changes its sign at x = 0.25.
TEST(Roller, LengthAndDecay) {
  Analyses run(
      "analyses:\n"
      "  - {kind: profile, name: u, of: [vx], x: {from: 0.025, to: 0.6, step: 0.025}, y: {from: 0.0025, to: "
      "0.0775, "
      "step: 0.0125}, interpolation: mls}\n"
      "  - {kind: roller, name: jump, profile: u, toe: 0.05, v1: 1.5, d1: 0.02}\n");
  const auto u = [](Real x, Real y) {
    const Real bed = 1.5 * std::exp(-0.028 * (x - 0.05) / 0.02), top = x - 0.25;
    return Point{bed + (top - bed) * (y - 0.0025) / 0.075, 0, 0};
  };
  run.take(moving(test::water({.x1 = 0.7, .y1 = 0.08}), u), 0);
  run.finish();
  EXPECT_NEAR(run.scalar("jump", "roller_length"), 10, 0.05);
  EXPECT_NEAR(run.scalar("jump", "roller_length_surface"), 10, 0.05);
  EXPECT_NEAR(run.scalar("jump", "roller_length_reference"), 14.8355, 1e-3);
  EXPECT_LT(run.scalar("jump", "decay_rms"), 0.002);
}

/// A slow swing at one gauge over the roller and at one behind it outweighs the rest: it is the dominant one
/// of the mean spectrum, but not of the median over the roller.
TEST(Roller, FrequencyOfMostGaugesOverIt) {
  Analyses run(
      "analyses:\n"
      "  - {kind: surface, name: gauges, x: [0.12, 0.2, 0.3, 0.45, 0.48]}\n"
      "  - {kind: spectrum, name: spectra, of: gauges, segment: 3, band: [0.5, 15]}\n"
      "  - {kind: roller, name: jump, spectrum: spectra, toe: 0.1, v1: 1.5, d1: 0.02}\n");
  const Real fast = 2.6, slow = 1;
  for (int s = 0; s < 240; ++s) {
    const Real t = 0.025 * s;
    run.take(stretched_columns([&](Real x) {
               const bool swings = std::abs(x - 0.2) < 0.04 || x > 0.4;
               return 1 + (swings ? 0.3 * std::sin(2 * pi * slow * t) : 0.1 * std::sin(2 * pi * fast * t));
             }),
             t);
  }
  run.finish();
  EXPECT_NEAR(run.scalar("jump", "strouhal"), slow * 0.02 / 1.5, 0.02 * slow * 0.02 / 1.5);
  EXPECT_NEAR(run.scalar("jump", "strouhal_median"), fast * 0.02 / 1.5, 0.02 * fast * 0.02 / 1.5);
}

TEST(Force, OnTheWallsFromHistories) {
  Analyses run(
      "analyses:\n"
      "  - {kind: force, name: wall, contacts: [7], from: 0.5}\n"
      "  - {kind: history, name: h, of: [global/kinetic, {name: v, of: global/velocity.y, factor: 2, unit: "
      "mm/s}]}\n");
  {
    History history(run.folder() / "history.h5");
    for (int s = 0; s <= 10; ++s) {
      Sample sample;
      sample.t = 0.1 * s;
      sample.energy.kinetic = 3;
      sample.velocity = {0, 4, 0};
      InterfaceForce contact;
      contact.id = 7;
      contact.on_surfa = {0, -1.0 * s, 0};
      sample.interfaces.push_back(contact);
      history.record(sample);
    }
    history.flush();
  }
  run.finish();
  EXPECT_NEAR(run.column("wall", "force_y_contact7")[4], 4,
              1e-12);  // on the wall: against that on the particles
  EXPECT_NEAR(run.scalar("wall", "force_y_contact7_mean"), 7.5, 1e-12);
  EXPECT_NEAR(run.scalar("wall", "force_y_contact7_integral"), 3.75, 1e-12);
  EXPECT_NEAR(run.column("h", "v")[3], 8, 1e-12);
  EXPECT_NE(test::read_text(run.out() / "wall.csv").find("force_y_contact7 [N]"), std::string::npos);
}

TEST(History, WhatIsSilentAfterARestartIsMissingFromThereOn) {
  ScratchFolder folder;
  const auto record = [](History& history, int from, bool contact) {
    for (int s = from; s < from + 3; ++s) {
      Sample sample;
      sample.t = s;
      InterfaceForce one;
      one.id = 7;
      one.on_surfa = {0, -1.0 - s, 0};
      if (contact) sample.interfaces.push_back(one);
      history.record(sample);
    }
    history.flush();
  };
  History first(folder / "history.h5");
  record(first, 0, true);
  History later(folder / "history.h5");
  EXPECT_EQ(later.resume(3), 3u);
  record(later, 3, false);
  Diagnostics diagnostics;
  const auto file = HistoryFile::open(folder / "history.h5", diagnostics);
  ASSERT_TRUE(file) << diagnostics.text();
  const auto force = file->column("/contacts/7/force", 1);
  ASSERT_TRUE(force);
  ASSERT_EQ(force->size(), 6u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ((*force)[i], -1.0 - static_cast<Real>(i));
  for (std::size_t i = 3; i < 6; ++i) EXPECT_TRUE(std::isnan((*force)[i])) << (*force)[i];
  EXPECT_EQ(file->sampled("/contacts/7/force"), (std::vector<char>{1, 1, 1, 0, 0, 0}));
}

/// Fifty samples of a contact's force and the kinetic energy; those of the contact are lacking from t = 3
/// to 4.
void write_history_with_a_gap(const ScratchFolder& folder) {
  History history(folder / "history.h5");
  for (int s = 0; s <= 50; ++s) {
    Sample sample;
    sample.t = 0.1 * s;
    sample.energy.kinetic = 1 + std::sin(sample.t);
    sample.dt = 0.01 + 0.001 * std::sin(2 * sample.t);
    InterfaceForce contact;
    contact.id = 7;
    contact.on_surfa = {1, 1, 0};
    if (s < 30 || s > 40) sample.interfaces.push_back(contact);
    history.record(sample);
  }
  history.flush();
}

TEST(Force, WithoutStatesOrWithAGapHasNoImpulse) {
  Analyses early("analyses:\n  - {kind: force, name: wall, contacts: [7], from: 5.5, to: 7}\n");
  write_history_with_a_gap(early.folder());
  EXPECT_NE(early.fail().find("analysis 'wall': the results have no state in its window in time"),
            std::string::npos);

  Analyses run(
      "analyses:\n  - {kind: force, name: before, contacts: [7], to: 2}\n"
      "  - {kind: force, name: over, contacts: [7]}\n");
  write_history_with_a_gap(run.folder());
  run.finish();
  EXPECT_NEAR(run.scalar("before", "force_x_contact7_integral"), -2, 1e-12);
  EXPECT_NEAR(run.scalar("over", "force_x_contact7_mean"), -1, 1e-12);
  EXPECT_TRUE(std::isnan(run.scalar("over", "force_x_contact7_integral"))) << "a gap is no force of 0";
}

TEST(SpectrumOf, SeriesOfDifferentUnitsHasNoMean) {
  Analyses run(
      "analyses:\n  - {kind: history, name: h, of: [global/kinetic, global/dt], to: 5}\n"
      "  - {kind: spectrum, name: s, of: h, segment: 2}\n");
  write_history_with_a_gap(run.folder());
  EXPECT_NE(run.fail().find("have different units: they have no mean"), std::string::npos);
  EXPECT_TRUE(std::isnan(run.scalar("s", "dominant_of_mean")));
  EXPECT_TRUE(std::isnan(run.column("s", "mean")[1]));
  EXPECT_GT(run.column("s", "global/kinetic")[1], 0);
}

TEST(History, OfAsciiFilesHereAndElsewhere) {
  Analyses run(
      "analyses:\n"
      "  - {kind: history, name: ours, file: rcforc, id: 7, of: [{name: push, of: y, side: SURFB, factor: "
      "2}, "
      "{name: x, of: x, side: SURFA, unit: lbf}]}\n"
      "  - {kind: history, name: theirs, file: lsdyna/rcforc_of_mine, side: SURFA, of: [y, mx], from: "
      "0.15}\n");
  const auto lines = [](Real t, Real y, const char* more) {
    return fmt::format(
        "  SURFA           7 time {0:11.5E}  x  1.00000E+00  y {1:12.5E}  z  0.00000E+00{2}\n"
        "  SURFB           7 time {0:11.5E}  x -1.00000E+00  y {3:12.5E}  z  0.00000E+00{2}\n",
        t, y, more, -y);
  };
  std::string ours = " title\n  date\n", theirs = ours;
  for (int s = 0; s < 3; ++s) ours += lines(0.1 * s, -s, "");
  for (int s = 0; s < 5; ++s) theirs += lines(0.05 * s, s, "  mx  2.50000E+00");
  write_file(run.folder() / "rcforc", ours);
  make_folder(run.folder() / "lsdyna");
  write_file(run.folder() / "lsdyna/rcforc_of_mine", theirs);
  run.finish();
  EXPECT_EQ(run.column("ours", "push"), (std::vector<Real>{0, 2, 4}));
  EXPECT_EQ(run.column("theirs", "y_SURFA"), (std::vector<Real>{0, 1, 2, 3, 4}));
  EXPECT_EQ(run.column("theirs", "t")[3], 0.15);
  EXPECT_NEAR(run.scalar("theirs", "y_SURFA_mean"), 3.5, 1e-12);
  const std::string csv = test::read_text(run.out() / "ours.csv");
  EXPECT_EQ(csv.find("t [s],push [N],x [lbf]"), 0u) << csv;
  EXPECT_EQ(test::read_text(run.out() / "theirs.csv").find("t [s],y_SURFA [N],mx_SURFA"), 0u);
}

TEST(History, FaultsOfAsciiFiles) {
  const auto fault = [](const std::string& analysis) {
    Analyses run("analyses:\n  - " + analysis + "\n");
    write_file(run.folder() / "glstat",
               " dt of cycle       1 is controlled by sph 1\n"
               " time...........................   0.00000E+00\n"
               " kinetic energy.................   1.00000E+00\n");
    return run.fail();
  };
  EXPECT_NE(fault("{kind: history, name: h, file: nowhere, of: [x]}")
                .find("nowhere: error: cannot read the history"),
            std::string::npos);
  const std::string text = fault("{kind: history, name: h, file: glstat, of: [kinetic energi]}");
  EXPECT_NE(text.find("recipe.yaml:2:5: error: analysis 'h': "), std::string::npos) << text;
  EXPECT_NE(text.find("glstat has no 'kinetic energi'\n  hint: did you mean 'kinetic energy'?"),
            std::string::npos);
  EXPECT_NE(fault("{kind: history, name: h, file: glstat, id: 3, of: [kinetic energy]}")
                .find("glstat has no 'kinetic energy' of 3\n  hint: it belongs to the whole"),
            std::string::npos);
}

TEST(Analyses, FaultsOfResultsNameTheAnalysis) {
  Analyses late("analyses:\n  - {kind: surface, name: s, x: 0.1, from: 5}\n");
  late.take(test::water({.x1 = 0.2}), 0);
  EXPECT_NE(late.fail().find("recipe.yaml:2:5: error: analysis 's': the results have no state in its window"),
            std::string::npos)
      << late.fail();
  Analyses missing("analyses:\n  - {kind: force, name: f, contacts: [3]}\n");
  EXPECT_NE(missing.fail().find("no histories here"), std::string::npos);
}

}  // namespace
}  // namespace courant
