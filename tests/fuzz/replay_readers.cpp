// Reads files of every kind that the C++ program reads beside decks, restart files, as they are and with
// seeded changes.
//   fuzz_readers [--seconds S] [--seed K] [--only NAME] [--limit S] [--sign] RUN...
// Each RUN is the folder of a run with restart files. Each kind gets S seconds (2). Ends with 1 where reading
// throws what it does not announce, takes more than --limit seconds (1) of processor time, or more than 1 GB
// beyond what it had; where it crashes, the input remains in a folder that is reported at the start.
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "../sanitized.hpp"
#include "mutate.hpp"
#include "output/restart_file.hpp"

// What no input of this size may ask for at once; without a sanitizer nobody calls it.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() {
  return "max_allocation_size_mb=1024:allocator_may_return_null=1:detect_leaks=0";
}

namespace {

namespace fs = std::filesystem;
using namespace courant;

constexpr std::size_t largest_input = 256 * 1024;
constexpr long most_growth = 1024;  // MB

struct Options {
  double seconds = 2, limit = 1;
  std::uint64_t seed = 1;
  std::string only;
  bool sign = false;
  std::vector<fs::path> folders;
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
    else if (word == "--seed" && more)
      out.seed = std::strtoull(argv[++k], nullptr, 10);
    else if (word == "--only" && more)
      out.only = argv[++k];
    else if (word == "--sign")
      out.sign = true;
    else
      out.folders.emplace_back(word);
  }
  return out;
}

std::string content(const fs::path& file) {
  std::stringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// A kind of files.
struct Kind {
  std::string name;
  fs::path file;  ///< where inputs are written
  bool binary = false;
  std::function<void(const fs::path&)> read;
  std::vector<std::string> seeds;
  /// With --sign half of the inputs get a checksum that fits in the last line, to see what lies behind it:
  /// HDF5 1.10 itself, which is not safe from crafted files.
  bool signed_by_crc = false;
};

/// Files of a folder, or a file, that end so.
void add_seeds(Kind& kind, const fs::path& path, const std::string& ending) {
  std::vector<fs::path> files;
  if (fs::is_regular_file(path)) files.push_back(path);
  if (fs::is_directory(path))
    for (const auto& entry : fs::directory_iterator(path))
      if (entry.is_regular_file() && entry.path().string().ends_with(ending)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files)
    if (fs::file_size(file) > 0 && fs::file_size(file) <= largest_input) kind.seeds.push_back(content(file));
}

void read_restart(const fs::path& file) {
  try {
    read_restart_file(file);
  } catch (const RestartError&) {  // what it announces
  }
}

std::vector<Kind> kinds_of(const std::vector<fs::path>& runs, const fs::path& work) {
  std::vector<Kind> kinds;
  const auto kind = [&](const char* name, const fs::path& file, bool binary, auto read) -> Kind& {
    return kinds.emplace_back(Kind{name, work / file, binary, read, {}});
  };
  const auto of_runs = [&](Kind& to, const char* path, const char* ending) {
    for (const fs::path& run : runs) add_seeds(to, run / path, ending);
  };
  Kind& restart = kind("restart", "restart.h5", true, read_restart);
  restart.signed_by_crc = true;
  of_runs(restart, "restart", ".h5");
  return kinds;
}

/// The last nine bytes are the checksum of those before.
void sign(std::string& bytes) {
  constexpr std::size_t width = 9;
  if (bytes.size() < width) return;
  const auto crc =
      crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size() - width));
  bytes.replace(bytes.size() - width, width, fmt::format("{:08x}\n", crc));
}

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

long megabytes() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return used.ru_maxrss / 1024;
}

const std::vector<std::string> yaml_pieces = {
    "[",         "]",       "{",     "}",     "- ",     ": ",    ":\n",  ",",        "&a ", "*a",
    "!!binary ", "!!map ",  "|\n",   ">\n",   "~",      "null",  "true", "no",       "'",   "\"",
    "#",         "\n",      "\n\n",  "\t",    "  ",     "? ",    "%",    "<<: *a\n", "---", "...",
    "x",         "y",       "t",     "pi",    "+",      "*",     "/",    "^",        "(",   ")",
    "sqrt(",     "max(0, ", "-",     "1e9",   "\r\n",   "\xFF",  "\xC3", "${",       "}",   ":10}",
    ".inf",      ".nan",    "[[[[",  "{{{{",  "-(-(-(", "1/0",   "%",    ";",        "..",  "/",
    "0x1F",      "1:2",     "*****", "1-100", "=",      "<VTK>", "<?xml"};

