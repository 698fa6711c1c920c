#include "output/result_names.hpp"

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include "output/ascii/text_history.hpp"

namespace courant {
namespace {

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

/// d3plot, d3plot01, ...
bool is_d3plot(const std::string& name) {
  const std::string front = result_names::d3plot;
  return name == front || (name.starts_with(front) && is_number(name.substr(front.size())));
}

}  // namespace

std::string without_tmp(const std::string& name) {
  constexpr std::string_view tmp = ".tmp";
  return name.ends_with(tmp) ? name.substr(0, name.size() - tmp.size()) : name;
}

bool is_listed_result(const std::filesystem::path& name_in_folder) {
  const std::string name = without_tmp(name_in_folder.filename().string());
  const std::filesystem::path folder = name_in_folder.parent_path();
  if (folder == "fields") return is_field_name(name);
  if (folder == "restart") return name.ends_with(".h5");
  if (folder == result_names::gauges) return name.ends_with(".csv");
  const auto is_name = [&](const char* one) { return name == one; };
  return folder.empty() &&
         (is_d3plot(name) ||
          std::any_of(std::begin(result_names::whole), std::end(result_names::whole), is_name) ||
          std::any_of(text_histories().begin(), text_histories().end(),
                      [&](const TextHistory& file) { return file.name == name; }));
}

std::filesystem::path result_path(const std::filesystem::path& folder,
                                  const std::filesystem::path& name_in_folder) {
  if (!is_listed_result(name_in_folder))
    throw std::logic_error("no name of a result: " + name_in_folder.string());
  return folder / name_in_folder;
}

}  // namespace courant
