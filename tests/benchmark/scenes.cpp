#include "scenes.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <unordered_map>

#include "../generate_deck.hpp"
#include "parallel/parallel.hpp"

namespace courant::benchmarks {

namespace {

void nothing(World&, const Clock&, const std::string&) {}

/// In front of *END.
void add_cards(const std::filesystem::path& deck, const std::string& cards) {
  std::ifstream in(deck);
  std::string text((std::istreambuf_iterator<char>(in)), {});
  text.insert(text.rfind("*END"), cards);
  std::ofstream(deck) << text;
}

}  // namespace

std::unique_ptr<Simulation> build_scene(const std::string& path, const Parameters& parameters,
                                        const std::string& cards) {
  const auto deck =
      std::filesystem::temp_directory_path() / ("courant_benchmark_" + std::to_string(::getpid()) + ".k");
  Diagnostics diagnostics;
  std::unique_ptr<Simulation> s;
  const bool made =
      test::generate_deck(std::string(SOURCE_DIR) + "/" + path, deck.string(), parameters, diagnostics);
  if (made && !cards.empty()) add_cards(deck, cards);
  if (made) s = Simulation::build(deck.string(), {}, diagnostics);
  std::filesystem::remove(deck);
  if (!s) throw std::runtime_error(path + ": " + diagnostics.text());
  return s;
}

void take_steps(Simulation& s, std::int64_t steps) {
  for (std::int64_t k = 0; k < steps; ++k) s.step(nothing);
}

void run_until(Simulation& s, Real t, std::int64_t most_steps) {
  for (std::int64_t k = 0; k < most_steps && s.clock().t < t; ++k) s.step(nothing);
}

void start_from(Simulation& to, Simulation& from, Real c0_to, Real c0_from, Real rho0) {
  const Particles& a = from.world().particles;
  Particles& b = to.world().particles;
  std::unordered_map<Id, Index> index;
  for (Index i = 0; i < a.size(); ++i) index.emplace(a.id[i], i);
  const Real ratio = c0_from / c0_to;
  for (Index k = 0; k < b.size(); ++k) {
    const Index i = index.at(b.id[k]);
    const Real waited = i < a.moving ? 0 : from.clock().t - a.dormant_time;
    b.x.set(k, a.x.vec(i) + a.v.vec(i) * waited);
    b.v.set(k, a.v.vec(i));
    b.p[k] = a.p[i];
    b.rho[k] = rho0 * (1 + (a.rho[i] / rho0 - 1) * ratio * ratio);
  }
}

void use_threads(Simulation& s, int threads) {
  set_threads(threads);
  s.neighbours().share_blocks(s.world());
}

}  // namespace courant::benchmarks
