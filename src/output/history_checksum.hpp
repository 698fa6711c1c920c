#pragma once
#include <string>

namespace courant {

/// The line that is behind the HDF5 bytes of history.h5, with their CRC-32. HDF5's own library crashes on
/// damaged files, so nobody hands it bytes that are not those that were written; it passes over what stands
/// behind its own.
std::string history_checksum(const std::string& bytes);
/// Takes the line off the content of a file. False where there is none, or the bytes before are others.
bool take_history_checksum(std::string& content);

}  // namespace courant
