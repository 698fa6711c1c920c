// Courant inside another program: reads a deck, reports its faults, or prints its parts and takes a hundred
// steps.
//   parts_of_deck DECK.k
#include <cstdio>
#include <map>

#include "app/run/simulation.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: parts_of_deck DECK.k\n");
    return 1;
  }
  courant::Diagnostics diagnostics;
  const auto simulation = courant::Simulation::build(argv[1], {}, diagnostics);
  std::fputs(diagnostics.text().c_str(), stderr);
  if (!simulation) return 1;

  const courant::Model& model = simulation->model();
  std::map<courant::Index, int> particles, shells;
  const courant::Particles& p = simulation->world().particles;
  for (courant::Index i = 0; i < p.size(); ++i) ++particles[p.part[i]];
  for (const auto& s : model.shells) ++shells[s.part];
  std::printf("%s\n%10s %10s %10s  %s\n", model.title.c_str(), "part", "particles", "shells", "title");
  for (courant::Index i = 0; i < static_cast<courant::Index>(model.parts.size()); ++i)
    std::printf("%10lld %10d %10d  %s\n", static_cast<long long>(model.parts[i].id), particles[i], shells[i],
                model.parts[i].title.c_str());

  for (int k = 0; k < 100; ++k)
    simulation->step([](courant::World&, const courant::Clock&, const std::string&) {});
  courant::sample_energy(simulation->world(), simulation->clock());
  std::printf("after 100 steps: time %.6g, kinetic energy %.6g\n", simulation->clock().t,
              simulation->world().energy.kinetic);
  return 0;
}
