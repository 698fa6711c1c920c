#include "parallel/parallel.hpp"

#include <omp.h>

namespace courant {

namespace {
int wanted_threads = 0;
}

void set_threads(int threads) {
  wanted_threads = threads > 0 ? threads : omp_get_num_procs();
  omp_set_num_threads(wanted_threads);
}

int threads() { return wanted_threads > 0 ? wanted_threads : omp_get_max_threads(); }

}  // namespace courant
