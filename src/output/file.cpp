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
      reason.rfind("HDF5 failed", 0) == 0 || reason == std::strerror(ENOMEM))
    return "give the run more memory (ulimit -v, fewer --threads), or ask for no restart file "
           "(--no-final-dump)";
  if (reason.rfind("it is ", 0) == 0)
    return "rename or remove it, or choose another folder with -o; nothing was changed";
  return "check the folder and the disk, or choose another folder with -o";
}

/// What the system says; of a link not that there are too many levels of them.
std::string reason_of(int number) {
  return number == ELOOP ? "it is a link, and results are not written through links" : std::strerror(number);
}

/// 0, or errno.
int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

int flags_of(Opening how) {
  // nothing waits for the other end of a pipe, nothing becomes the terminal of the program
  constexpr int all = O_CLOEXEC | O_NONBLOCK | O_NOCTTY, own = all | O_CREAT | O_NOFOLLOW;
  switch (how) {
    case Opening::new_file:
      return own | O_WRONLY | O_EXCL;
    case Opening::empty:
      return own | O_WRONLY;
    case Opening::at_end:
      return own | O_WRONLY | O_APPEND;
    case Opening::as_it_is:
      return own | O_RDWR;
    case Opening::device:
      break;
  }
  return all | O_WRONLY;
}

/// Also the new name is on the disk then, where the file system can tell.
void sync_folder(const std::filesystem::path& folder) {
  const Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (descriptor.number() >= 0) ::fsync(descriptor.number());
}

enum class Kind { none, file, device, link, other };
/// `follow`: what a link leads to.
Kind kind_of(const std::filesystem::path& file, bool follow) {
  struct stat status {};
  if ((follow ? ::stat(file.c_str(), &status) : ::lstat(file.c_str(), &status)) != 0) return Kind::none;
  if (S_ISREG(status.st_mode)) return Kind::file;
  if (S_ISLNK(status.st_mode)) return Kind::link;
  return S_ISCHR(status.st_mode) || S_ISFIFO(status.st_mode) ? Kind::device : Kind::other;
}

void refuse_what_is_no_file(const std::filesystem::path& file) {
  if (const std::string why = why_no_file(file); !why.empty()) throw OutputError(file, why);
}

void write_whole(const std::filesystem::path& file, const std::filesystem::path& temporary,
                 std::initializer_list<std::string_view> pieces, Durable durable) {
  const auto fail = [&](int number) {
    ::unlink(temporary.c_str());
    throw OutputError(file, std::strerror(number));
  };
  Descriptor out(::open(temporary.c_str(), flags_of(Opening::new_file), 0666));
  if (out.number() < 0) throw OutputError(file, std::strerror(errno));
  for (const std::string_view piece : pieces)
    if (const int number = write_all(out.number(), piece); number != 0) fail(number);
  if (durable == Durable::yes && ::fsync(out.number()) != 0 && errno != EINVAL && errno != ENOSYS)
    fail(errno);
  if (!out.close()) fail(errno);  // some file systems report a full disk only here
  if (std::rename(temporary.c_str(), file.c_str()) != 0) fail(errno);
  if (durable == Durable::yes) sync_folder(file.parent_path());
}

}  // namespace

OutputError::OutputError(const std::filesystem::path& file, const std::string& reason)
    : std::runtime_error(
          fmt::format("{}{}': {}\n  hint: {}", beginning, file.string(), reason, advice(reason))),
      file_(file),
      reason_(reason) {}

std::string why_no_file(const std::filesystem::path& file) {
  switch (kind_of(file, false)) {
    case Kind::none:
    case Kind::file:
      return "";
    case Kind::link:
      return reason_of(ELOOP);
    default:
      return "it is no file";
  }
}

void make_folder(const std::filesystem::path& dir) {
  std::error_code error;
  std::filesystem::create_directories(dir, error);
  if (error) throw OutputError(dir, error.message());
}

Descriptor::~Descriptor() {
  close();
}

bool Descriptor::close() {
  return number_ < 0 || ::close(std::exchange(number_, -1)) == 0;
}

Descriptor open_for_writing(const std::filesystem::path& file, Opening how) {
  Descriptor out(::open(file.c_str(), flags_of(how), 0666));
  if (out.number() < 0)
    throw OutputError(file, errno == ENXIO ? "it is a pipe without a reader" : reason_of(errno));
  struct stat status {};
  if (::fstat(out.number(), &status) != 0) throw OutputError(file, std::strerror(errno));
  const bool is_device = S_ISCHR(status.st_mode) || S_ISFIFO(status.st_mode);
  if (how == Opening::device ? !is_device : !S_ISREG(status.st_mode))
    throw OutputError(file, "it is no file");
  if (how == Opening::device) ::fcntl(out.number(), F_SETFL, ::fcntl(out.number(), F_GETFL) & ~O_NONBLOCK);
  if (how == Opening::empty && ::ftruncate(out.number(), 0) != 0)
    throw OutputError(file, std::strerror(errno));
  return out;
}

void write_file(const std::filesystem::path& file, std::initializer_list<std::string_view> pieces,
                Durable durable) {
  std::filesystem::path temporary = file;
  temporary += ".tmp";
  refuse_what_is_no_file(file);
  if (::unlink(temporary.c_str()) != 0 && errno != ENOENT) throw OutputError(file, std::strerror(errno));
  write_whole(file, temporary, pieces, durable);
}

void write_named_file(const std::filesystem::path& file, std::string_view content) {
  if (kind_of(file, true) == Kind::device) {
    Descriptor out = open_for_writing(file, Opening::device);
    if (const int number = write_all(out.number(), content); number != 0)
      throw OutputError(file, std::strerror(number));
    return;
  }
  refuse_what_is_no_file(file);
  std::filesystem::path temporary = file;
  temporary += fmt::format(".{}.tmp", ::getpid());
  for (int k = 1; kind_of(temporary, false) != Kind::none; ++k)
    (temporary = file) += fmt::format(".{}.{}.tmp", ::getpid(), k);
  write_whole(file, temporary, {content}, Durable::no);
}

TextFile::TextFile(std::filesystem::path file, bool append)
    : file_(std::move(file)),
      descriptor_(open_for_writing(file_, append ? Opening::at_end : Opening::empty)) {
  std::error_code unknown;
  if (append) size_ = std::filesystem::file_size(file_, unknown);
}

void TextFile::write(std::string_view text) {
  const int number = write_all(descriptor_.number(), text);
  if (number == 0) {
    size_ += text.size();
    return;
  }
  cut_to(size_);  // half a line would mislead its readers
  throw OutputError(file_, std::strerror(number));
}

void TextFile::cut(std::uintmax_t size) {
  if (size >= size_) return;
  if (!cut_to(size)) throw OutputError(file_, std::strerror(errno));
  size_ = size;
}

bool TextFile::cut_to(std::uintmax_t size) {
  const auto end = static_cast<off_t>(size);
  return ::ftruncate(descriptor_.number(), end) == 0 && ::lseek(descriptor_.number(), end, SEEK_SET) == end;
}

}  // namespace courant
