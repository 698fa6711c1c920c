#pragma once
// Checked writing of files. All written files are opened here (tests/architecture/one_writer.py searches for
// others). A file gets its final name only once all of it is on the disk.
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace courant {

/// A result could not be written (disk full, no permission, ...). The text names the file and the remedy.
class OutputError : public std::runtime_error {
 public:
  static constexpr const char* beginning = "cannot write '";  ///< of what()
  /// `reason` as reported by the system, for example "No space left on device".
  OutputError(const std::filesystem::path& file, const std::string& reason);
  const std::filesystem::path& file() const { return file_; }
  const std::string& reason() const { return reason_; }

 private:
  std::filesystem::path file_;
  std::string reason_;
};

/// Makes the folder and its parents. Throws OutputError.
void make_folder(const std::filesystem::path& dir);

/// The reason why results cannot replace an existing file of this name: a link, or no ordinary file; "" if
/// they can.
std::string why_no_file(const std::filesystem::path& file);

/// A descriptor, closed at the end.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor();
  int number() const { return number_; }
  bool close();  ///< false, with errno, where the system reports a fault

 private:
  int number_;
};

enum class Opening {
  new_file,  ///< an empty file; none of that name may be there
  empty,     ///< the file of that name without its content, or a new one
  at_end,    ///< the file of that name, to append to its content, or a new one
  as_it_is,  ///< the file of that name for reading and writing, or a new one
  device,    ///< an existing device or pipe, also through links
};
/// Opens for writing. Links, and all but ordinary files, are refused except for `device`, which accepts
/// character devices and pipes with a reader only. Never waits. Throws OutputError.
Descriptor open_for_writing(const std::filesystem::path& file, Opening how);

enum class Durable { no, yes };  ///< yes: on the disk before the call returns
/// Writes the pieces, one after the other, to `file.tmp` and renames it to `file`, so that readers see the
/// old file or the whole new one. For files whose name the program chooses: `file.tmp` also belongs to the
/// program. Only an ordinary file is replaced. Throws OutputError; `file` is then as it was before and
/// `file.tmp` is gone.
void write_file(const std::filesystem::path& file, std::initializer_list<std::string_view> pieces,
                Durable durable = Durable::no);
inline void write_file(const std::filesystem::path& file, std::string_view content) {
  write_file(file, {content});
}
/// The same for a file that the user names: the temporary name is an unused one, and output to a device or
/// pipe (/dev/null, /dev/stdout) is written to it.
void write_named_file(const std::filesystem::path& file, std::string_view content);

/// A text file that grows during the run; each write reaches the system before the call returns. A write that
/// fails leaves the file as it was before.
class TextFile {
 public:
  /// Starts an empty file, or appends to it. Throws OutputError.
  explicit TextFile(std::filesystem::path file, bool append = false);
  /// Throws OutputError.
  void write(std::string_view text);
  std::uintmax_t size() const { return size_; }  ///< [bytes]
  /// Truncates the file to `size` bytes. Throws OutputError.
  void cut(std::uintmax_t size);

 private:
  bool cut_to(std::uintmax_t size);  ///< false with errno

  std::filesystem::path file_;
  Descriptor descriptor_;
  std::uintmax_t size_ = 0;  ///< of complete writes [bytes]
};

}  // namespace courant
