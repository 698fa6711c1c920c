#include "app/result_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "extension/additions.hpp"
#include "output/file.hpp"

namespace courant {
namespace {

namespace fs = std::filesystem;

constexpr const char* ascii_names[] = {"glstat", "matsum", "rcforc",  "sphout", "sleout",
                                       "nodout", "rbdout", "spcforc", "bndout", "rwforc"};
constexpr const char* own_names[] = {"messag", "summary.yaml", "history.h5", "fields.pvd", ".courant_lock"};
constexpr const char* folders[] = {"fields", "restart", "restart_old"};

bool is_number(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// particles_0012.vtp, solids_0012.vtu, failed.vtp, ...
bool is_field_name(const std::string& name) {
  for (const char* failed : {"failed.vtp", "failed_shells.vtu", "failed_solids.vtu"})
    if (name == failed) return true;
  for (const auto& [begin, end] :
       {std::pair{"particles_", ".vtp"}, {"shells_", ".vtu"}, {"solids_", ".vtu"}}) {
    const std::string first = begin, last = end;
    if (name.size() > first.size() + last.size() && name.starts_with(first) && name.ends_with(last) &&
        is_number(name.substr(first.size(), name.size() - first.size() - last.size())))
      return true;
  }
  return false;
}

bool is_top_name(const std::string& name) {
  const auto is_name = [&](const char* one) { return name == one; };
  if (std::any_of(std::begin(ascii_names), std::end(ascii_names), is_name)) return true;
  if (std::any_of(std::begin(own_names), std::end(own_names), is_name)) return true;
  return std::any_of(ascii_histories().begin(), ascii_histories().end(),
                     [&](const AsciiHistory& added) { return name == added.name; });
}

std::string without_tmp(const std::string& name) {
  constexpr std::string_view tmp = ".tmp";
  return name.ends_with(tmp) ? name.substr(0, name.size() - tmp.size()) : name;
}

std::vector<fs::path> entries(const fs::path& dir) {
  std::vector<fs::path> out;
  std::error_code error;
  for (fs::directory_iterator it(dir, error), end; !error && it != end; it.increment(error))
    out.push_back(it->path());
  std::sort(out.begin(), out.end());
  return out;
}

void check_file(const fs::path& file, const std::vector<fs::path>& inputs) {
  std::error_code error;
  const fs::file_status status = fs::symlink_status(file, error);
  if (fs::is_symlink(status))
    throw OutputError(file, "it is a link, and results are not written through links");
  if (!fs::is_regular_file(status)) throw OutputError(file, "it is no file");
  for (const fs::path& input : inputs)
    if (fs::equivalent(file, input, error))
      throw OutputError(file, fmt::format("it is the input '{}' of this run", input.string()));
}

}  // namespace

bool is_result_name(const fs::path& name_in_folder) {
  const std::string name = without_tmp(name_in_folder.filename().string());
  return name_in_folder.has_parent_path() ? name_in_folder.parent_path() == "fields" && is_field_name(name)
                                          : is_top_name(name);
}

void check_result_folder(const fs::path& dir, const std::vector<fs::path>& inputs) {
  std::error_code error;
  for (const fs::path& file : entries(dir))
    if (is_result_name(file.filename())) check_file(file, inputs);
  for (const char* folder : folders) {
    const fs::path path = dir / folder;
    if (fs::is_symlink(fs::symlink_status(path, error)))
      throw OutputError(path, "it is a link, and results are not written through links");
  }
  for (const fs::path& file : entries(dir / "fields"))
    if (is_result_name("fields" / file.filename())) check_file(file, inputs);
  for (const fs::path& file : entries(dir / "restart"))
    if (without_tmp(file.filename().string()).ends_with(".h5")) check_file(file, inputs);
}

void remove_results(const fs::path& dir) {
  std::error_code ignored;  // a file that cannot be removed cannot be replaced either: that is told then
  for (const fs::path& file : entries(dir / "fields"))
    if (is_result_name("fields" / file.filename())) fs::remove(file, ignored);
  for (const char* name : own_names)
    if (std::string(name) != ".courant_lock") fs::remove(dir / name, ignored);
}

}  // namespace courant
