#include <cstdio>
#include <exception>

#include "app/cli.hpp"
#include "parallel/parallel.hpp"

int main(int argc, char** argv) {
  courant::let_waiting_threads_sleep(argv);
  try {
    return courant::command_line(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "courant: %s\n", error.what());
    return 3;
  }
}
