#include <cstdio>
#include <exception>

#include "app/cli.hpp"
#include "parallel/start_over.hpp"

int main(int argc, char** argv) {
  courant::start_over_for_speed(argv);
  try {
    return courant::command_line(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "courant: %s\n", error.what());
    return 3;
  }
}
