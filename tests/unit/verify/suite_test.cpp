#include "verify/suite.hpp"

#include <gtest/gtest.h>

#include "../output/output_test.hpp"
#include "output/file.hpp"
#include "verify/plan.hpp"

namespace courant {
namespace {

using test::ScratchFolder;

const char* const scene = R"(
title: a square
parameters: {n: 4, dx: 1 / n, g: 9.81, c0: 10}
parts:
  - {id: 1, section: 1, material: 1, lattices: [{low: [0, 0], high: [1, 1], spacing: dx}]}
)";

/// The suite and what is said about it, without the folder's name.
struct Read {
  Suite suite;
  std::string said;
  std::vector<PlannedRun> runs;
};

Read read(const std::string& text) {
  const ScratchFolder dir;
  write_file(dir / "scene.yaml", scene);
  write_file(dir / "table.csv", "t,y\n0,1\n1,2\n");
  write_file(dir / "suite.yaml", text);
  Diagnostics diagnostics;
  Read out{read_suite(dir / "suite.yaml", diagnostics), {}, {}};
  if (diagnostics.ok()) out.runs = plan_runs(out.suite, diagnostics);
  out.said = diagnostics.text();
  const std::string folder = dir.path().string() + "/";
  for (std::size_t at = 0; (at = out.said.find(folder)) != std::string::npos;)
    out.said.erase(at, folder.size());
  return out;
}

const std::string head = "cases:\n  - name: one\n    scene: scene.yaml\n";
const std::string observing = head + "    observations:\n      - ";

TEST(Suite, AllKeys) {
  const Read r = read(R"(
title: everything
about: for the test
time_limit: 60
cases:
  - name: one
    title: first
    about: nothing
    scene: scene.yaml
    parameters: {g: 1e-3}
    resolution: n
    resolutions: [2, 4, 8]
    size: dx
    time_limit: 10
    settings:
      - {name: slow, parameters: {c0: 100}, resolutions: [2, 4, 5, 10]}
      - name: fast
    observations:
      - {name: a, title: A, unit: m, of: global/kinetic / 2 + parts/1/mass, take: at, at: 2 * dx, from: 0, to: 1,
         reference: {csv: table.csv, csv_x: t, csv_y: 2, scale_x: g, scale_y: 2, offset_x: 1, offset_y: dx, source: made up},
         scale: g, bound: 0.1, bound_settings: [fast], least_order: 1}
      - {name: b, kind: particles, of: vx * m, where: x - 0.5, reduce: p99, take: curve, norm: linf, reference: t * g}
      - {name: c, kind: profile, of: p, along: y, at: 1, reference: finest}
      - {name: d, of: contacts/1/force.y, take: period, reference: {formula: 2 * pi / g}}
      - {name: e, of: -global/total / 2, take: decay, reference: {finest: true, source: our own}}
    picture_of: p
    picture_title: pressure
    picture_at: 1
    picture_where: 0.5 - y
  - name: two
    scene: scene.yaml
    observations: [{name: growth, of: global/kinetic, take: growth}]
    stability:
      sweep: {c0: [10, 20], n: [2, 4, 8]}
      limits: [{name: energy, value: growth + residual, at_most: 2 * g}]
      must_be_stable: 15 - c0
      must_stop: c0 - 15
)");
  EXPECT_EQ(r.said, "");
  ASSERT_EQ(r.suite.cases.size(), 2u);
  const SuiteCase& one = r.suite.cases[0];
  EXPECT_EQ(one.time_limit, 10);
  EXPECT_EQ(r.suite.cases[1].time_limit, 60);
  EXPECT_EQ(one.parameters.at("g"), "1e-3");
  const SuiteObservation& a = one.observations[0];
  EXPECT_EQ(a.reference.kind, SuiteReference::Kind::csv);
  EXPECT_EQ(a.reference.csv.filename(), "table.csv");
  EXPECT_EQ(a.reference.scale_x, "g");
  EXPECT_EQ(a.reference.offset_y, "dx");
  EXPECT_EQ(a.bound, 0.1);
  EXPECT_EQ(a.least_order, 1);
  EXPECT_EQ(a.bound_settings, std::vector<std::string>{"fast"});
  EXPECT_EQ(one.observations[1].kind, SuiteObservation::Kind::particles);
  EXPECT_EQ(one.observations[1].reference.kind, SuiteReference::Kind::formula);
  EXPECT_EQ(one.observations[2].reference.kind, SuiteReference::Kind::finest);
  EXPECT_EQ(one.observations[4].reference.kind, SuiteReference::Kind::finest);
  EXPECT_EQ(one.picture_where, "0.5 - y");
  ASSERT_TRUE(r.suite.cases[1].stability);
  EXPECT_EQ(r.suite.cases[1].stability->limits[0].at_most, "2 * g");

  ASSERT_EQ(r.runs.size(), 4u + 3u + 6u);
  EXPECT_EQ(r.runs[0].setting, "slow");
  EXPECT_EQ(r.runs[3].resolution, "10");
  EXPECT_TRUE(r.runs[3].finest);
  EXPECT_FALSE(r.runs[2].finest);
  EXPECT_DOUBLE_EQ(r.runs[3].size, 0.1);
  EXPECT_EQ(r.runs[3].parameters, (SuiteParameters{{"c0", "100"}, {"g", "1e-3"}, {"n", "10"}}));
  EXPECT_DOUBLE_EQ(r.runs[3].variables.at("g"), 1e-3);
  EXPECT_EQ(r.runs[7].setting, "c0 = 10, n = 2");
  EXPECT_EQ(r.runs[8].setting, "c0 = 10, n = 4");
  EXPECT_NE(r.runs[7].folder, r.runs[8].folder);
}

TEST(Suite, FaultsHaveTheirPlace) {
  EXPECT_EQ(read("cases: [").said.find("suite.yaml:"), 0u);
  EXPECT_EQ(read("title: x\n").said, "suite.yaml:1:1: error: 'suite' lacks the key 'cases'\n");
  EXPECT_EQ(read("cases: []\n").said, "suite.yaml:1:1: error: the suite has no cases\n");
  EXPECT_EQ(
      read(observing + "{name: a, of: global/kinetic, refernce: 1}\n")
          .said.find(
              "suite.yaml:5:39: error: 'observation' does not know the key 'refernce'\n  hint: did you mean "
              "reference? known keys: name, title, "),
      0u);
  EXPECT_EQ(read(observing + "{name: a, of: global/kinetic, take: finl}\n").said,
            "suite.yaml:5:45: error: 'observation.take' cannot be 'finl'\n  hint: did you mean final? it may "
            "be curve, "
            "final, mean, min, max, at, period, decay, slope, growth\n");
  EXPECT_EQ(read("cases:\n  - name: one\n    scene: secne.yaml\n    observations: [{name: a, of: t}]\n").said,
            "suite.yaml:3:12: error: 'case.scene': there is no file 'secne.yaml'\n  hint: paths count from "
            "the folder of "
            "the suite\n");
  EXPECT_EQ(read(observing + "{name: a, of: global/kinetic / rho}\n").said,
            "suite.yaml:5:23: error: 'observation.of': unknown name 'rho'\n");
  EXPECT_EQ(read(observing + "{name: a, kind: particles, of: p / dz}\n").said,
            "suite.yaml:5:40: error: 'observation.of': unknown name 'dz'\n  hint: did you mean z?\n");
  EXPECT_EQ(
      read(observing + "{name: a, of: kinetic}\n").said,
      "suite.yaml:5:23: error: 'observation.of': unknown name 'kinetic'\n  hint: histories are named like "
      "global/kinetic, parts/1/mass or contacts/1/force.y\n");
}

// Each of these is one fault, reported with these words.
TEST(Suite, KeysThatDoNotFit) {
  const std::string with_n = "    resolution: n\n    resolutions: [4, 8]\n";
  const std::pair<std::string, const char*> faults[] = {
      {head, "the case observes nothing"},
      {observing + "{name: a b, of: t}\n", "'observation.name' is a word"},
      {observing + "{name: a, of: t}\n      - {name: a, of: t}\n", "two observations are called 'a'"},
      {observing + "{name: a, of: t}\n" + head.substr(7) + "    observations: [{name: a, of: t}]\n",
       "two cases are called 'one'"},
      {observing + "{name: a, of: t, where: x}\n", "'where' belongs to particles"},
      {observing + "{name: a, of: t, along: x}\n", "'along' belongs to profiles"},
      {observing + "{name: a, of: t, reduce: sum}\n", "'reduce' belongs to kind: particles"},
      {observing + "{name: a, of: t, bins: 4}\n", "'bins' belongs to profiles"},
      {observing + "{name: a, kind: profile, of: p, along: x, bins: 2.5}\n", "must be a whole number"},
      {observing + "{name: a, kind: profile, of: p, along: x, bins: 4, take: max, reference: y}\n",
       "unknown name 'y'"},
      {observing + "{name: a, of: t, reference: 1, align: 1}\n", "'align' belongs to curves against a csv"},
      {observing + "{name: a, kind: profile, of: p}\n", "lacks the key 'along'"},
      {observing + "{name: a, kind: profile, of: p, along: x, take: max}\n", "can only be taken as a curve"},
      {observing + "{name: a, of: t, take: at}\n", "needs the moment 'at'"},
      {observing + "{name: a, of: t, at: 1}\n", "'at' belongs to 'take: at'"},
      {observing + "{name: a, of: t, bound: 1}\n", "'bound' needs a 'reference'"},
      {observing + "{name: a, of: t, reference: 1, bound: -1}\n", "must be greater than 0"},
      {observing + "{name: a, of: t, reference: 1, bound: 1, bound_settings: [x]}\n", "which is no setting"},
      {observing + "{name: a, of: t, take: max, reference: t}\n", "unknown name 't'"},
      {observing + "{name: a, of: t, reference: finest}\n", "has one run"},
      {observing + "{name: a, of: t, reference: {formula: 1, finest: true}}\n", "has one of"},
      {observing + "{name: a, of: t, reference: {formula: 1, csv_x: 2}}\n",
       "'reference.csv_x' belongs to a csv"},
      {observing + "{name: a, of: t, reference: {csv: table.csv, csv_x: T}}\n", "has no column 'T'"},
      {observing + "{name: a, of: t, reference: 1, least_order: 1}\n", "needs 2 resolutions"},
      {observing + "{name: a, of: t}\n    picture_title: x\n", "needs 'picture_of'"},
      {observing + "{name: a, of: t}\n    resolutions: [1]\n", "the parameter that they are values of"},
      {observing + "{name: a, of: t}\n    resolution: n\n", "has no resolutions"},
      {observing + "{name: a, of: t}\n    resolution: n\n    resolutions: [8, 4]\n    size: dx\n",
       "not less than"},
      {observing + "{name: a, of: t}\n    parameters: {gg: 1}\n", "no such parameter"},
      {observing + "{name: a, of: t}\n    parameters: {n: 4.5}\n", "not a whole number"},
      {observing + "{name: a, of: t}\n    settings: [{name: a}, {name: a}]\n", "two settings are called 'a'"},
      {observing + "{name: a, of: t}\n    title: x\n    title: y\n", "stands twice"},
      {observing + "{name: a, of: t, reference: 1, least_order: 1}\n" + with_n, "needs the 'size'"},
      {head + "    stability: {}\n", "needs a 'sweep' or several settings"},
      {head + "    stability: {sweep: {n: [2]}}\n" + with_n, "has no 'resolution'"},
      {head + "    stability: {sweep: {n: []}}\n", "swept over no values"},
      {head + "    stability: {sweep: {n: [2], g: [1], c0: [1]}}\n", "at most two"},
      {head + "    stability: {sweep: {n: [2]}, limits: [{name: a, value: residua, at_most: 1}]}\n",
       "did you mean residual?"},
      {observing + "{name: a, of: t, reference: 1, bound: 1}\n    stability: {sweep: {n: [2]}}\n",
       "bounds of a stability case are its limits"},
  };
  for (const auto& [text, words] : faults) {
    const std::string said = read(text).said;
    EXPECT_NE(said.find(words), std::string::npos) << text << "said: " << said;
    EXPECT_EQ(said.find("suite.yaml:") == 0 || said.find("table.csv:") == 0, true) << said;
  }
}

}  // namespace
}  // namespace courant
