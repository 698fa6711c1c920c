#include "verify/judge.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../output/output_test.hpp"
#include "output/file.hpp"
#include "verify/compare.hpp"
#include "verify/result_files.hpp"
#include "verify/result_table.hpp"
#include "verify/schedule.hpp"

namespace courant {
namespace {

using test::ScratchFolder;

/// Errors 0.4 dx^2 at dx = 0.1, 0.05, 0.025 for setting a, none at the finest of setting b.
CaseResult made_case() {
  CaseResult c;
  c.definition.name = "wave";
  c.definition.resolution = "n";
  c.definition.size = "dx";
  c.definition.settings = {{"a", {}, {}}, {"b", {}, {}}};
  SuiteObservation o;
  o.name = "height";
  o.reference.kind = SuiteReference::Kind::formula;
  c.definition.observations = {o};
  for (const char* setting : {"a", "b"})
    for (int k = 0; k < 3; ++k) {
      RunResult run;
      run.setting = setting;
      run.resolution = std::to_string(10 << k);
      run.size = 0.1 / (1 << k);
      run.cpu_seconds = 1, run.particle_steps = 1000000;
      Observed observed;
      observed.name = "height";
      observed.found = true;
      observed.error = 0.4 * run.size * run.size;
      run.observed = {observed};
      c.runs.push_back(run);
    }
  c.runs.back().observed[0].error.reset();
  return c;
}

void judge(CaseResult& c) {
  c.orders = measured_orders(c.definition, c.runs);
  c.checks = check_bounds(c.definition, c.runs, c.orders);
}

TEST(Judge, OrdersAndBounds) {
  CaseResult c = made_case();
  c.definition.observations[0].bound = 0.4 * 0.025 * 0.025 * 1.001;
  c.definition.observations[0].least_order = 1.9;
  judge(c);
  ASSERT_EQ(c.orders.size(), 2u);
  EXPECT_NEAR(*c.orders[0].order, 2, 1e-9);
  EXPECT_NEAR(*c.orders[1].order, 2, 1e-9) << "of the two runs that have an error";
  ASSERT_EQ(c.checks.size(), 4u);
  EXPECT_TRUE(c.checks[0].met);
  EXPECT_TRUE(c.checks[1].met);
  EXPECT_FALSE(c.checks[2].met) << "no error at the finest resolution is a missed bound";
  EXPECT_TRUE(std::isnan(c.checks[2].measured));
  EXPECT_TRUE(c.checks[3].met);
  c.definition.observations[0].bound_settings = {"a"};
  judge(c);
  EXPECT_EQ(c.checks.size(), 2u);
  c.definition.observations[0].least_order = 2.1;
  judge(c);
  EXPECT_FALSE(c.checks[1].met);
  c.runs[0].verdict = Verdict::stopped;
  judge(c);
  EXPECT_EQ(c.checks[0].what, "n = 10 runs to its end");
  EXPECT_FALSE(c.checks[0].met);
}

TEST(Judge, BoundAgainstTheFinestRun) {
  CaseResult c = made_case();
  c.definition.settings.pop_back();
  c.runs.resize(3);
  c.runs[2].observed[0].error.reset();
  c.definition.observations[0].reference.kind = SuiteReference::Kind::finest;
  c.definition.observations[0].bound = 0.4 * 0.05 * 0.05 * 1.001;
  judge(c);
  ASSERT_EQ(c.checks.size(), 1u);
  EXPECT_TRUE(c.checks[0].met);
}

TEST(Judge, VerdictsOfStability) {
  SuiteStability stability;
  stability.limits = {
      {"residual", "residual", "0.01"}, {"growth", "growth / 2", "1"}, {"depth", "penetration", "0.1"}};
  stability.must_be_stable = "1 - c0", stability.must_stop = "c0 - 10";
  PlannedRun plan;
  plan.variables = {{"c0", 0}, {"dx", 0.5}};
  Observed growth;
  growth.name = "growth", growth.found = true, growth.value = 1.5;
  const auto judged = [&](Real c0, const RunNumbers& numbers, Verdict ended) {
    plan.variables["c0"] = c0;
    RunResult run;
    run.verdict = ended;
    run.observed = {growth};
    const BoundCheck check = judge_stability(stability, plan, numbers, run);
    EXPECT_EQ(check.met, run.as_required);
    return run;
  };
  const RunNumbers good{.residual = 0.001, .ratio = 1, .leaked = 0, .penetration = 0.04, .steps = 10};
  EXPECT_EQ(judged(0, good, Verdict::stable).verdict, Verdict::stable);
  EXPECT_TRUE(judged(0, good, Verdict::stable).as_required);
  RunNumbers deep = good;
  deep.penetration = 0.06;  // 0.12 spacings
  EXPECT_EQ(judged(0, deep, Verdict::stable).exceeded, std::vector<std::string>{"depth = 0.12 > 0.1"});
  EXPECT_EQ(judged(0, deep, Verdict::stable).verdict, Verdict::degraded);
  EXPECT_FALSE(judged(0, deep, Verdict::stable).as_required);
  EXPECT_TRUE(judged(5, deep, Verdict::stable).as_required) << "nothing is required there";
  EXPECT_TRUE(judged(5, good, Verdict::stopped).as_required);
  EXPECT_FALSE(judged(5, good, Verdict::broken).as_required) << "garbage never is";
  EXPECT_FALSE(judged(0, good, Verdict::stopped).as_required);
  EXPECT_FALSE(judged(20, good, Verdict::stable).as_required) << "it had to stop";
  EXPECT_TRUE(judged(20, good, Verdict::refused).as_required);
  growth.found = false, growth.value.reset(), growth.why = "no peaks";
  EXPECT_EQ(judged(0, good, Verdict::stable).exceeded[0], "growth = nan > 1 (growth: no peaks)");
  RunNumbers wrong = good;
  wrong.residual = std::nan("");
  EXPECT_EQ(judged(0, wrong, Verdict::stable).verdict, Verdict::degraded) << "no number is no pass";
}

TEST(Judge, HowARunEnded) {
  const ScratchFolder dir;
  const auto ended = [&](RunRecord record) {
    RunNumbers numbers;
    return result_of_run(dir.path(), record, numbers);
  };
  RunRecord record;
  record.key = "k";
  EXPECT_EQ(ended(record).reason, "exit code 0, but there is no summary.yaml");
  EXPECT_EQ(ended(record).verdict, Verdict::broken);
  record.exit_code = 3;
  EXPECT_EQ(ended(record).reason, "exit code 3");
  record.exit_code = 2;
  EXPECT_EQ(ended(record).reason, "stopped without a reason (exit code 2)");
  EXPECT_EQ(ended(record).verdict, Verdict::broken);
  write_file(dir / "errors.txt", "deck.k:3: warning: x\ndeck.k:4:1: error: no such thing\n");
  record.exit_code = 1;
  EXPECT_EQ(ended(record).verdict, Verdict::refused);
  EXPECT_EQ(ended(record).reason, "deck.k:4:1: error: no such thing");
  record.exit_code = -1, record.signal = 11;
  EXPECT_EQ(ended(record).verdict, Verdict::broken);
  record.signal = 0, record.timed_out = true, record.time_limit = 2.5;
  EXPECT_EQ(ended(record).reason, "ran longer than 2.5 s");
  record = {};
  write_file(dir / "summary.yaml",
             "termination: normal\nreason: done\nsteps: 5\nenergy: {total: .nan, ratio: 1}\n");
  EXPECT_EQ(ended(record).verdict, Verdict::broken);
  write_file(dir / "summary.yaml",
             "termination: normal\nreason: done\nsteps: 5\nenergy: {total: 1.5, ratio: 1}\n");
  EXPECT_EQ(ended(record).verdict, Verdict::stable);
  EXPECT_EQ(ended(record).steps, 5);
  write_file(dir / "summary.yaml", "termination: error\nreason: NaN at t = 1\nenergy: {total: 1.5}\n");
  record.exit_code = 2;
  EXPECT_EQ(ended(record).verdict, Verdict::stopped);
  EXPECT_EQ(ended(record).reason, "NaN at t = 1");
  write_file(dir / "summary.yaml",
             "termination: normal\nreason: done\nverdict: broken\nverdict_reasons: [it leaks]\nenergy: "
             "{total: 1}\n");
  EXPECT_EQ(ended(record).verdict, Verdict::degraded);
  EXPECT_EQ(ended(record).reason, "its results cannot be trusted: it leaks");

  record.key = "abc", record.wall_seconds = 1.25, record.timed_out = true;
  write_record(dir.path(), record);
  const auto again = read_record(dir.path());
  ASSERT_TRUE(again);
  EXPECT_EQ(again->key, "abc");
  EXPECT_EQ(again->exit_code, 2);
  EXPECT_EQ(again->wall_seconds, 1.25);
  EXPECT_TRUE(again->timed_out);
  write_file(dir / "record.yaml", "key: [");
  EXPECT_FALSE(read_record(dir.path()));
}

TEST(Judge, DigestsOfDecks) {
  const ScratchFolder dir;
  write_file(dir / "deck.k", "*KEYWORD\n*INCLUDE\n part.k \n*END\n");
  write_file(dir / "part.k", "*NODE\n");
  const std::string before = digest_of_deck(dir / "deck.k");
  EXPECT_EQ(digest_of_deck(dir / "deck.k"), before);
  write_file(dir / "part.k", "*NODE \n");
  EXPECT_NE(digest_of_deck(dir / "deck.k"), before) << "what a deck includes counts";
}

TEST(Judge, DigestsKnowIncludesAsTheReaderDoes) {
  const ScratchFolder dir;
  make_folder(dir / "mesh");
  write_file(
      dir / "deck.k",
      "*KEYWORD\n*PARAMETER\nC    mesh    coarse\n*include_path_relative\nmesh\n*include\n&mesh\n*END\n");
  for (const char* name : {"coarse", "fine"}) write_file(dir / "mesh" / name, "*NODE\n");
  const auto sum = [&](const SuiteParameters& parameters) {
    return digest_of_deck(dir / "deck.k", parameters);
  };
  const std::string coarse = sum({}), fine = sum({{"mesh", "fine"}});
  write_file(dir / "mesh/coarse", "*NODE \n");
  EXPECT_NE(sum({}), coarse);
  EXPECT_EQ(sum({{"mesh", "fine"}}), fine);
  write_file(dir / "mesh/fine", "*NODE \n");
  EXPECT_NE(sum({{"mesh", "fine"}}), fine);
}

TEST(Judge, FaultsOfTheMachineSayNothingOfTheDeck) {
  const ScratchFolder dir;
  const auto says = [&](RunRecord record, const std::string& summary) {
    write_file(dir / "summary.yaml", summary);
    RunNumbers numbers;
    return says_something_of_the_deck(record, result_of_run(dir.path(), record, numbers));
  };
  const std::string good = "termination: normal\nreason: done\nenergy: {total: 1.5, ratio: 1}\n";
  EXPECT_TRUE(says({}, good));
  EXPECT_TRUE(says({.exit_code = 2}, "termination: error\nreason: NaN at t = 1\n"));
  EXPECT_TRUE(says({.signal = 9, .timed_out = true, .time_limit = 2}, good));
  EXPECT_FALSE(says({.signal = 9}, good));
  EXPECT_FALSE(says({.exit_code = 127}, good));
  EXPECT_FALSE(says({}, "termination: interrupted\nreason: a signal\n"));
  const RunRecord stopped{.exit_code = 2};
  const std::string full = std::string("termination: error\nreason: \"") +
                           OutputError("history.h5", "No space left on device").what() + "\"\n";
  EXPECT_FALSE(says(stopped, full));
  RunNumbers numbers;
  EXPECT_EQ(result_of_run(dir.path(), stopped, numbers).verdict, Verdict::broken)
      << "not what a case may ask for";
}

Comparison compared(const SuiteResult& before, const SuiteResult& now) {
  const ScratchFolder dir;
  write_file(dir / "old.csv", results_csv(before));
  Diagnostics diagnostics;
  const auto out = compare_with(now, dir / "old.csv", diagnostics);
  EXPECT_TRUE(out) << diagnostics.text();
  return out.value_or(Comparison{});
}

TEST(Judge, WhatGotWorse) {
  SuiteResult before;
  before.cases = {made_case()};
  before.cases[0].definition.observations[0].bound = 3e-4;
  before.cases[0].definition.observations[0].bound_settings = {"a"};
  judge(before.cases[0]);
  before.cases[0].runs[1].reason = "a \"reason\", with\na line";
  SuiteResult now = before;
  EXPECT_TRUE(compared(before, now).lines.empty());
  EXPECT_EQ(compared(before, now).compared, 6);
  now.cases[0].runs[0].observed[0].error = *now.cases[0].runs[0].observed[0].error * 1.04;
  now.cases[0].runs[0].cpu_seconds = 1.25;
  EXPECT_TRUE(compared(before, now).lines.empty()) << "small changes say nothing";
  now.cases[0].runs[0].cpu_seconds = 1.4;
  now.cases[0].runs[1].observed[0].error = 1e-3 / 2;
  Comparison c = compared(before, now);
  ASSERT_EQ(c.lines.size(), 2u);
  EXPECT_EQ(c.lines[0].text, "wave: a, 10: 1400 ns of CPU time per particle and step, was 1000");
  EXPECT_TRUE(c.lines[0].worse);
  EXPECT_EQ(c.lines[1].text, "wave: a, 20, height: error 0.0005, was 0.001");
  EXPECT_FALSE(c.lines[1].worse);
  EXPECT_FALSE(c.regressed);
  now.cases[0].runs[2].observed[0].error = 1;
  judge(now.cases[0]);
  c = compared(before, now);
  EXPECT_TRUE(c.regressed);
  EXPECT_EQ(c.lines[2].text, "wave: a, 40, height: check missed, was met");
  EXPECT_FALSE(compared(now, before).regressed);
  EXPECT_FALSE(compared(now, now).regressed) << "what was missed before may stay so";
  now = before;
  now.cases[0].runs[3].verdict = Verdict::stopped, now.cases[0].runs[3].as_required = false;
  now.cases[0].runs[3].reason = "NaN";
  c = compared(before, now);
  EXPECT_TRUE(c.regressed);
  EXPECT_EQ(c.lines[0].text, "wave: b, 10: stopped, was stable: NaN");
  Diagnostics diagnostics;
  EXPECT_FALSE(compare_with(now, "/nowhere.csv", diagnostics));
  EXPECT_FALSE(diagnostics.ok());
}

TEST(Judge, TableForTheTerminal) {
  SuiteResult result;
  result.cases = {made_case()};
  result.cases[0].definition.observations[0].bound = 1e-5;
  judge(result.cases[0]);
  const std::string table = case_table(result.cases[0]);
  EXPECT_NE(table.find("0.025 %   2.00\n"), std::string::npos) << table;
  EXPECT_EQ(checks_text(result),
            "  MISSED  wave: a, height: error at most 1.0e-05: 0.025 %\n"
            "  MISSED  wave: b, height: error at most 1.0e-05: nan\n0 of 2 checks met, 2 missed\n");
  EXPECT_NE(results_yaml(result).find("ok: false"), std::string::npos);
}

TEST(RunSchedule, TimeLeft) {
  RunSchedule schedule({{0, 8}, {0, 1}, {1, 2}, {1, 1}}, 2);
  EXPECT_LT(schedule.seconds_left(), 0) << "nothing is known yet";
  schedule.started(1);
  schedule.ended(1, 2);
  EXPECT_DOUBLE_EQ(schedule.seconds_left(), 16) << "the longest run";
  schedule.ended(0, 24);  // case 0 takes 26/9 s per unit of cost, and case 1 is expected to be like it
  EXPECT_NEAR(schedule.seconds_left(), 2 * 26.0 / 9, 1e-9);
  schedule.ended(3, 1);
  EXPECT_DOUBLE_EQ(schedule.seconds_left(), 2);
  EXPECT_EQ(schedule.done(), 3u);
  EXPECT_EQ(duration_text(59.4), "59 s");
  EXPECT_EQ(duration_text(185), "3 min 05 s");
  EXPECT_EQ(duration_text(7800), "2 h 10 min");
}

}  // namespace
}  // namespace courant
