#include "base/instruction_set.hpp"
#include "state/particle_loops.hpp"

namespace courant {

namespace baseline {
ParticleLoops particle_loops();
}
namespace avx2 {
ParticleLoops particle_loops();
}
namespace avx512 {
ParticleLoops particle_loops();
}

ParticleLoops particle_loops() {
  return COURANT_VARIANT(particle_loops)();
}

}  // namespace courant
