// The fuzzer's entry point without libFuzzer, for every compiler: reads decks as they are, then decks with
// seeded changes.
//   fuzz_replay [--seconds S] [--changes N] [--seed K] [--keep FILE] [--limit S] FILE_OR_FOLDER...
// Ends with 1 where an input of 64 kB takes more than --limit seconds (1) of processor time. --keep writes
// each input to a file before it is read, so that one that ends the program can be had.
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "mutate.hpp"
#include "read_and_build.hpp"

namespace {

namespace fs = std::filesystem;

struct Options {
  double seconds = 5, limit = 1;
  long changes = 1000000;
  std::uint64_t seed = 1;
  std::string keep;
  std::vector<std::string> paths;
};

Options parse(int argc, char** argv) {
  Options out;
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    const bool more = k + 1 < argc;
    if (word == "--seconds" && more)
      out.seconds = std::atof(argv[++k]);
    else if (word == "--limit" && more)
      out.limit = std::atof(argv[++k]);
    else if (word == "--changes" && more)
      out.changes = std::atol(argv[++k]);
    else if (word == "--seed" && more)
      out.seed = std::strtoull(argv[++k], nullptr, 10);
    else if (word == "--keep" && more)
      out.keep = argv[++k];
    else
      out.paths.push_back(word);
  }
  return out;
}

std::vector<std::string> inputs_of(const std::vector<std::string>& paths) {
  std::vector<fs::path> files;
  for (const std::string& path : paths) {
    if (!fs::is_directory(path)) files.emplace_back(path);
    if (fs::is_directory(path))
      for (const auto& entry : fs::directory_iterator(path))
        if (entry.is_regular_file() && entry.path().extension() != ".txt") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<std::string> inputs;
  for (const fs::path& file : files) {
    std::ifstream in(file, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    if (text.str().size() <= courant::fuzz::largest_input) inputs.push_back(text.str());
  }
  return inputs;
}

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = parse(argc, argv);
  const std::vector<std::string> inputs = inputs_of(options.paths);
  if (inputs.empty()) {
    std::fprintf(stderr, "fuzz_replay: no inputs\n");
    return 2;
  }
  double slowest = 0;
  const auto read = [&](const std::string& input) {
    if (!options.keep.empty()) std::ofstream(options.keep, std::ios::binary) << input;
    const double before = processor_seconds();
    courant::fuzz::read_and_build(input);
    const double taken = processor_seconds() - before;
    if (taken > slowest && !options.keep.empty())
      std::ofstream(options.keep + ".slowest", std::ios::binary) << input;
    slowest = std::max(slowest, taken);
  };
  for (const std::string& input : inputs) read(input);
  courant::fuzz::Mutator mutator(options.seed);
  std::mt19937_64 choose(options.seed);
  std::vector<std::string> changed = inputs;  // changes of changes go further from where they began
  const double begin = processor_seconds();
  long count = 0;
  for (; count < options.changes && processor_seconds() - begin < options.seconds; ++count) {
    const std::size_t k = choose() % changed.size();
    mutator.change(changed[k], inputs[choose() % inputs.size()], courant::fuzz::largest_input);
    read(changed[k]);
    if (choose() % 16 == 0) changed[k] = inputs[k];
  }
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  std::printf("%zu files, %ld changed ones; slowest %.3f s, at most %ld MB\n", inputs.size(), count, slowest,
              used.ru_maxrss / 1024);
  return slowest > options.limit ? 1 : 0;
}
