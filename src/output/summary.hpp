#pragma once
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "output/file.hpp"
#include "state/ranges.hpp"
#include "state/world.hpp"

namespace courant {

/// Limits beyond which a run is not sound. Fractions: of energies, of particles, of the sound speed, of RO.
struct VerdictLimits {
  Real residual_doubtful = 0.01, residual_broken = 0.1;  ///< of EnergyLedger::scale
  Real leaks_doubtful = 0, leaks_broken = 0.001;         ///< of the particles of the model
  Real hourglass_doubtful = 0.1, hourglass_broken = std::numeric_limits<Real>::infinity();  ///< of internal
  Real mach_doubtful = 0.2, density_doubtful = 0.1;                                         ///< of liquids
  bool given = false;  ///< by the deck: then the summary lists them
};

/// Results of a run, for scripts: the content of summary.yaml.
struct Summary {
  struct PassTime {
    std::string name;
    double seconds = 0;  ///< wall time in this pass over the run
    std::int64_t calls = 0;
  };
  std::string title;                         ///< of the deck
  std::string deck;                          ///< path of the deck
  std::string mass, length, time_unit;       ///< probable units of the deck; empty: unknown
  std::string termination;                   ///< "normal", "error", "interrupted", ...
  std::string reason;                        ///< in words
  std::string advice;                        ///< what to change, where the run stopped in error; may be empty
  std::string verdict;                       ///< "sound", "doubtful", "broken"; empty: not judged yet
  std::vector<std::string> verdict_reasons;  ///< reasons of the verdict
  VerdictLimits limits;
  Real time = 0;  ///< time reached [T]
  std::int64_t steps = 0;
  int restarts = 0;  ///< number of restarts
  /// Changes at those restarts, by which results may differ from those of a run without restarts.
  std::vector<std::string> restart_notes;
  std::vector<std::string> notes;  ///< information for readers of the results, not faults
  std::string restart_file;        ///< the latest complete one; empty: none
  double wall_seconds = 0, cpu_seconds = 0;
  double read_seconds = 0;            ///< wall time for deck and set-up, before the run
  double writer_cpu_seconds = 0;      ///< part of cpu_seconds: writing results, beside the computation
  int threads = 0;                    ///< at the end
  std::int64_t particles = 0;         ///< in the model
  std::int64_t active_particles = 0;  ///< at the end
  std::int64_t particle_steps = 0;    ///< sum over steps of active particles
  std::int64_t elements = 0;          ///< solids
  std::int64_t element_steps = 0;     ///< sum over steps of elements
  std::int64_t peak_memory_bytes = 0;
  Real dt_min = 0, dt_max = 0;  ///< [T]
  EnergyLedger energy;          ///< at the end
  std::int64_t leaked_particles = 0;
  Real max_penetration = 0;  ///< [L]
  Counters counters;
  std::map<std::string, Real> maxima;
  Ranges ranges;  ///< of speeds and densities, found by the checks of the guard
  std::vector<std::string> warnings;
  std::vector<PassTime> passes;  ///< of deck, set-up and run: they add up to read_seconds + wall_seconds
  struct Output {
    double seconds = 0;            ///< wall time that the computation spent on it
    std::int64_t states = 0;       ///< of the field files
    std::int64_t field_bytes = 0;  ///< in all field files
    std::int64_t history_bytes = 0;
  };
  Output output;

  /// CPU time, and elapsed time, which includes delays by other programs; 0 if no step was taken.
  double ns_per_particle_step() const;
  double elapsed_ns_per_particle_step() const;
  double ns_per_element_step() const;
  double elapsed_ns_per_element_step() const;
  /// Total over initial energy plus external work; where that is almost 0 (a fall from the origin of
  /// potential energy), 1 plus the error of the balance.
  Real energy_ratio() const;
};

/// Writes the summary as YAML, completely or not at all. Throws OutputError.
void write_summary(const std::filesystem::path& file, const Summary& summary);

}  // namespace courant
