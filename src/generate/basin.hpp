#pragma once
// Water in a box with all cards that it needs, so that a scene need not write them: what most free-surface
// flows begin with. Defaults are those with which still water neither leaks nor moves.
#include <set>
#include <string>
#include <vector>

#include "generate/scene.hpp"

namespace courant {

struct Basin {
  int dim = 2;               ///< 2: y is up, 3: z is up
  ScenePart water;           ///< lattices and velocity; the rest is filled in
  Real spacing = 0;          ///< of the particles [L]
  Real density = 1000;       ///< [M/L3]
  Real sound_speed = 0;      ///< 0: by complete() [L/T]
  Real viscosity = 0.1;      ///< linear coefficient of the artificial viscosity [-]
  bool tension = true;       ///< the water may pull
  Real gravity = 9.81;       ///< downwards [L/T2]
  Real end = 0, output = 0;  ///< end time, interval of field states [T]
  bool has_box = false;
  Vec low = Vec::Zero(), high = Vec::Zero();  ///< corners of the box [L]
  std::set<std::string> open;                 ///< sides without a wall

  /// Names of the sides: left and right along x, bottom and top, in 3D front and back along y.
  std::vector<std::string> sides() const;
  /// Fills in the sound speed, twenty times the speed that the water gets; what is wrong, or nothing.
  std::string complete();
};

/// Adds the parts 1 (water) and 11 (walls) and the keywords to the scene. `basin` must be complete.
void add_basin(const Basin& basin, Scene& scene);

}  // namespace courant
