#pragma once
// The names of all files that a run writes; other files cannot be written.
#include <filesystem>
#include <string>

namespace courant {

namespace result_names {
inline constexpr const char* messag = "messag";
inline constexpr const char* summary = "summary.yaml";
inline constexpr const char* history = "history.h5";
inline constexpr const char* fields_index = "fields.pvd";
inline constexpr const char* relaxation = "relax";
inline constexpr const char* lock = ".courant_lock";
inline constexpr const char* binout = "binout0000";
inline constexpr const char* d3plot = "d3plot";  ///< and d3plot01, d3plot02, ...
inline constexpr const char* gauges = "gauges";  ///< folder: NAME.csv of each gauge
inline constexpr const char* whole[] = {messag, summary, history, fields_index, relaxation, lock, binout};
inline constexpr const char* folders[] = {"fields", "restart", "restart_old", gauges};
}  // namespace result_names

/// The name without the ending of files that are being written.
std::string without_tmp(const std::string& name);
/// Whether runs write a file of this name to their folder, or to `fields` or `restart` in it. The ASCII
/// histories of extensions are not among them.
bool is_listed_result(const std::filesystem::path& name_in_folder);
/// The path of a result. Throws std::logic_error for a name that is not listed.
std::filesystem::path result_path(const std::filesystem::path& folder,
                                  const std::filesystem::path& name_in_folder);

}  // namespace courant
