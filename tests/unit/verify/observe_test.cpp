#include "verify/observe.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../output/output_test.hpp"
#include "output/field_writer.hpp"
#include "output/history.hpp"
#include "verify/formula.hpp"
#include "verify/particle_states.hpp"
#include "verify/picture.hpp"
#include "verify/reference.hpp"

namespace courant {
namespace {

using test::ScratchFolder;
using Kind = SuiteObservation::Kind;

const Variables parameters = {{"g", 10}, {"dx", 0.1}, {"pi", pi}};

/// Histories at t = 0, 0.1, ... 1: kinetic energy t^2, force on part 7's contact (t, -2 t, 0), every second
/// sample only; fields at 0, 0.5, 1: a column of ten particles, p = g (1 - y) + t, the last one inactive.
class Observe : public testing::Test {
 protected:
  void SetUp() override {
    History history(dir / "history.h5");
    FieldWriter fields(dir.path(), {.part_ids = {3}});
    for (int k = 0; k <= 10; ++k) {
      Sample s;
      s.t = 0.1 * k;
      s.energy.kinetic = s.t * s.t;
      if (k == spoilt_sample) s.energy.kinetic = std::nan("");
      if (k % 2 == 0) s.interfaces.push_back({.id = 7, .on_surfa = {s.t, -2 * s.t, 0}});
      history.record(s);
      if (k % 5 == 0) fields.write(column(s.t), s.t, k / 5);
    }
    history.flush();
    fields.finish();
  }
  World& column(Real t) {
    worlds_.push_back(std::make_unique<World>());
    Particles& p = worlds_.back()->particles;
    p.fields.resize(10);
    p.active = p.moving = 10;
    for (Index i = 0; i < 10; ++i) {
      const Real y = 0.05 + 0.1 * i;
      p.x.set(i, {0, y, 0});
      p.v.set(i, {3, 4, 0});
      p.m[i] = 0.01 * 1000;
      p.rho[i] = 1000;
      p.p[i] = 10 * (1 - y) + t;
      p.h[i] = 0.12;
      p.id[i] = i + 1;
      p.state[i] = i == 9 ? particle_outside : particle_active;
    }
    return *worlds_.back();
  }
  Measured measured(SuiteObservation o) {
    o.name = "o";
    SuiteCase definition;
    definition.observations = {o};
    return observe_run(definition, parameters, dir.path(), false).observations[0];
  }
  Observed observed(const SuiteObservation& o, const Measured* finest = nullptr) {
    return compare_observation(o, measured(o), parameters, finest);
  }
  Real number(const SuiteObservation& o) {
    const Measured m = measured(o);
    EXPECT_TRUE(m.found) << m.why;
    return m.value.value_or(std::nan(""));
  }
  static SuiteObservation of(Kind kind, const std::string& text, const std::string& take) {
    SuiteObservation o;
    o.kind = kind, o.of = text, o.take = take;
    return o;
  }