/// Lines that seeds have, to put where they do not belong.
std::vector<std::string> lines_of(const std::vector<std::string>& seeds) {
  std::set<std::string> lines;
  for (const std::string& seed : seeds) {
    std::stringstream text(seed);
    for (std::string line; std::getline(text, line);) lines.insert("\n" + line + "\n");
  }
  if (lines.empty()) lines.insert("\n");
  return {lines.begin(), lines.end()};
}

/// The number of faults.
int replay(Kind& kind, const Options& options) {
  double slowest = 0;
  int faults = 0;
  const auto read = [&](const std::string& input) {
    std::ofstream(kind.file, std::ios::binary) << input;
    const double before = processor_seconds();
    const long memory = megabytes();
    std::string fault;
    try {
      kind.read(kind.file);
    } catch (const std::exception& e) {
      fault = fmt::format("throws {}", e.what());
    }
    const double taken = processor_seconds() - before;
    slowest = std::max(slowest, taken);
    if (taken > options.limit) fault = fmt::format("takes {:.1f} s", taken);
    if (megabytes() - memory > most_growth) fault = fmt::format("takes {} MB", megabytes() - memory);
    if (fault.empty()) return;
    const fs::path kept = kind.file.string() + fmt::format(".fault{}", ++faults);
    fs::copy_file(kind.file, kept, fs::copy_options::overwrite_existing);
    std::printf("%s: %s: %s\n", kind.name.c_str(), fault.c_str(), kept.c_str());
  };
  for (const std::string& seed : kind.seeds) read(seed);
  std::mt19937_64 choose(options.seed);
  const std::vector<std::string> lines = lines_of(kind.seeds);
  fuzz::Mutator mutator(options.seed, yaml_pieces, lines);
  std::vector<std::string> changed = kind.seeds;
  const double begin = processor_seconds();
  long count = 0;
  for (; processor_seconds() - begin < options.seconds && faults < 5; ++count) {
    const std::size_t k = choose() % changed.size();
    const std::string& other = kind.seeds[choose() % kind.seeds.size()];
    if (kind.binary)
      fuzz::change_binary(changed[k], other, largest_input, choose);
    else
      mutator.change(changed[k], other, largest_input);
    if (options.sign && kind.signed_by_crc && choose() % 2 == 0) sign(changed[k]);
    read(changed[k]);
    if (choose() % (kind.binary ? 2 : 16) == 0) changed[k] = kind.seeds[k];
  }
  std::printf("%-9s %3zu files, %6ld changed ones; slowest %.3f s\n", kind.name.c_str(), kind.seeds.size(),
              count, slowest);
  std::fflush(stdout);
  return faults;
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = parse(argc, argv);
  if (options.folders.empty()) {
    std::fprintf(stderr, "fuzz_readers: the folders of runs are missing\n");
    return 2;
  }
  if (!test::address_sanitizer) {
    const rlimit most{std::size_t(4) << 30u, std::size_t(4) << 30u};
    setrlimit(RLIMIT_AS, &most);
  }
  const fs::path work = fs::temp_directory_path() / fmt::format("courant_fuzz_{}", getpid());
  fs::create_directories(work);
  std::printf("inputs in %s\n", work.c_str());
  std::fflush(stdout);
  int faults = 0;
  for (Kind& kind : kinds_of(options.folders, work)) {
    if (!options.only.empty() && kind.name != options.only) continue;
    if (kind.seeds.empty()) {
      std::fprintf(stderr, "fuzz_readers: no file of the kind %s\n", kind.name.c_str());
      ++faults;
      continue;
    }
    faults += replay(kind, options);
  }
  std::error_code ignored;
  if (faults == 0) fs::remove_all(work, ignored);
  return faults > 0 ? 1 : 0;
}
