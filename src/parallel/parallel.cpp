#include "parallel/parallel.hpp"

#include <omp.h>
#include <unistd.h>

#include <cstdlib>

namespace courant {

namespace {
int wanted_threads = 0;
}

void set_threads(int threads) {
  wanted_threads = threads > 0 ? threads : omp_get_num_procs();
  omp_set_num_threads(wanted_threads);
}

void let_waiting_threads_sleep(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") || std::getenv("GOMP_SPINCOUNT")) return;
  setenv("GOMP_SPINCOUNT", "1000", 1);  // some microseconds; see docs/performance.md
  execv("/proc/self/exe", argv);  // returns only if it failed: then threads spin, which is slower but right
}

int threads() {
  return wanted_threads > 0 ? wanted_threads : omp_get_max_threads();
}

}  // namespace courant
