#include "parallel/thread_limit.hpp"

#include <fmt/format.h>
#include <omp.h>
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>

namespace courant {

std::string why_not_threads(int threads) {
  constexpr int most = 1024;
  const int n = threads > 0 ? threads : omp_get_num_procs();
  if (n > most)
    return fmt::format("--threads {}: no more than {} can be had\n  hint: one per core is quickest", n, most);
  rlimit addresses{}, stack{};
  if (::getrlimit(RLIMIT_AS, &addresses) != 0 || addresses.rlim_cur == RLIM_INFINITY) return "";
  constexpr double usual_stack = 8e6, mega = 1e6;
  const bool known = ::getrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur != RLIM_INFINITY;
  double pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const double used = pages * static_cast<double>(::sysconf(_SC_PAGESIZE)),
               wanted = used + n * (known ? static_cast<double>(stack.rlim_cur) : usual_stack),
               limit = static_cast<double>(addresses.rlim_cur);
  if (wanted < limit) return "";
  return fmt::format(
      "{} threads take {:.0f} MB of addresses for their stacks, with what the program has, and the limit "
      "(ulimit -v) is {:.0f} MB\n"
      "  hint: give fewer --threads, or a higher limit",
      n, wanted / mega, limit / mega);
}

}  // namespace courant
