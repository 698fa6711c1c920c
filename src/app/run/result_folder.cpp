#include "app/run/result_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "app/run/relaxation.hpp"
#include "extension/additions.hpp"
#include "output/file.hpp"
#include "output/result_names.hpp"

namespace courant {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> entries(const fs::path& dir) {
  std::vector<fs::path> out;
  std::error_code error;
  for (fs::directory_iterator it(dir, error), end; !error && it != end; it.increment(error))
    out.push_back(it->path());
  std::sort(out.begin(), out.end());
  return out;
}

void check_file(const fs::path& file, const std::vector<fs::path>& inputs) {
  if (const std::string why = why_no_file(file); !why.empty()) throw OutputError(file, why);
  std::error_code error;
  for (const fs::path& input : inputs)
    if (fs::equivalent(file, input, error))
      throw OutputError(file, fmt::format("it is the input '{}' of this run", input.string()));
}

/// Whether the relaxation of a run wrote it.
bool is_relaxation(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  return std::getline(stream, line) && line.rfind("#         time       kinetic         ratio", 0) == 0;
}

/// Whether a run wrote it for a gauge.
bool is_gauge_file(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  return std::getline(stream, line) && line.starts_with("time,");
}

}  // namespace

bool is_result_name(const fs::path& name_in_folder) {
  const std::string name = without_tmp(name_in_folder.string());
  return is_listed_result(name_in_folder) ||
         std::any_of(ascii_histories().begin(), ascii_histories().end(),
                     [&](const AsciiHistory& added) { return name == added.name; });
}

void check_result_folder(const fs::path& dir, const std::vector<fs::path>& inputs) {
  std::error_code error;
  for (const fs::path& file : entries(dir))
    if (is_result_name(file.filename())) check_file(file, inputs);
  for (const char* folder : result_names::folders) {
    const fs::path path = dir / folder;
    if (fs::is_symlink(fs::symlink_status(path, error))) throw OutputError(path, why_no_file(path));
    for (const fs::path& file : entries(path))
      if (is_result_name(folder / file.filename())) check_file(file, inputs);
  }
}

void remove_results(const fs::path& dir) {
  std::error_code ignored;  // a file that cannot be removed cannot be replaced either: that is reported then
  for (const fs::path& file : entries(dir / "fields"))
    if (is_result_name("fields" / file.filename())) fs::remove(file, ignored);
  for (const fs::path& file : entries(dir / result_names::gauges))
    if (is_result_name(fs::path(result_names::gauges) / file.filename()) && is_gauge_file(file))
      fs::remove(file, ignored);
  for (const char* name : result_names::whole) {
    const std::string one = name;
    if (one == result_names::lock || (one == result_names::relaxation && !is_relaxation(dir / one))) continue;
    fs::remove(dir / one, ignored);
  }
}

}  // namespace courant
