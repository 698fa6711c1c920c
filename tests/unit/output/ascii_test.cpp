#include "output/ascii/ascii.hpp"

#include <yaml-cpp/yaml.h>

#include "../text.hpp"
#include "output/messag.hpp"
#include "output/summary.hpp"
#include "output_test.hpp"

namespace courant {
namespace {

using test::ScratchFolder;

Sample made_sample() {
  Sample s;
  s.t = 0.02;
  s.dt = 2.5e-6;
  s.cycle = 8001;
  s.dt_set_by = "sph particle 17 of part 1";
  s.ns_per_zone_cycle = 99.6;
  s.energy = {.kinetic = 100,
              .internal = 20,
              .potential = 7,
              .contact = 3,
              .dissipated = 5,
              .external_work = 25,
              .initial = 110};
  s.velocity = Vec(1.5, 0, 0);
  s.parts = {{.id = 1, .title = "water", .internal = 20, .kinetic = 100, .momentum = Vec(30, -1, 0)}};
  InterfaceForce contact;
  contact.id = 4;
  contact.title = "water on walls";
  contact.on_surfa = Vec(0, 196.2, 0);
  contact.energy_damping = 2;
  s.interfaces = {contact};
  s.particles = {{.id = 17, .active = false, .x = Vec(0.1, 0.2, 0), .p = 1234.5}};
  return s;
}

TEST(Glstat, LayoutAndMeaning) {
  // first potential 4: gravity did 4 - 7 = -3 of external work
  const std::string expected =
      "\n\n dt of cycle    8001 is controlled by sph               17\n\n"
      " time...........................   2.00000E-02\n"
      " time step......................   2.50000E-06\n"
      " kinetic energy.................   1.00000E+02\n"
      " internal energy................   2.30000E+01\n"
      " stonewall energy...............   0.00000E+00\n"
      " rigid body stopper energy......   0.00000E+00\n"
      " spring and damper energy.......   0.00000E+00\n"
      " system damping energy..........   0.00000E+00\n"
      " sliding interface energy.......   5.00000E+00\n"
      " external work..................   2.20000E+01\n"
      " eroded kinetic energy..........   0.00000E+00\n"
      " eroded internal energy.........   0.00000E+00\n"
      " eroded hourglass energy........   0.00000E+00\n"
      " total energy...................   1.28000E+02\n"
      " total energy / initial energy..   1.00000E+00\n"
      " energy ratio w/o eroded energy.   1.00000E+00\n"
      " global x velocity..............   1.50000E+00\n"
      " global y velocity..............   0.00000E+00\n"
      " global z velocity..............   0.00000E+00\n"
      " time per zone cycle.(nanosec)..           100\n";
  EXPECT_EQ(made_sample().energy.residual(), 0);
  EXPECT_EQ(history_text("glstat", made_sample(), 4), expected);
}

TEST(Matsum, Layout) {
  EXPECT_EQ(
      history_text("matsum", made_sample()),
      "\n\n time =   2.0000E-02\n"
      " mat.#=    1             inten=   2.0000E+01     kinen=   1.0000E+02     eroded_ie=   0.0000E+00     "
      "eroded_ke=   "
      "0.0000E+00\n"
      " x-mom=   3.0000E+01     y-mom=  -1.0000E+00     z-mom=   0.0000E+00\n"
      " x-rbv=   0.0000E+00     y-rbv=   0.0000E+00     z-rbv=   0.0000E+00\n"
      "                         hgeng=   0.0000E+00     +mass=   0.0000E+00     eroded_he=   0.0000E+00\n\n");
}

TEST(Rcforc, LayoutAndOppositeSides) {
  EXPECT_EQ(history_text("rcforc", made_sample()),
            "  SURFA           4 time 2.00000E-02  x  0.00000E+00  y  1.96200E+02  z  0.00000E+00 mass  "
            "0.00000E+00\n"
            "  SURFB           4 time 2.00000E-02  x  0.00000E+00  y -1.96200E+02  z  0.00000E+00 mass  "
            "0.00000E+00\n");
}

TEST(Sphout, StressOfPressureAndViscosity) {
  Sample s = made_sample();
  s.particles[0].part = 3;
  s.particles[0].rho = 1001;
  s.particles[0].h = 0.006;
  s.particles[0].neighbours = 20;
  s.particles[0].tau = {1, -1, 0, 2, 0, 0};
  const std::string text = history_text("sphout", s);
  for (const char* line :
       {"\n\n\n S P H   o u t p u t       at time 2.0000E-02     for  time  step      8001\n",
        "      17     3 -1.2335E+03 -1.2355E+03 -1.2345E+03  2.0000E+00  0.0000E+00  0.0000E+00\n",
        "      17     3  1.0010E+03  6.0000E-03     20     0\n",
        "      17     3  0.0000E+00  3.8730E+00   elastic\n"})
    EXPECT_NE(text.find(line), std::string::npos) << line << text;
}

TEST(Sleout, SumIsTheSlidingEnergy) {
  Sample s = made_sample();
  s.interfaces[0].energy_stored = 3;
  s.interfaces[0].energy_friction = 0.5;
  EXPECT_EQ(history_text("sleout", s),
            "\n\n\n contact interface energy file, time= 2.0000000E-02\n"
            "    #             surfa       surfb        cycle=          8001    frictional\n\n"
            "         4   5.5000E+00   0.0000E+00                              5.0000E-01\n"
            "\n summary   total surfa side= 5.5000000E+00\n"
            "           total surfb side= 0.0000000E+00\n"
            "           total energy    = 5.5000000E+00\n"
            "           total friction  = 5.0000000E-01\n\n\n\n");
}

TEST(Nodout, RotationsOnlyWhereSomethingTurns) {
  Sample s = made_sample();
  s.nodes = {
      {.id = 7, .displacement = Vec(1, 0, 0), .x = Vec(2, 0, 0), .v = Vec(0, -3, 0), .a = Vec(0, 0, 4)}};
  const std::string row =
      "        7   1.0000E+00  0.0000E+00  0.0000E+00  0.0000E+00 -3.0000E+00  0.0000E+00  0.0000E+00"
      "  0.0000E+00  4.0000E+00  2.0000E+00  0.0000E+00  0.0000E+00\n";
  EXPECT_NE(history_text("nodout", s).find(row), std::string::npos) << history_text("nodout", s);
  EXPECT_EQ(history_text("nodout", s).find("x-rot"), std::string::npos);
  s.nodes[0].turns = true;
  EXPECT_NE(history_text("nodout", s).find("x-rot"), std::string::npos);
}

TEST(AsciiHeader, LegendAndTitle) {
  EXPECT_EQ(ascii_legend({{4, "water on walls"}}),
            "\n{BEGIN LEGEND}\n Entity #        Title\n        4     water on walls" + std::string(56, ' ') +
                "\n{END LEGEND}\n");
  const std::string header = ascii_header("channel", "11/21/2026");
  EXPECT_EQ(header.substr(0, 74), " channel" + std::string(65, ' ') + "\n");
  EXPECT_NE(header.find("date 11/21/2026\n"), std::string::npos);
}

HistoryRequests asked(const std::vector<std::pair<std::string, Real>>& intervals, const std::string& title) {
  HistoryRequests out{.title = title};
  for (const auto& [name, interval] : intervals) out.ask(name, interval);
  return out;
}

TEST(Histories, OfAnEarlierRunDoNotStayBehind) {
  ScratchFolder dir;
  const auto run = [&](const HistoryRequests& wanted) {
    Histories histories(dir.path(), wanted);
    Sample s = made_sample();
    s.dt = 0.1;
    histories.write(s, true);
    histories.finish();
  };
  write_file(dir / "matsum", " theirs\n                         ls-dyna\n");
  run(asked({{"glstat", 0.25}, {"rcforc", 0.5}}, "first"));
  EXPECT_TRUE(std::filesystem::exists(dir / "rcforc"));
  run(asked({{"glstat", 0.25}}, "second"));
  EXPECT_FALSE(std::filesystem::exists(dir / "rcforc")) << "it would pass for one of the second run";
  EXPECT_TRUE(std::filesystem::exists(dir / "glstat"));
  EXPECT_TRUE(std::filesystem::exists(dir / "matsum")) << "others' files are theirs";
}

TEST(Histories, EachFileAtItsOwnInterval) {
  ScratchFolder dir;
  Histories histories(dir.path(), asked({{"glstat", 0.25}, {"rcforc", 0.5}}, "channel"));
  int asked = 0;
  const Real dt = 0.0625;
  for (int n = 0; n < 17; ++n) {
    if (!histories.is_due(n * dt, dt)) continue;
    ++asked;
    Sample s = made_sample();
    s.t = n * dt;
    s.dt = dt;
    histories.write(s, n == 16);
  }
  histories.finish();
  EXPECT_EQ(asked, 5);
  EXPECT_EQ(test::count(test::read_text(dir / "glstat"), " time step."), 5u);
  EXPECT_EQ(test::count(test::read_text(dir / "rcforc"), "SURFA"), 3u);
  EXPECT_FALSE(std::filesystem::exists(dir / "matsum"));
  EXPECT_TRUE(std::filesystem::exists(dir / "history.h5"));
}

// External work of glstat counts from the potential energy of the start of the run, 4, also behind a restart.
TEST(Histories, ARestartKnowsThePotentialEnergyOfTheStart) {
  for (const bool restarted : {false, true}) {
    ScratchFolder dir;
    HistoryPositions before;
    before.first_potential = {4};
    Histories histories(dir.path(), asked({{"glstat", 0.25}}, "channel"), restarted ? &before : nullptr);
    histories.write(made_sample(), true);
    histories.finish();
    const std::string of_work = restarted ? "2.20000E+01" : "2.50000E+01";  // 25 + 4 - 7, or + 7 - 7
    EXPECT_NE(test::read_text(dir / "glstat").find("external work..................   " + of_work),
              std::string::npos);
  }
}

TEST(Histories, TakenSamplesCanBeWrittenLater) {
  ScratchFolder dir;
  Histories histories(dir.path(), asked({{"glstat", 0.25}, {"rcforc", 0.5}}, "channel"));
  std::vector<std::pair<Sample, Histories::Due>> waiting;
  for (int n = 0; n < 9; ++n) {
    Sample s = made_sample();
    s.t = n * 0.125;
    s.dt = 0.125;
    if (histories.is_due(s.t, s.dt)) waiting.emplace_back(s, histories.take(s.t, s.dt));
  }
  ASSERT_EQ(waiting.size(), 5u);
  EXPECT_EQ(waiting[1].second, (Histories::Due{true, false, true}));  // glstat, rcforc, history.h5
  EXPECT_EQ(histories.take(1, 0.125, true), (Histories::Due{false, false, false}));  // all have t = 1
  for (const auto& [sample, due] : waiting) histories.write(sample, due);
  histories.finish();
  const std::string glstat = test::read_text(dir / "glstat"), rcforc = test::read_text(dir / "rcforc");
  for (const char* t : {"0.00000E+00", "2.50000E-01", "5.00000E-01", "7.50000E-01", "1.00000E+00"})
    EXPECT_NE(glstat.find(std::string("time...........................   ") + t), std::string::npos) << t;
  EXPECT_NE(rcforc.find("time 5.00000E-01"), std::string::npos);
  EXPECT_EQ(rcforc.find("time 2.50000E-01"), std::string::npos);
}

TEST(OutputSchedule, LastCycleBeforeTheDueTime) {
  OutputSchedule schedule(0.1);
  EXPECT_TRUE(schedule.take(0, 0.03));
  EXPECT_FALSE(schedule.take(0.03, 0.03));
  EXPECT_FALSE(schedule.take(0.06, 0.03));
  EXPECT_TRUE(schedule.take(0.09, 0.03));  // 0.09 <= 0.1 < 0.12
  EXPECT_FALSE(schedule.take(0.12, 0.03));
  EXPECT_TRUE(schedule.take(0.15, 0.4));  // 0.2 ... 0.5 fall into one step: one state
  EXPECT_FALSE(schedule.take(0.55, 0.01));
  EXPECT_TRUE(schedule.take(0.59, 0.02));
  EXPECT_FALSE(OutputSchedule(0).take(0, 1));
}

// Sums of steps end beside the due time by round-off, in some units only: the sample is that of this time.
TEST(OutputSchedule, RoundOffMovesNoSample) {
  for (const Real unit : {1.0, 1e-3, 1e3, 0.7}) {
    const Real dt = 0.0005 * unit;
    OutputSchedule schedule(10 * dt), after(0, [dt](Real due) { return due + 10 * dt; });
    Real t = 0;
    for (int n = 0; n <= 100000; ++n, t += dt) {
      ASSERT_EQ(schedule.take(t, dt), n % 10 == 0) << unit << " " << n;
      ASSERT_EQ(after.take(t, dt), n % 10 == 0) << unit << " " << n;
    }
    OutputSchedule again(10 * dt);
    again.skip_to(t);  // behind a restart the same ones
    EXPECT_DOUBLE_EQ(again.next(), schedule.next());
  }
}

TEST(OutputSchedule, FollowsWhatTellsTheNextTime) {
  OutputSchedule schedule(0, [](Real due) { return due + (due < 0.25 ? 0.1 : 1); });  // 0 0.1 0.2 0.3 1.3
  std::vector<int> taken;
  for (int n = 0; n < 32; ++n)
    if (schedule.take(n * 0.0625, 0.0625)) taken.push_back(n);
  EXPECT_EQ(taken, (std::vector<int>{0, 1, 3, 4, 20}));
  schedule.skip_to(0.25);
  EXPECT_NEAR(schedule.next(), 0.3, 1e-15);
  schedule.skip_to(0.15);
  EXPECT_NEAR(schedule.next(), 0.2, 1e-15);
  EXPECT_TRUE(schedule.is_wanted());
  EXPECT_FALSE(OutputSchedule(0.5, [](Real due) { return due; }).is_due(0.4, 0.1));
  OutputSchedule stuck(0, [](Real due) { return due; });  // below round-off
  EXPECT_TRUE(stuck.take(0, 1));
  EXPECT_FALSE(stuck.take(1, 1));
}

TEST(OutputSchedule, RestartGoesOnWithTheNextDueTime) {
  OutputSchedule schedule(0.1);
  schedule.skip_to(0.25);
  EXPECT_NEAR(schedule.next(), 0.3, 1e-15);
  EXPECT_FALSE(schedule.take(0.25, 0.04));
  EXPECT_TRUE(schedule.take(0.29, 0.04));
}

TEST(Messag, StatusLineAndEcho) {
  EXPECT_EQ(status_line(5000, 1.25e-3, 2.5e-7, "flush i/o buffers", "11/21/26 08:00:00"),
            "    5000 t 1.2500E-03 dt 2.50E-07 flush i/o buffers            11/21/26 08:00:00");
  ScratchFolder dir;
  std::string shown;
  Messag messag(dir / "messag", [&](std::string_view line) { shown += line; });
  messag.line("hello");
  EXPECT_EQ(shown, "hello");
  EXPECT_EQ(test::read_text(dir / "messag"), "hello\n");
  messag.keep("for later");
  messag.keep_status(7, 0.5, 0.25, "write field state 0");
  EXPECT_EQ(shown, "hello");
  EXPECT_EQ(test::read_text(dir / "messag")
                .rfind("hello\nfor later\n       7 t 5.0000E-01 dt 2.50E-01 write field", 0),
            0u);
}

TEST(Summary, ComesBackAsYaml) {
  ScratchFolder dir;
  Summary s;
  s.title = "jump: d1/4";
  s.termination = "normal";
  s.wall_seconds = 2, s.cpu_seconds = 3;
  s.writer_cpu_seconds = 0.25;
  s.particle_steps = 1000000;
  s.energy = made_sample().energy;
  s.counters = {{"density clamped", 0}};
  s.warnings = {"deck.k:3:1: warning: x"};
  s.passes = {{"sph force", 1.5, 10}};
  write_summary(dir / "summary.yaml", s);
  const YAML::Node y = YAML::LoadFile((dir / "summary.yaml").string());
  EXPECT_EQ(y["title"].as<std::string>(), "jump: d1/4");
  EXPECT_EQ(y["writer_cpu_seconds"].as<double>(), 0.25);
  EXPECT_EQ(y["ns_per_particle_step"].as<double>(), 3000);
  EXPECT_EQ(y["elapsed_ns_per_particle_step"].as<double>(), 2000);
  EXPECT_EQ(y["energy"]["ratio"].as<double>(), 1);
  EXPECT_EQ(y["energy"]["residual"].as<double>(), 0);
  EXPECT_EQ(y["counters"]["density clamped"].as<int>(), 0);
  EXPECT_EQ(y["passes"][0]["seconds"].as<double>(), 1.5);
  EXPECT_EQ(y["warnings"][0].as<std::string>(), "deck.k:3:1: warning: x");
  write_summary(dir / "empty.yaml", Summary());
  EXPECT_TRUE(YAML::LoadFile((dir / "empty.yaml").string()).IsMap());
}

}  // namespace
}  // namespace courant
