#pragma once
// What a folder of results holds before a run.
#include <filesystem>
#include <vector>

namespace courant {

/// Whether runs write files of this name to their folder, or to `fields` or `restart` in it.
bool is_result_name(const std::filesystem::path& name_in_folder);

/// Throws OutputError where a file that runs write is there as a link or as something else than a file, or is
/// one of `inputs`; also where a folder in it is a link. Folders that are missing are none of this.
void check_result_folder(const std::filesystem::path& dir, const std::vector<std::filesystem::path>& inputs);

/// Removes the files of an earlier run, so that none passes for one of the next: `fields`, `fields.pvd`,
/// `messag`, `summary.yaml`, `history.h5`, `relax`. ASCII histories are the affair of Histories, restart
/// files that of retire_restart_files.
void remove_results(const std::filesystem::path& dir);

}  // namespace courant
