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

/// Beyond what a run is no longer sound. Shares: of energies, of particles, of the sound speed, of RO.
struct VerdictLimits {
  Real residual_doubtful = 0.01, residual_broken = 0.1;  ///< of EnergyLedger::scale
  Real leaks_doubtful = 0, leaks_broken = 0.001;         ///< of the particles of the model
  Real hourglass_doubtful = 0.1, hourglass_broken = std::numeric_limits<Real>::infinity();  ///< of internal
  Real mach_doubtful = 0.2, density_doubtful = 0.1;                                         ///< of liquids
  bool given = false;  ///< by the deck: then the summary tells them
};

/// What a run came to, for scripts: the content of summary.yaml.
struct Summary {
  struct PassTime {
    std::string name;
    double seconds = 0;  ///< wall time in this pass over the run
    std::int64_t calls = 0;
  };
  std::string title;                    ///< of the deck
  std::string deck;                     ///< path of the deck
  std::string mass, length, time_unit;  ///< units that the numbers of the deck look like; empty: no guess
  std::string termination;              ///< "normal", "error", "interrupted", ...
  std::string reason;                   ///< in words
  std::string advice;                   ///< what to change, where the run stopped in error; may be empty
  std::string verdict;                  ///< "sound", "doubtful", "broken"; empty: not judged yet
  std::vector<std::string> verdict_reasons;  ///< what speaks against it
  VerdictLimits limits;
  Real time = 0;  ///< time reached [T]
  std::int64_t steps = 0;
  int restarts = 0;  ///< parts that the run was made in, but one
  /// What changed at those restarts, so that results may differ from those of a run in one part.
  std::vector<std::string> restart_notes;
  std::vector<std::string> notes;  ///< what a reader of the results should know, and is no fault
  std::string restart_file;        ///< the latest whole one that was written; empty: none
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
  Ranges ranges;  ///< of speeds and densities, seen at the looks of the guard
  std::vector<std::string> warnings;
  std::vector<PassTime> passes;  ///< of deck, set-up and run: they add up to read_seconds + wall_seconds
  struct Output {
    double seconds = 0;            ///< wall time that the computation spent on it
    std::int64_t states = 0;       ///< of the field files
    std::int64_t field_bytes = 0;  ///< in all field files
    std::int64_t history_bytes = 0;
  };
  Output output;

  /// CPU time, and time elapsed, which others that use the machine make longer; 0 if no step was taken.
  double ns_per_particle_step() const;
  double elapsed_ns_per_particle_step() const;
  double ns_per_element_step() const;
  double elapsed_ns_per_element_step() const;
  /// Total over initial energy plus external work; where that is next to nothing (a fall from the height that
  /// potential energy counts from), 1 plus the error of the balance.
  Real energy_ratio() const;
};

/// Writes the summary as YAML, whole or not at all. Throws OutputError.
void write_summary(const std::filesystem::path& file, const Summary& summary);

}  // namespace courant
