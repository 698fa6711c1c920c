// What each feature of a scene costs, and that what a scene lacks costs nothing: one square of water with one
// feature more at a time, in turns with one that has none, so that load from others acts on both alike.
// Prints the table of docs/performance.md.
//   feature_costs [particles along a side] [builds] [rounds of each]
//   feature_costs --steps simulation|passes COUNT    only takes steps of the bare scene, so that others can
//   count
//                                                    instructions (absent_features.py)
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <stdexcept>

#include <unistd.h>

#include "bare_steps.hpp"
#include "output/ascii/ascii.hpp"
#include "parallel/parallel.hpp"

using namespace courant;
using namespace courant::benchmarks;

namespace {

/// Of the processor: others may use the machine.
double seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

using Steps = std::function<double(int steps)>;  ///< gives the particle-steps taken

/// Something that takes steps, beside a bare scene of its own that goes on in step with it: what builds lists
/// does so at the same time.
struct Feature {
  std::string name{};
  Steps run{}, base{};
  std::vector<double> ns{}, ratio{};  ///< per particle and step, and over that of the base, of each round
};

Feature simulated(const std::string& name, const SquareOfWater& water) {
  std::shared_ptr<Simulation> s = build(water);
  return {name, [s](int steps) {
            double done = 0;
            for (int k = 0; k < steps; ++k) {
              s->step([](World&, const Clock&, const std::string&) {});
              done += s->world().particles.active;
            }
            return done;
          }};
}

/// glstat, matsum, sphout of ten particles and history.h5 every ten steps, written on the computing thread.
Feature with_histories(int n) {
  SquareOfWater water{.n = n};
  water.keywords = "*DATABASE_SPHOUT\n1.\n*DATABASE_HISTORY_SPH\n1,2,3,4,5,6,7,8\n9,10\n";
  std::shared_ptr<Simulation> s = build(water);
  const auto dir = std::filesystem::temp_directory_path() / fmt::format("courant_features_{}", ::getpid());
  std::filesystem::create_directories(dir);
  HistoryRequests wanted;
  for (const char* name : {"glstat", "matsum", "sphout"})
    wanted.ask(name, 1e-12);  // due whenever they are asked
  wanted.titles.parts.push_back({1, "water"});
  std::shared_ptr<Histories> files(new Histories(dir, wanted), [dir](Histories* h) {
    delete h;
    std::filesystem::remove_all(dir);
  });
  return {"histories every 10 steps", [s, files](int steps) {
            double done = 0;
            for (int k = 0; k < steps; ++k) {
              s->step([&](World&, const Clock& clock, const std::string& who) {
                if (clock.cycle % 10 == 0) files->write(s->sample(who));
              });
              done += s->world().particles.active;
            }
            return done;
          }};
}

Feature bare(const std::string& name, int n, bool ledger) {
  auto steps_of = std::make_shared<BareSteps>(SquareOfWater{.n = n}, ledger);
  return {name, [steps_of](int steps) { return steps_of->take(steps); }};
}

std::string floor_at(Real y) {
  return fmt::format(
      "*NODE\n90001,-9.,{0},-9.\n90002,99.,{0},-9.\n90003,99.,{0},9.\n90004,-9.,{0},9.\n"
      "*ELEMENT_SHELL\n1,2,90001,90002,90003,90004\n*PART\nfloor\n2,2,2\n*SECTION_SHELL\n2,2\n0.001\n"
      "*MAT_RIGID\n2,7850.,2.1E11,0.3\n1,7,7\n*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n1,2,3,3\n0.\n1.\n",
      y);
}

std::vector<Feature> all_features(int n) {
  std::vector<Feature> out;
  const auto add = [&](const char* name, const std::function<void(SquareOfWater&)>& change) {
    SquareOfWater water{.n = n};
    change(water);
    out.push_back(simulated(name, water));
  };
  add("nothing but water, against itself", [](SquareOfWater&) {});
  out.push_back(bare("the same passes without `Simulation`", n, true));
  out.push_back(bare("and without energy ledger", n, false));
  add("gravity",
      [](SquareOfWater& w) { w.keywords = "*LOAD_BODY_Y\n1\n*DEFINE_CURVE\n1\n0.,9.81\n1.E6,9.81\n"; });
  add("viscous stress, MU > 0", [](SquareOfWater& w) { w.mu = "0.001"; });
  add("*COURANT_EDDY_VISCOSITY", [](SquareOfWater& w) { w.keywords = "*COURANT_EDDY_VISCOSITY\n0.001\n"; });
  add("bulk viscosity, IAVIS 1", [](SquareOfWater& w) { w.iavis = 1; });
  add("evolving h", [](SquareOfWater& w) { w.h_bounds = "0.2,2."; });
  add("contact, wall out of reach", [](SquareOfWater& w) { w.keywords = floor_at(-5); });
  add("contact, one row on the wall", [](SquareOfWater& w) { w.keywords = floor_at(-0.0005); });
  add("speed limit MAXV, not reached", [](SquareOfWater& w) { w.maxv = "1000."; });
  add("computational box around all", [](SquareOfWater& w) {
    w.box = 1;
    w.keywords = "*DEFINE_BOX\n1,-9.,99.,-9.,99.,-9.,99.\n";
  });
  add("ghost particles behind a symmetry plane",
      [](SquareOfWater& w) { w.keywords = "*BOUNDARY_SPH_SYMMETRY_PLANE\n0.,0.,0.,0.,1.,0.\n"; });
  add("fixed particles, a row of them", [n](SquareOfWater& w) {
    for (int i = 0; i < n; ++i) w.keywords += fmt::format("*BOUNDARY_SPC_NODE\n{},0,0,0,1\n", i + 1);
  });
  out.push_back(with_histories(n));
  add("equation of state with energy, C4 > 0", [](SquareOfWater& w) { w.c4 = "0.01"; });
  add("*COURANT_PAIR_GEOMETRY, EPS 0.005",
      [](SquareOfWater& w) { w.keywords = "*COURANT_PAIR_GEOMETRY\n0.005\n"; });
  return out;
}

/// Both ways to take steps must be the same computation, bit for bit, or they say nothing about each other.
void compare_bare_steps(int n, int steps) {
  const auto s = build(SquareOfWater{.n = n});
  BareSteps by_hand(SquareOfWater{.n = n}, true);
  for (int k = 0; k < steps; ++k) s->step([](World&, const Clock&, const std::string&) {});
  by_hand.take(steps);
  const Particles &a = s->world().particles, &b = by_hand.world().particles;
  for (Index i = 0; i < a.size(); ++i)
    if (a.id[i] != b.id[i] || a.x.vec(i) != b.x.vec(i) || a.rho[i] != b.rho[i])
      throw std::runtime_error("the passes without Simulation compute something else");
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

double ns_of(const Steps& run, int steps) {
  const double start = seconds();
  const double done = run(steps);
  return 1e9 * (seconds() - start) / done;
}

/// A round: a feature and its base in short turns, so that what others do to the caches and the clock of the
/// processor meets both.
void take_round(Feature& f, int steps) {
  constexpr int turn = 8;
  double ns = 0, base = 0;
  for (int done = 0; done < steps; done += turn) {
    ns += ns_of(f.run, turn);
    base += ns_of(f.base, turn);
  }
  f.ns.push_back(ns / std::ceil(1.0 * steps / turn));
  f.ratio.push_back(ns / base);
}

/// Where arrays come to lie in memory is worth per cents: so each scene is built several times.
std::vector<Feature> measure(int n, int builds, int rounds, int steps) {
  std::vector<Feature> out;
  for (int k = 0; k < builds; ++k) {
    std::vector<Feature> features = all_features(n);
    for (Feature& f : features) {
      f.base = simulated("", {.n = n}).run;
      f.run(steps), f.base(steps);  // lists, first contacts, memory
    }
    for (int round = 0; round < rounds; ++round)
      for (Feature& f : features) take_round(f, steps);
    if (out.empty()) out.resize(features.size());
    for (std::size_t j = 0; j < out.size(); ++j) {
      out[j].name = features[j].name;
      out[j].ns.insert(out[j].ns.end(), features[j].ns.begin(), features[j].ns.end());
      out[j].ratio.insert(out[j].ratio.end(), features[j].ratio.begin(), features[j].ratio.end());
    }
  }
  return out;
}

double look_ns(int n) {
  const auto s = build({.n = n});
  s->step([](World&, const Clock&, const std::string&) {});
  return ns_of(
      [&](int looks) {
        for (int k = 0; k < looks; ++k) s->guard().look(s->world(), s->clock());
        return 1.0 * looks * s->world().particles.active;
      },
      100);
}

void print(const std::vector<Feature>& features, int n, int builds, int rounds, int steps) {
  fmt::print(
      "Processor time of one thread, {} particles in 2D; {} times {} rounds of {} steps. Each scene takes "
      "turns with a "
      "bare one of its own; ratio: median over the rounds (in brackets: quartiles).\n\n",
      n * n, builds, rounds, steps);
  fmt::print("| scene | ns per particle and step | ratio |\n|---|---|---|\n");
  for (const Feature& f : features)
    fmt::print("| {} | {:.1f} | {:.3f} ({:.3f} to {:.3f}) |\n", f.name, quantile(f.ns, 0.5),
               quantile(f.ratio, 0.5), quantile(f.ratio, 0.25), quantile(f.ratio, 0.75));
  const double look = look_ns(n), step = quantile(features[0].ns, 0.5);
  fmt::print("\nA look of the guard takes {:.1f} ns per particle, every {} steps: {:.2f} % of a step.\n",
             look, Guard::interval, 100 * look / (Guard::interval * step));
}

/// One of the two ways that `compare_bare_steps` holds to be the same.
void take_steps(const std::string& way, int steps) {
  const SquareOfWater water{.n = 64};
  if (way == "passes") {
    BareSteps(water, true).take(steps);
    return;
  }
  const auto s = build(water);
  for (int k = 0; k < steps; ++k) s->step([](World&, const Clock&, const std::string&) {});
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 4 && std::string(argv[1]) == "--steps") {
    set_threads(1);
    take_steps(argv[2], std::atoi(argv[3]));
    return 0;
  }
  const auto argument = [&](int k, int standard) {
    return argc > k ? std::max(1, std::atoi(argv[k])) : standard;
  };
  const int n = argument(1, 141), builds = argument(2, 4), rounds = argument(3, 5), steps = Guard::interval;
  set_threads(1);
  compare_bare_steps(std::min(n, 24), 30);
  print(measure(n, builds, rounds, steps), n, builds, rounds, steps);
  return 0;
}
