#pragma once
// Restart files: the state of a run as HDF5. A file is complete, or detected as incomplete.
#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/restart_error.hpp"
#include "output/file.hpp"
#include "state/saved_state.hpp"

namespace courant {

/// Version of the layout. It is raised by a change that older programs would misread.
inline constexpr int restart_format = 1;

/// Writes `file.tmp`, waits until it is on the disk and renames it, so that at any time the old file or the
/// complete new one exists. Each array is a dataset of its path, components by rows, compressed (shuffle,
/// deflate) and with Fletcher's checksum; behind HDF5's bytes is a line with format, cycle and CRC-32 of
/// everything before it. `state` is emptied meanwhile. Throws OutputError.
void write_restart_file(const std::filesystem::path& file, SavedState& state, std::int64_t cycle);

/// Reads a file and checks every byte. Throws RestartError, which describes the fault of the file.
SavedState read_restart_file(const std::filesystem::path& file);

struct RestartFile {
  std::filesystem::path file;
  std::int64_t cycle = 0;
};
/// The files in a folder with the end of a restart file, the latest state first; of one cycle the one written
/// last. Their other bytes are not checked.
std::vector<RestartFile> restart_files(const std::filesystem::path& folder);

}  // namespace courant
