#pragma once
// Restart files: the state of a run as HDF5, which is either whole or known not to be.
#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/restart_error.hpp"
#include "output/file.hpp"
#include "state/saved_state.hpp"

namespace courant {

/// The layout of the files. A change of what they hold that older programs misread makes it one larger.
inline constexpr int restart_format = 1;

/// Writes `file.tmp`, waits until it is on the disk and renames it, so that at any moment there is the old
/// file or the whole new one. Each array is a dataset of its path, components by rows, compressed (shuffle,
/// deflate) and with Fletcher's checksum; behind HDF5's bytes stands a line with format, cycle and CRC-32 of
/// everything before it. `state` is emptied on the way. Throws OutputError.
void write_restart_file(const std::filesystem::path& file, SavedState& state, std::int64_t cycle);

/// Reads it back and checks every byte. Throws RestartError, which says what is wrong with the file.
SavedState read_restart_file(const std::filesystem::path& file);

struct RestartFile {
  std::filesystem::path file;
  std::int64_t cycle = 0;
};
/// The files in a folder that end as restart files do, the latest state first; of one cycle the one written
/// last. Their other bytes are not looked at.
std::vector<RestartFile> restart_files(const std::filesystem::path& folder);

}  // namespace courant
