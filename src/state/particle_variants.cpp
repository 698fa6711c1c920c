#include "base/instruction_set.hpp"
#include "state/particle_loops.hpp"

namespace courant {

COURANT_DECLARE_VARIANTS(particle_loops)

ParticleLoops particle_loops() {
  return COURANT_VARIANT(particle_loops)();
}

}  // namespace courant
