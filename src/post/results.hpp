#pragma once
// Reads the field files of a run.
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "base/real.hpp"

namespace courant {

/// One state of a run, as fields.pvd lists it.
struct StateFiles {
  Real t = 0;  ///< [T]
  std::filesystem::path particles;
  std::filesystem::path shells;  ///< empty: none
};

struct ParticleFrame {
  Real t = 0;
  int dim = 2;                ///< 2 where all particles have the same z
  std::vector<Real> x, y, z;  ///< [L]
  std::vector<Real> V;        ///< m/rho [L3], in 2D per unit depth [L2]
  std::vector<Real> h;        ///< smoothing length [L]
  std::vector<Real> speed;    ///< |v|, only if asked for [L/T]
  /// Further arrays by name, only if asked for; shape: (size(), components)
  std::map<std::string, std::vector<Real>> arrays;
  std::size_t size() const { return x.size(); }
};

/// A wall's trace in the plane z = constant: x0, y0, x1, y1. [L]
using WallLine = std::array<Real, 4>;

/// The states in DIR/fields.pvd in order of time. Faults are reported; then the list is empty.
std::vector<StateFiles> read_states(const std::filesystem::path& dir, Diagnostics& diagnostics);
/// An array of a field file by its name there.
struct ParticleArray {
  std::string name;
  int components = 1;
  bool optional = false;  ///< no fault if the file lacks it
};
/// Particles of one state; with_speed: read velocities too. Faults are reported; then there is no value.
std::optional<ParticleFrame> read_particles(const StateFiles& state, bool with_speed,
                                            const std::vector<ParticleArray>& arrays,
                                            Diagnostics& diagnostics);
inline std::optional<ParticleFrame> read_particles(const StateFiles& state, bool with_speed,
                                                   Diagnostics& diagnostics) {
  return read_particles(state, with_speed, {}, diagnostics);
}
/// Traces of the shells of one state, one line per shell. Faults are reported; then the list is empty.
std::vector<WallLine> read_walls(const StateFiles& state, Diagnostics& diagnostics);

}  // namespace courant