  ScratchFolder dir;
  int spoilt_sample = -1;
  std::vector<std::unique_ptr<World>> worlds_;
};

TEST_F(Observe, Histories) {
  EXPECT_NEAR(number(of(Kind::history, "global/kinetic / 2 + t", "final")), 1.5, 1e-12);
  EXPECT_NEAR(number(of(Kind::history, "g * contacts/7/force.y", "final")), -20, 1e-12);
  // the contact was sampled less often: only samples that have all of them count
  EXPECT_EQ(measured(of(Kind::history, "contacts/7/force.x + 0*global/kinetic", "curve")).series.size(), 6u);
  SuiteObservation window = of(Kind::history, "global/kinetic", "mean");
  window.from = "0.4 + dx - 0.1", window.to = "0.6";
  EXPECT_NEAR(number(window), (0.16 + 0.25 + 0.36) / 3, 1e-12);
  EXPECT_EQ(measured(of(Kind::history, "contacts/7/force", "max")).why,
            "'contacts/7/force' is a vector: add .x, .y or .z");
  EXPECT_EQ(measured(of(Kind::history, "contacts/8/force.x", "max")).why,
            "history.h5 has no 'contacts/8/force'; did you mean contacts/7/force?");
  EXPECT_EQ(measured(of(Kind::history, "global/kinetic.x", "max")).why, "'global/kinetic' is no vector");
  EXPECT_EQ(measured(of(Kind::history, "1 / t", "max")).why, "not finite at t = 0");
}

TEST_F(Observe, Particles) {
  SuiteObservation o = of(Kind::particles, "p", "final");
  EXPECT_NEAR(number(o), 1 + 10 * (1 - 0.45), 1e-4) << "the mean of the nine active ones";
  o.reduce = "max", o.where = "y - 0.3";
  EXPECT_NEAR(number(o), 1 + 10 * (1 - 0.35), 1e-4);
  o.reduce = "count";
  EXPECT_EQ(number(o), 6);
  o.where = "1 - active";
  EXPECT_EQ(number(o), 1) << "who asks for inactive ones gets them";
  o.where = "", o.of = "id", o.reduce = "median";
  EXPECT_EQ(number(o), 5);
  o.reduce = "sum", o.of = "part * m * speed * (V - 0.01 + 1)";
  EXPECT_NEAR(number(o), 9 * 3 * 10 * 5, 1e-3);
  o.of = "p", o.reduce = "mean", o.where = "y - 5";
  EXPECT_EQ(measured(o).why, "no particle counts at t = 0");
  o.take = "slope", o.where = "";
  EXPECT_NEAR(number(o), 1, 1e-5);
}

TEST_F(Observe, Profiles) {
  SuiteObservation o = of(Kind::profile, "p", "curve");
  o.along = "1 - y", o.at = "0.48";
  o.reference = {SuiteReference::Kind::formula, "g * (1 - y) + t"};
  const Observed exact = observed(o);
  EXPECT_TRUE(exact.found) << exact.why;
  EXPECT_LT(exact.error.value_or(1), 1e-6);
  EXPECT_EQ(exact.curve.x.size(), 9u);
  EXPECT_TRUE(std::is_sorted(exact.curve.x.begin(), exact.curve.x.end()));
  o.reference.formula = "g * (1 - y) + t + 1", o.scale = "g", o.norm = "linf";
  EXPECT_NEAR(*observed(o).error, 0.1, 1e-6);
  o.at = "7";
  EXPECT_EQ(measured(o).why, "there is no field state at t = 7");
}

TEST_F(Observe, References) {
  SuiteObservation o = of(Kind::history, "global/kinetic", "curve");
  o.reference = {SuiteReference::Kind::formula, "t^2 + 1"};
  o.norm = "l1", o.scale = "2";
  EXPECT_NEAR(*observed(o).error, 0.5, 1e-12);
  o.scale = "", o.norm = "linf";
  EXPECT_NEAR(*observed(o).error, 1.0 / 2, 1e-12);
  o.reference.formula = "0*t";
  EXPECT_EQ(observed(o).why, "the reference is 0: give a 'scale' for its error");
  EXPECT_FALSE(observed(o).error);
  o.take = "final", o.reference.formula = "2 * t";
  EXPECT_NEAR(*observed(o).error, 0.5, 1e-12);

  write_file(dir / "table.csv", "# made up\ntime,  energy\n-1, 0\n0.2, 20\n\n0.4, 40\n");
  o = of(Kind::history, "t", "curve");
  o.reference.kind = SuiteReference::Kind::csv;
  o.reference.csv = dir / "table.csv";
  o.reference.csv_x = "time", o.reference.csv_y = "2";
  o.reference.scale_y = "dx / 10";
  const Observed table = observed(o);  // 0 (1/6), 0.1 , 0.2, 0.3, 0.4 lie inside
  EXPECT_NEAR(table.curve.reference_y.back(), 0.4, 1e-12);
  o.norm = "linf", o.scale = "1";
  EXPECT_NEAR(*observed(o).error, 0.2 * 5 / 6, 1e-9);
  o.take = "at", o.at = "0.3";
  EXPECT_NEAR(*observed(o).reference, 0.3, 1e-9);
  o.take = "final";
  EXPECT_EQ(observed(o).why, "the reference does not reach 1");

  o = of(Kind::history, "t", "curve");
  o.reference.kind = SuiteReference::Kind::finest;
  EXPECT_FALSE(observed(o).error) << "the finest run is no reference for itself";
  const Measured finer{
      .found = true, .why = {}, .series = {{0, 0.5, 0.5}, {0.1, 0.6, 0.6}}, .value = {}, .formula = {}};
  o.norm = "l2", o.scale = "1";
  EXPECT_NEAR(*observed(o, &finer).error, 0.1, 1e-12);
}

TEST_F(Observe, GarbageIsFound) {
  SuiteCase definition;
  EXPECT_EQ(observe_run(definition, parameters, dir.path(), true).garbage, "");
  const ScratchFolder other;
  FieldWriter fields(other.path(), {.part_ids = {3}});
  World& world = column(0);
  world.particles.p[4] = std::nan("");
  fields.write(world, 0.25, 0);
  fields.finish();
  EXPECT_NE(observe_run(definition, parameters, other.path(), true)
                .garbage.find("p of a particle is not finite at t = 0.25"),
            std::string::npos);
  spoilt_sample = 4;
  SetUp();
  EXPECT_EQ(observe_run(definition, parameters, dir.path(), false).garbage.substr(0, 30),
            "global/kinetic is not finite a");
  EXPECT_EQ(measured(of(Kind::history, "global/kinetic", "max")).why, "not finite at t = 0.4");
}

TEST_F(Observe, FilesOfFewArraysAreNoGarbage) {
  const SuiteCase definition;
  for (const bool spoilt : {false, true}) {
    const ScratchFolder few;
    FieldWriter fields(few.path(), {.part_ids = {3},
                                    .fields = {"active", "density", "mass", "smoothing_length", "velocity"}});
    World& world = column(0);
    if (spoilt) world.particles.v.set(4, {0, std::nan(""), 0});
    fields.write(world, 0.25, 0);
    fields.finish();
    const std::string garbage = observe_run(definition, parameters, few.path(), true).garbage;
    EXPECT_EQ(garbage.find("vy of a particle is not finite") != std::string::npos, spoilt) << garbage;
    EXPECT_EQ(garbage.empty(), !spoilt) << garbage;
  }
}

TEST_F(Observe, Picture) {
  SuiteCase definition;
  definition.picture_of = "p", definition.picture_title = "pressure", definition.picture_at = "0.5";
  const auto picture = draw_particles(definition, parameters, dir.path());
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->png.substr(1, 3), "PNG");
  EXPECT_EQ(picture->title, "pressure, t = 0.5, 9 particles");
  EXPECT_EQ(picture->low, "2.08");  // nine values 2, 3, ... 10: 0.08 of the way to the second
  definition.picture_at = "9";
  EXPECT_FALSE(draw_particles(definition, parameters, dir.path()));
}

TEST(Formula, NamesOfDatasets) {
  const HistoryText text = find_history_names("global/kinetic/2 - parts/12/momentum.y/global/kinetic + x/y");
  ASSERT_EQ(text.names.size(), 2u);
  EXPECT_EQ(text.names[1].path, "/parts/12/momentum");
  EXPECT_EQ(text.names[1].component, 1);
  EXPECT_EQ(text.text, text.words[0] + "/2 - " + text.words[1] + "/" + text.words[0] + " + x/y");
  EXPECT_EQ(find_history_names("parts/1").names.size(), 0u);
  EXPECT_EQ(find_history_names("my_global/kinetic").names.size(), 0u);
}

TEST(Formula, NamesThatMeanTwoThings) {
  const Formula formula("h * 2", particle_variables(), {{"h", 1}});
  EXPECT_EQ(formula.error(), "'h' is both a parameter and a variable here");
  EXPECT_TRUE(Formula("p * 2", particle_variables(), {{"h", 1}}).ok());
  ASSERT_EQ(particle_variables().size(), particle_variable_count);
}

TEST(ReferenceTable, Faults) {
  const ScratchFolder dir;
  const auto said = [&](const std::string& text, const std::string& x, const std::string& y) {
    write_file(dir / "t.csv", text);
    Diagnostics diagnostics;
    read_table(dir / "t.csv", x, y, diagnostics);
    return diagnostics.ok() ? "" : diagnostics.all()[0].message;
  };
  EXPECT_EQ(said("a,b\n1,2\n3,4\n", "a", "b"), "");
  EXPECT_EQ(said("1 2\n3 4\n", "1", "2"), "");
  EXPECT_EQ(said("a,b\n1,2\n3,4\n", "a", "c"), "the table has no column 'c'");
  EXPECT_EQ(said("1,2\n3,4\n", "1", "3"), "the table has no column '3'");
  EXPECT_EQ(said("a,b\n1,x\n3,4\n", "a", "b"), "expected a number, got 'x'");
  EXPECT_EQ(said("a,b\n1,2\n3,\n", "a", "b"), "the table has fewer than two rows with both columns");
  Diagnostics diagnostics;
  EXPECT_TRUE(read_table(dir / "none.csv", "1", "2", diagnostics).empty());
  EXPECT_FALSE(diagnostics.ok());
  write_file(dir / "t.csv", "name,100\nA,1\n2,5\n2,7\n");
  Diagnostics fine;
  write_file(dir / "u.csv", "kind,x,y\nA,2,5\nB,2,7\nC,1,0\n");
  const ReferenceTable table = read_table(dir / "u.csv", "x", "y", fine);
  EXPECT_EQ(table.x, (std::vector<Real>{1, 2}));
  EXPECT_EQ(table.y, (std::vector<Real>{0, 6})) << "rows with the same x are averaged";
}

}  // namespace
}  // namespace courant
