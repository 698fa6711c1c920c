#include "output/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

namespace courant {
namespace {

std::string advice(const std::string& reason) {
  if (reason.rfind("another run", 0) == 0)
    return "wait for its end or stop it, or choose another folder with -o";
  if (reason == std::strerror(ENOSPC) || reason == std::strerror(EDQUOT))
    return "free some space, or choose a folder on another disk with -o, and run again";
  if (reason == std::strerror(EFBIG)) return "raise the limit on file sizes (ulimit -f) and run again";
  if (reason == std::strerror(EACCES) || reason == std::strerror(EROFS) || reason == std::strerror(EPERM))
    return "make the folder writable, or choose another with -o";
  if (reason.rfind("no memory", 0) == 0 || reason.find("allocate memory") != std::string::npos ||
      reason == "HDF5 failed" || reason == std::strerror(ENOMEM))
    return "give the run more memory (ulimit -v, fewer --threads), or ask for no restart file "
           "(--no-final-dump)";
  if (reason.rfind("it is ", 0) == 0)
    return "rename or remove it, or choose another folder with -o; nothing was changed";
  return "check the folder and the disk, or choose another folder with -o";
}

struct FileCloser {
  void operator()(std::FILE* f) const { std::fclose(f); }
};

/// What the system says; of a link not that there are too many levels of them.
std::string reason_of(int number) {
  return number == ELOOP ? "it is a link, and results are not written through links" : std::strerror(number);
}

}  // namespace

OutputError::OutputError(const std::filesystem::path& file, const std::string& reason)
    : std::runtime_error(
          fmt::format("{}{}': {}\n  hint: {}", beginning, file.string(), reason, advice(reason))),
      file_(file) {}

void make_folder(const std::filesystem::path& dir) {
  std::error_code error;
  std::filesystem::create_directories(dir, error);
  if (error) throw OutputError(dir, error.message());
}

int make_new_file(const std::filesystem::path& file) {
  if (::unlink(file.c_str()) != 0 && errno != ENOENT) return -1;
  return ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
}

void write_file(const std::filesystem::path& file, std::initializer_list<std::string_view> pieces) {
  std::filesystem::path temporary = file;
  temporary += ".tmp";
  const auto fail = [&](int number) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw OutputError(file, std::strerror(number));
  };
  const int descriptor = make_new_file(temporary);
  if (descriptor < 0) throw OutputError(file, std::strerror(errno));
  std::unique_ptr<std::FILE, FileCloser> out(::fdopen(descriptor, "wb"));
  for (const std::string_view piece : pieces)
    if (std::fwrite(piece.data(), 1, piece.size(), out.get()) != piece.size()) fail(errno);
  if (std::fflush(out.get()) != 0) fail(errno);
  if (std::fclose(out.release()) != 0) fail(errno);  // some file systems report a full disk only here
  if (std::rename(temporary.c_str(), file.c_str()) != 0) fail(errno);
}

TextFile::TextFile(std::filesystem::path file, bool append) : file_(std::move(file)) {
  // nothing waits for the other end of a pipe
  const int flags = O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | (append ? O_APPEND : 0);
  const int descriptor = ::open(file_.c_str(), flags, 0666);
  if (descriptor < 0) throw OutputError(file_, reason_of(errno));
  stream_.reset(::fdopen(descriptor, append ? "ab" : "wb"));
  struct stat status {};
  const bool known = ::fstat(descriptor, &status) == 0;
  if (!known || S_ISFIFO(status.st_mode) || S_ISSOCK(status.st_mode))
    throw OutputError(file_, "it is no file");
  if (!append && S_ISREG(status.st_mode) && ::ftruncate(descriptor, 0) != 0)
    throw OutputError(file_, std::strerror(errno));
  std::setvbuf(stream_.get(), nullptr, _IONBF, 0);  // nothing may be left over that is tried again on closing
  std::error_code unknown;
  if (append) size_ = std::filesystem::file_size(file_, unknown);
}

void TextFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stream_.get()) == text.size()) {
    size_ += text.size();
    return;
  }
  const int number = errno;
  std::error_code ignored;
  std::filesystem::resize_file(file_, size_, ignored);  // half a line would mislead its readers
  std::fseek(stream_.get(), static_cast<long>(size_), SEEK_SET);
  throw OutputError(file_, std::strerror(number));
}

void TextFile::cut(std::uintmax_t size) {
  if (size >= size_) return;
  std::error_code error;
  std::filesystem::resize_file(file_, size, error);
  if (error) throw OutputError(file_, error.message());
  std::fseek(stream_.get(), static_cast<long>(size), SEEK_SET);
  size_ = size;
}

}  // namespace courant
