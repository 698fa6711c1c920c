#pragma once
#include <string>

namespace courant {

/// The line behind the HDF5 bytes of history.h5, with their CRC-32. The HDF5 library crashes on damaged
/// files, so it gets only bytes with a valid checksum; it ignores bytes behind its own.
std::string history_checksum(const std::string& bytes);
/// Removes the line from the content of a file. False if there is none, or if it does not match the bytes.
bool take_history_checksum(std::string& content);

}  // namespace courant
