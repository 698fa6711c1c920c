// summary.yaml: each entry under its own name.
#include "output/summary.hpp"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cmath>

#include "output_test.hpp"

namespace courant::summary_test {

// Each number of the summary's ledger and times under its own name.
TEST(WrittenSummary, EnergiesAndTimes) {
  Summary s;
  EnergyLedger& e = s.energy;
  Real next = 1.5;
  for (Real* one : {&e.kinetic, &e.internal, &e.potential, &e.contact, &e.hourglass, &e.bulk_viscosity,
                    &e.dissipated, &e.external_work, &e.throughput, &e.initial, &e.peak})
    *one = next, next *= 1.7;
  s.wall_seconds = 3, s.cpu_seconds = 5, s.particle_steps = 7, s.element_steps = 11;
  test::ScratchFolder folder;
  write_summary(folder / "summary.yaml", s);
  const YAML::Node read = YAML::LoadFile((folder / "summary.yaml").string());
  const auto near = [](const YAML::Node& node, Real expected) {
    EXPECT_NEAR(node.as<Real>(), expected, 1e-9 * std::abs(expected));
  };
  const YAML::Node energy = read["energy"];
  near(energy["kinetic"], e.kinetic), near(energy["internal"], e.internal);
  near(energy["potential"], e.potential), near(energy["contact"], e.contact);
  near(energy["hourglass"], e.hourglass), near(energy["bulk_viscosity"], e.bulk_viscosity);
  near(energy["dissipated"], e.dissipated), near(energy["external_work"], e.external_work);
  near(energy["throughput"], e.throughput), near(energy["initial"], e.initial);
  near(energy["total"], e.total()), near(energy["residual"], e.total() - e.initial - e.external_work);
  near(energy["ratio"], e.total() / (e.initial + e.external_work));
  near(energy["scale"], e.peak + e.throughput), near(energy["error"], e.error());
  near(read["ns_per_particle_step"], 5e9 / 7), near(read["elapsed_ns_per_particle_step"], 3e9 / 7);
  near(read["ns_per_element_step"], 5e9 / 11), near(read["elapsed_ns_per_element_step"], 3e9 / 11);
}

// All else that the summary holds: each entry another value, read back under its name; what is empty is left
// out.
TEST(WrittenSummary, AllOtherEntries) {
  Summary s;
  s.title = "a", s.deck = "b", s.mass = "kg", s.length = "m", s.time_unit = "s", s.termination = "c",
  s.reason = "d";
  s.advice = "e", s.verdict = "doubtful", s.verdict_reasons = {"f", "g"}, s.restart_file = "h";
  s.restart_notes = {"i"}, s.notes = {"j"}, s.warnings = {"k", "l"};
  s.limits = {
      .residual_doubtful = 0.11, .residual_broken = 0.12, .leaks_doubtful = 0.13, .leaks_broken = 0.14};
  s.limits.hourglass_doubtful = 0.15, s.limits.hourglass_broken = 0.16, s.limits.mach_doubtful = 0.17;
  s.limits.density_doubtful = 0.18, s.limits.given = true;
  s.time = 1.5, s.steps = 2, s.restarts = 3, s.wall_seconds = 4.5, s.cpu_seconds = 5.5, s.read_seconds = 6.5;
  s.writer_cpu_seconds = 7.5, s.threads = 8, s.particles = 9, s.active_particles = 10, s.particle_steps = 11;
  s.elements = 12, s.element_steps = 13, s.peak_memory_bytes = 14, s.dt_min = 15.5, s.dt_max = 16.5;
  s.leaked_particles = 17, s.max_penetration = 18.5, s.counters = {{"clamped", 19}},
  s.maxima = {{"ratio", 20.5}};
  s.ranges.resize(2);
  s.ranges[1] = {.part = 21, .c0 = 22.5, .seen = true, .speed = {23.5, 24, 25.5}};
  s.ranges[1].density_low = {26.5, 27, 28.5}, s.ranges[1].density_high = {29.5, 30, 31.5};
  s.passes = {{"pass", 32.5, 33}}, s.output = {34.5, 4, 36, 37};
  test::ScratchFolder folder;
  write_summary(folder / "summary.yaml", s);
  const YAML::Node read = YAML::LoadFile((folder / "summary.yaml").string());
  const auto numbers = [&](const YAML::Node& of, const std::vector<std::pair<const char*, Real>>& expected) {
    for (const auto& [name, value] : expected) EXPECT_EQ(of[name].as<Real>(), value) << name;
  };
  numbers(read, {{"time", 1.5},
                 {"steps", 2},
                 {"restarts", 3},
                 {"wall_seconds", 4.5},
                 {"cpu_seconds", 5.5},
                 {"read_seconds", 6.5},
                 {"threads", 8},
                 {"particles", 9},
                 {"active_particles", 10},
                 {"particle_steps", 11},
                 {"elements", 12},
                 {"element_steps", 13},
                 {"peak_memory_bytes", 14},
                 {"dt_min", 15.5},
                 {"dt_max", 16.5},
                 {"leaked_particles", 17},
                 {"max_penetration", 18.5},
                 {"writer_cpu_seconds", 7.5}});
  numbers(read["verdict_limits"], {{"residual_doubtful", 0.11},
                                   {"residual_broken", 0.12},
                                   {"leaks_doubtful", 0.13},
                                   {"leaks_broken", 0.14},
                                   {"hourglass_doubtful", 0.15},
                                   {"hourglass_broken", 0.16},
                                   {"mach_doubtful", 0.17},
                                   {"density_doubtful", 0.18}});
  numbers(read["counters"], {{"clamped", 19}}), numbers(read["maxima"], {{"ratio", 20.5}});
  numbers(read["output"], {{"seconds", 34.5},
                           {"field_states", 4},
                           {"field_bytes", 36},
                           {"bytes_per_state", 9},
                           {"history_bytes", 37}});
  numbers(read["passes"][0], {{"seconds", 32.5}, {"calls", 33}});
  ASSERT_EQ(read["ranges"].size(), 1u) << "a part without particles was not seen";
  const YAML::Node range = read["ranges"][0];
  numbers(range, {{"part", 21}, {"sound_speed", 22.5}});
  numbers(range["speed"], {{"value", 23.5}, {"particle", 24}, {"time", 25.5}});
  numbers(range["density_ratio_low"], {{"value", 26.5}, {"particle", 27}, {"time", 28.5}});
  numbers(range["density_ratio_high"], {{"value", 29.5}, {"particle", 30}, {"time", 31.5}});
  const std::pair<const char*, const char*> texts[] = {
      {"title", "a"},  {"deck", "b"},           {"termination", "c"}, {"reason", "d"},
      {"advice", "e"}, {"verdict", "doubtful"}, {"restart_file", "h"}};
  for (const auto& [name, text] : texts) EXPECT_EQ(read[name].as<std::string>(), text) << name;
  using Texts = std::vector<std::string>;
  EXPECT_EQ(read["verdict_reasons"].as<Texts>(), (Texts{"f", "g"}));
  EXPECT_EQ(read["warnings"].as<Texts>(), (Texts{"k", "l"}));
  EXPECT_EQ(read["restart_notes"].as<Texts>(), Texts{"i"});
  EXPECT_EQ(read["notes"].as<Texts>(), Texts{"j"});
  EXPECT_EQ(read["passes"][0]["name"].as<std::string>(), "pass");
  EXPECT_EQ((read["units"].as<std::map<std::string, std::string>>()),
            (std::map<std::string, std::string>{{"length", "m"}, {"mass", "kg"}, {"time", "s"}}));
  write_summary(folder / "empty.yaml", Summary());
  const YAML::Node empty = YAML::LoadFile((folder / "empty.yaml").string());
  for (const char* name :
       {"units", "advice", "verdict", "verdict_limits", "restarts", "restart_notes", "notes", "restart_file"})
    EXPECT_FALSE(empty[name].IsDefined()) << name;
  numbers(empty["output"], {{"bytes_per_state", 0}});
  // next to nothing as measure: 1 and the error of the balance
  s.energy = {.kinetic = 3, .potential = -3, .throughput = 10};
  EXPECT_EQ(s.energy_ratio(), 1 + s.energy.error());
}

}  // namespace courant::summary_test
