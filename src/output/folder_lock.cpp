#include "output/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "output/file.hpp"

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

FolderLock::FolderLock(const std::filesystem::path& folder) : file_(folder / ".courant_lock") {
  make_folder(folder);
  while (true) {
    descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
    if (descriptor_ < 0)
      throw OutputError(file_, errno == ELOOP ? "it is a link, and results are not written through links"
                                              : std::strerror(errno));
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      const int number = errno;
      const std::string who = holder(descriptor_);
      if (number != EWOULDBLOCK) return;  // a file system without locks
      ::close(descriptor_);
      throw OutputError(folder, "another run" + who + " is writing there");
    }
    if (is_at(descriptor_, file_)) break;
    ::close(descriptor_);
  }
  const std::string me = std::to_string(::getpid());
  // only for messages: a lock without a number is a lock all the same
  if (::ftruncate(descriptor_, 0) == 0 && ::pwrite(descriptor_, me.data(), me.size(), 0) < 0) return;
}

FolderLock::~FolderLock() {
  ::unlink(file_.c_str());
  ::close(descriptor_);
}

}  // namespace courant
