#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>

#include "app/cli.hpp"
#include "app/run/resources.hpp"
#include "parallel/start_over.hpp"

namespace {

/// Without asking for memory, which there is none of.
void tell_of_memory() {
  rusage usage{};
  rlimit limit{};
  ::getrusage(RUSAGE_SELF, &usage);
  ::getrlimit(RLIMIT_AS, &limit);
  char text[600], bound[100] = "";
  constexpr double mega = 1e6, kilo = 1e3;
  if (limit.rlim_cur != RLIM_INFINITY)
    std::snprintf(bound, sizeof bound, ", and its limit (ulimit -v) is %.0f MB of addresses",
                  static_cast<double>(limit.rlim_cur) / mega);
  std::snprintf(
      text, sizeof text,
      "error: memory is exhausted: the process has used %.0f MB%s\n"
      "  hint: use fewer --threads, a higher limit, a machine with more memory, or a smaller scene\n",
      static_cast<double>(usage.ru_maxrss) * kilo / mega, bound);
  if (::write(STDERR_FILENO, text, std::strlen(text)) < 0) return;
}

/// An exception that leaves a loop over threads cannot be caught.
[[noreturn]] void end() {
  try {
    if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    tell_of_memory();
    std::_Exit(courant::exit_other);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "courant: %s\n", error.what());
  }
  std::abort();
}

}  // namespace

int main(int argc, char** argv) {
  courant::start_over_for_speed(argv);
  std::set_terminate(end);
  // each thread would set addresses apart for its own memory, more than a limit may have
  if (courant::memory_is_limited()) ::mallopt(M_ARENA_MAX, 1);
  try {
    const int code = courant::command_line(argc, argv);
    // libraries that have run out of memory, as HDF5, may crash when they clean up
    if (code != courant::exit_ok && std::fflush(nullptr) == 0) std::_Exit(code);
    return code;
  } catch (const std::bad_alloc&) {
    tell_of_memory();
    std::fflush(nullptr);
    std::_Exit(courant::exit_other);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "courant: %s\n", error.what());
    return courant::exit_other;
  }
}
