#include "output/folder_lock.hpp"

#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>

#include "output/result_names.hpp"

namespace courant {
namespace {

std::string holder(int descriptor) {
  char text[32] = {};
  const ssize_t n = ::pread(descriptor, text, sizeof text - 1, 0);
  return n > 0 ? fmt::format(" (process {})", std::string(text, static_cast<std::size_t>(n))) : "";
}

/// Whether the name still belongs to the file that was opened: the run before may just have removed it.
bool is_at(int descriptor, const std::filesystem::path& file) {
  struct stat opened {
  }, named{};
  return ::fstat(descriptor, &opened) == 0 && ::stat(file.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder) : file_(result_path(folder, result_names::lock)) {
  make_folder(folder);
  while (true) {
    Descriptor opened = open_for_writing(file_, Opening::as_it_is);
    if (::flock(opened.number(), LOCK_EX | LOCK_NB) != 0) {
      if (errno == EWOULDBLOCK)
        throw OutputError(folder, "another run" + holder(opened.number()) + " is writing there");
      descriptor_ = std::move(opened);  // a file system without locks
      return;
    }
    if (!is_at(opened.number(), file_)) continue;
    descriptor_ = std::move(opened);
    break;
  }
  const std::string me = std::to_string(::getpid());
  // only for messages: a lock without a number is a lock all the same
  if (::ftruncate(descriptor_.number(), 0) == 0 &&
      ::pwrite(descriptor_.number(), me.data(), me.size(), 0) < 0)
    return;
}

FolderLock::~FolderLock() {
  ::unlink(file_.c_str());
}

}  // namespace courant
