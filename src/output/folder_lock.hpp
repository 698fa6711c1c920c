#pragma once
#include <filesystem>

#include "output/file.hpp"

namespace courant {

/// During its lifetime no other run writes its results to the folder. The system releases the lock at any end
/// of the process.
class FolderLock {
 public:
  /// Makes the folder where it is missing. Throws OutputError where another run is writing there, or the
  /// folder cannot be written. File systems without locks are accepted.
  explicit FolderLock(const std::filesystem::path& folder);
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock();

 private:
  std::filesystem::path file_;
  Descriptor descriptor_{-1};
};

}  // namespace courant
