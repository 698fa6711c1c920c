// Choices multiply: every pair of choices of an SPH deck runs, keeps momentum and accounts for its energy, or
// is refused by name and is in docs/choices.md with the reason.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>

#include "../app/small_scene.hpp"
#include "base/run_error.hpp"

using namespace courant;

namespace {

/// What choices change of a deck: a drop that turns and is squeezed, above a plate where there is one.
struct Scene {
  int dim = 2;
  std::string kernel = "0", section_h = "1,1", second_cslh = "1.3";
  bool second_part = false, strength = false, mu = false;
  std::string iavis = "0", form = "0", ishift = "0", extra;
  enum { no_wall, still, free } wall = no_wall;
};

struct Choice {
  std::string name;   ///< as docs/choices.md has it
  std::string group;  ///< choices of one group exclude each other
  std::function<void(Scene&)> make;
  bool keeps_momentum = true;
  Real residual = 0.02;  ///< most of the energy balance, of the kinetic energy at the start
};

void add_kernel(Scene& s, const std::string& number, const std::string& name = "") {
  s.kernel = number;
  if (!name.empty()) s.extra += "*COURANT_KERNEL\n" + name + "\n";
}

const std::vector<Choice>& choices() {
  static const std::vector<Choice> all{
      {"quintic spline", "kernel", [](Scene& s) { add_kernel(s, "1"); }},
      {"quadratic spline", "kernel", [](Scene& s) { add_kernel(s, "2"); }},
      {"quartic spline", "kernel", [](Scene& s) { add_kernel(s, "3"); }},
      {"Wendland C2", "kernel", [](Scene& s) { add_kernel(s, "0", "wendland_c2"); }},
      {"Wendland C4", "kernel", [](Scene& s) { add_kernel(s, "0", "wendland_c4"); }},
      {"three dimensions", "dimension", [](Scene& s) { s.dim = 3; }},
      {"h that differs", "h", [](Scene& s) { s.second_part = true; }},
      {"h that changes", "h", [](Scene& s) { s.section_h = "0.5,2"; }},
      {"bulk viscosity", "viscosity", [](Scene& s) { s.iavis = "1"; }},
      {"Riemann flux", "viscosity", [](Scene& s) { s.extra += "*COURANT_RIEMANN\n3.\n"; }},
      {"MU", "mu", [](Scene& s) { s.mu = true; }},
      {"eddy viscosity", "eddy", [](Scene& s) { s.extra += "*COURANT_EDDY_VISCOSITY\n0.1,0.09\n"; }},
      {"k-epsilon", "eddy", [](Scene& s) { s.extra += "*COURANT_TURBULENCE\n2\n,,,,0.01,0.1\n"; }},
      {"Smagorinsky", "eddy", [](Scene& s) { s.extra += "*COURANT_TURBULENCE\n3\n"; }},
      {"density diffusion", "density diffusion",
       [](Scene& s) { s.extra += "*COURANT_DENSITY_DIFFUSION\n0.05\n"; }},
      {"volume control", "volume control", [](Scene& s) { s.extra += "*COURANT_VOLUME_CONTROL\n0.05\n"; }},
      {"re-initialisation", "re-initialisation",
       [](Scene& s) { s.extra += "*COURANT_DENSITY_REINITIALISATION\n10,1\n"; }},
      {"FORM 1", "form", [](Scene& s) { s.form = "1"; }},
      {"FORM 1, reverse", "form", [](Scene& s) { s.form = "1", s.extra += "*COURANT_RENORMALISATION\n1\n"; },
       true, 0.05},  // its forces are no transpose of its continuity, and keep no energy
      {"FORM 1, plain pressure", "form",
       [](Scene& s) { s.form = "1", s.extra += "*COURANT_RENORMALISATION\n0,1\n"; }, true, 0.05},  // neither
      {"XSPH", "xsph", [](Scene& s) { s.extra += "*COURANT_XSPH\n0.5\n"; }},
      {"XSPH, normed", "xsph", [](Scene& s) { s.extra += "*COURANT_XSPH\n0.5,1\n"; }},
      {"XSPH of velocities", "xsph", [](Scene& s) { s.extra += "*COURANT_XSPH\n0.01,0,1\n"; }},
      {"XSPH of velocities, normed", "xsph", [](Scene& s) { s.extra += "*COURANT_XSPH\n0.01,1,1\n"; },
       false},  // means of unequal sums
      {"shifting", "shifting", [](Scene& s) { s.ishift = "1"; }},
      {"shifting, velocity corrected", "shifting",
       [](Scene& s) { s.ishift = "1", s.extra += "*COURANT_SHIFTING\n2.,0.2,0.,1\n"; }, false},
      {"wall support", "wall", [](Scene& s) { s.wall = Scene::still; }, false},
      {"wall support, moving", "wall", [](Scene& s) { s.wall = Scene::free; }},
      {"frozen gradients", "kept", [](Scene& s) { s.extra += "*COURANT_PAIR_GEOMETRY\n0.01\n"; }},
      {"strength", "strength", [](Scene& s) { s.strength = true; }},
      {"strength, artificial stress", "strength",
       [](Scene& s) { s.strength = true, s.extra += "*COURANT_ARTIFICIAL_STRESS\n0.3\n"; }},
  };
  return all;
}

constexpr Real dx = 0.1;

std::string plate(const Scene& s) {
  return fmt::format(
      "*NODE\n9001,-2.,-0.05,{0}\n9002,3.,-0.05,{0}\n9003,3.,-0.05,{1}\n9004,-2.,-0.05,{1}\n"
      "*ELEMENT_SHELL\n1,9,9001,9002,9003,9004\n*PART\nplate\n9,9,9\n*SECTION_SHELL\n9,2\n0.1\n"
      "*MAT_RIGID\n9,500.,2.1E11,0.3\n{2}\n*COURANT_WALL_SUPPORT\n9,3\n"
      "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n1,9,3,3\n0.\n1.\n{3}",
      s.dim == 2 ? 0 : -2, s.dim == 2 ? 1 : 3, s.wall == Scene::still ? "1,7,7" : "0",
      s.second_part ? "*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n2,9,3,3\n0.\n1.\n" : "");
}

std::string text_of(const Scene& s) {
  const int n = s.dim == 2 ? 8 : 5, depth = s.dim == 2 ? 1 : n;
  std::string nodes, elements, velocities;
  int id = 0;
  for (int k = 0; k < depth; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const Vec x(dx * (i + 0.5), dx * (j + 0.5), s.dim == 2 ? 0 : dx * (k + 0.5));
        const Vec r = x / (n * dx) - Vec(0.5, 0.5, s.dim == 2 ? 0 : 0.5);
        nodes += fmt::format("{},{:.6f},{:.6f},{:.6f}\n", ++id, x[0], x[1], x[2]);
        elements +=
            fmt::format("{},{},{}\n", id, s.second_part && i >= n / 2 ? 2 : 1, 1000 * std::pow(dx, s.dim));
        velocities += fmt::format("{},{:.6f},{:.6f},{:.6f}\n", id, -0.8 * r[1] - 0.5 * r[0],
                                  0.8 * r[0] - 0.4 * r[1] - 0.1, s.dim == 2 ? 0 : 0.3 * r[0]);
      }
  const auto section = [&](int number, const std::string& cslh) {
    return fmt::format("*SECTION_SPH\n{},{},{},0,0,0,{}\n", number, cslh, s.section_h, s.kernel);
  };
  const std::string eosid = s.strength ? "0" : "1";
  std::string text = "*KEYWORD\n*NODE\n" + nodes + "*ELEMENT_SPH\n" + elements + "*INITIAL_VELOCITY_NODE\n" +
                     velocities + "*PART\none\n1,1,1," + eosid + ",1\n" + section(1, "1.2");
  if (s.second_part) text += "*PART\nother\n2,2,1," + eosid + ",1\n" + section(2, s.second_cslh);
  text += s.strength ? "*MAT_ELASTIC\n1,1000.,4.E5,0.3\n"
                     : fmt::format("*MAT_NULL\n1,1000.,-1.E20,{}\n*EOS_LINEAR_POLYNOMIAL\n1,0.,4.E5\n\n",
                                   s.mu ? "1." : "0.");
  text += "*HOURGLASS\n1,0,0,0,1.E-20,0.1\n*CONTROL_SPH\n1,0,1.E20," + std::to_string(s.dim) + ",150," +
          s.form + "\n0,0,0,0,0,0," + s.iavis + "\n0,0,0,,0," + s.ishift +
          "\n*CONTROL_TIMESTEP\n0.,0.2\n*CONTROL_TERMINATION\n1.\n";
  if (s.wall != Scene::no_wall) text += plate(s);
  return text + s.extra + "*END\n";
}

struct Outcome {
  bool refused = false;
  std::string said;
  Real momentum = 0, residual = 0;  ///< that came from nowhere, of what there is
};

Vec momentum_of(Simulation& s) {
  const Sample now = s.sample("");
  return now.mass * now.velocity;
}

Outcome run(const Scene& scene) {
  Outcome out;
  Diagnostics diagnostics;
  const auto s = Simulation::build("deck.k", in_memory(text_of(scene)), diagnostics);
  out.said = diagnostics.text();
  if (!s) {
    out.refused = true;
    return out;
  }
  std::string who;
  s->evaluate(who);  // without it nothing is active
  const Vec before = momentum_of(*s);
  const Particles& p = s->world().particles;
  Real energy = 0, scale = 0;
  for (Index i = 0; i < p.size(); ++i)
    energy += 0.5 * p.m[i] * p.v.vec(i).squaredNorm(), scale += p.m[i] * p.v.vec(i).norm();
  try {
    while (s->clock().t < 0.08) s->step([](World&, const Clock&, const std::string&) {});
  } catch (const RunError& error) {
    out.said = error.what();
    out.momentum = out.residual = 1e9;
    return out;
  }
  out.momentum = (momentum_of(*s) - before).norm() / scale;
  out.residual = std::abs(s->sample("").energy.residual()) / energy;
  if (!std::isfinite(out.momentum + out.residual)) out.momentum = out.residual = 1e9;
  return out;
}

/// Rows "| a | b | reason |" of docs/choices.md.
std::set<std::pair<std::string, std::string>> documented() {
  std::ifstream file(std::string(SOURCE_DIR) + "/docs/choices.md");
  std::set<std::pair<std::string, std::string>> out;
  for (std::string line; std::getline(file, line);) {
    std::stringstream row(line);
    std::vector<std::string> cells;
    for (std::string cell; std::getline(row, cell, '|');) {
      while (!cell.empty() && cell.front() == ' ') cell.erase(0, 1);
      while (!cell.empty() && cell.back() == ' ') cell.pop_back();
      cells.push_back(cell);
    }
    if (cells.size() == 4 && cells[0].empty()) out.emplace(cells[1], cells[2]);
  }
  return out;
}
bool is_documented(const std::string& a, const std::string& b) {
  static const auto pairs = documented();
  return pairs.count({a, b}) > 0 || pairs.count({b, a}) > 0;
}

}  // namespace

TEST(Choices, EveryPairRunsOrIsRefusedForAReasonThatTheDocsGive) {
  const auto& all = choices();
  std::set<std::set<std::string>> refused;
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = a; b < all.size(); ++b) {  // each by itself, too
      if (a != b && all[a].group == all[b].group) continue;
      const std::string what = a == b ? all[a].name : all[a].name + " and " + all[b].name;
      Scene scene;
      all[a].make(scene);
      if (a != b) all[b].make(scene);
      const Outcome out = run(scene);
      if (out.refused) {
        refused.insert({all[a].group, all[b].group});
        EXPECT_TRUE(is_documented(all[a].name, all[b].name)) << what << " is refused: " << out.said;
        continue;
      }
      EXPECT_FALSE(is_documented(all[a].name, all[b].name)) << what << " runs";
      if (all[a].keeps_momentum && all[b].keeps_momentum)
        EXPECT_LT(out.momentum, 1e-11) << what << " " << out.said;
      EXPECT_LT(out.residual, std::max(all[a].residual, all[b].residual)) << what;
    }
  EXPECT_LE(refused.size(), 10u);
}
