// How fast decks are read, against plain reading of the lines of the same file.
//   read_deck_benchmark [NODES [ROUNDS]]
// Writes decks of NODES nodes and as many elements into the folder for temporary files, measures and deletes
// them, and prints a table for docs/performance.md. One core; the file is in memory, since it was just
// written. Each measurement runs in a process of its own, so that each has a peak of memory of its own.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "keyword/deck.hpp"
#include "keyword/source.hpp"
#include "model/cards.hpp"

namespace {

using namespace courant;

struct Form {
  const char* name;
  const char* first;  ///< line of the deck
  const char *node, *sph, *shell;
};

// coordinates with all digits, as programs that make meshes write them
constexpr Form standard{"standard", "*KEYWORD\n", "%8ld%16.9g%16.9g%16.9g\n", "%8ld%8d%16.9g\n",
                        "%8ld%8d%8ld%8ld%8ld%8ld\n"};
constexpr Form long_fields{"LONG=Y", "*KEYWORD LONG=Y\n", "%20ld%20.13g%20.13g%20.13g\n",
                           "%20ld%20d%20.13g\n", "%20ld%20d%20ld%20ld%20ld%20ld\n"};
constexpr Form commas{"commas", "*KEYWORD\n", "%ld,%.9g,%.9g,%.9g\n", "%ld,%d,%.9g\n",
                      "%ld,%d,%ld,%ld,%ld,%ld\n"};

void write_deck(const std::string& path, const Form& form, long nodes, bool shells) {
  std::FILE* file = std::fopen(path.c_str(), "w");
  if (!file) {
    std::fprintf(stderr, "cannot write %s\n", path.c_str());
    std::exit(1);
  }
  std::fputs(form.first, file);
  std::fputs("*NODE\n", file);
  for (long n = 1; n <= nodes; ++n) {
    const auto x = static_cast<double>(n);
    std::fprintf(file, form.node, n, 0.01 * x + 1e-5 / x, -0.5 + 1 / (x + 7), 1e-3 * x);
  }
  std::fputs(shells ? "*ELEMENT_SHELL\n" : "*ELEMENT_SPH\n", file);
  for (long n = 1; n <= nodes; ++n) {
    const auto node = [&](long k) { return (n + k) % nodes + 1; };
    if (shells)
      std::fprintf(file, form.shell, n, 1, node(0), node(1), node(2), node(3));
    else
      std::fprintf(file, form.sph, n, 1, 1.25e-3 + 1e-12 * static_cast<double>(n));
  }
  std::fputs("*END\n", file);
  std::fclose(file);
}

struct Cost {
  double seconds = 0;  ///< of processor time: other programs may run beside
  double peak = 0;     ///< bytes
};

/// Runs `body` in a process of its own; false from it ends the program.
Cost measure(const std::function<bool()>& body) {
  int ends[2];
  if (pipe(ends) != 0) std::exit(1);
  const pid_t child = fork();
  if (child == 0) {
    const std::clock_t begin = std::clock();
    const bool good = body();
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    const bool told = write(ends[1], &seconds, sizeof seconds) == sizeof seconds;
    _exit(good && told ? 0 : 1);
  }
  close(ends[1]);  // else a child that crashed would be waited for without end
  Cost out;
  const bool heard = read(ends[0], &out.seconds, sizeof out.seconds) == sizeof out.seconds;
  close(ends[0]);
  int status = 0;
  rusage used{};
  if (wait4(child, &status, 0, &used) != child || !heard || status != 0) {
    std::fprintf(stderr, "a measurement failed\n");
    std::exit(1);
  }
  out.peak = 1024.0 * static_cast<double>(used.ru_maxrss);
  return out;
}

Cost quickest(int rounds, const std::function<bool()>& body) {
  Cost best = measure(body);
  for (int k = 1; k < rounds; ++k) {
    const Cost next = measure(body);
    if (next.seconds < best.seconds) best = next;
  }
  return best;
}

bool plain_lines(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::size_t lines = 0;
  while (std::getline(file, line)) ++lines;
  return lines > 0;
}

bool whole_deck(const std::string& path, std::size_t nodes) {
  Diagnostics diagnostics;
  const Deck deck = read_deck(path, {}, diagnostics);
  const std::size_t elements = deck.all<ElementSphCard>().size() + deck.all<ElementShellCard>().size();
  return diagnostics.text().empty() && deck.all<NodeCard>().size() == nodes && elements == nodes;
}

void report(const std::string& folder, const Form& form, bool shells, long nodes, int rounds) {
  const std::string path = folder + "/read_deck_" + std::to_string(getpid()) + ".k";
  write_deck(path, form, nodes, shells);
  const double mega = 1e-6 * static_cast<double>(std::filesystem::file_size(path));
  const Cost lines = quickest(rounds, [&] { return plain_lines(path); });
  const Cost source = quickest(rounds, [&] { return load_source(path) != nullptr; });
  const Cost whole = quickest(rounds, [&] { return whole_deck(path, static_cast<std::size_t>(nodes)); });
  std::filesystem::remove(path);
  std::printf("| %s | %s | %.0f | %.3f | %.3f | %.3f | %.0f | %.2f | %.0f |\n", form.name,
              shells ? "shells" : "particles", mega, lines.seconds, source.seconds, whole.seconds,
              mega / whole.seconds, whole.seconds / lines.seconds, 1e-6 * whole.peak);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const long nodes = argc > 1 ? std::atol(argv[1]) : 1000000;
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 5;
  if (nodes < 4 || rounds < 1) {
    std::fprintf(stderr, "usage: read_deck_benchmark [NODES [ROUNDS]]\n");
    return 2;
  }
  const std::string folder = std::filesystem::temp_directory_path().string();
  std::printf(
      "| format | elements | MB | getline, s | lines alone, s | read_deck, s | MB/s | of getline | peak, MB "
      "|\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  for (const Form& form : {standard, long_fields, commas})
    for (const bool shells : {false, true}) report(folder, form, shells, nodes, rounds);
  return 0;
}
