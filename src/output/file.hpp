#pragma once
// Checked writing of files. A file carries its final name only once all of it is on the disk.
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

namespace courant {

/// A result could not be written (disk full, no permission, ...). The text names the file and says what to
/// do.
class OutputError : public std::runtime_error {
 public:
  static constexpr const char* beginning = "cannot write '";  ///< of what()
  /// `reason` as the system puts it, for example "No space left on device".
  OutputError(const std::filesystem::path& file, const std::string& reason);
  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
};

/// Makes the folder and its parents. Throws OutputError.
void make_folder(const std::filesystem::path& dir);

/// Makes an empty file for writing in place of one of that name, or of a link: nothing goes through it.
/// Returns its descriptor, or -1 with errno.
int make_new_file(const std::filesystem::path& file);

/// Writes the pieces, one after the other, to `file.tmp` and renames it to `file`, so that readers see the
/// old file or the whole new one. Throws OutputError; `file` is then as it was before and `file.tmp` is gone.
void write_file(const std::filesystem::path& file, std::initializer_list<std::string_view> pieces);
inline void write_file(const std::filesystem::path& file, std::string_view content) {
  write_file(file, {content});
}

/// A text file that grows while the run goes on; each write reaches the system before the call returns. A
/// write that fails leaves the file as it was before.
class TextFile {
 public:
  /// Starts an empty file, or goes on at its end. Throws OutputError.
  explicit TextFile(std::filesystem::path file, bool append = false);
  /// Throws OutputError.
  void write(std::string_view text);
  std::uintmax_t size() const { return size_; }  ///< [bytes]
  /// Takes off what stands behind the first `size` bytes. Throws OutputError.
  void cut(std::uintmax_t size);

 private:
  struct Close {
    void operator()(std::FILE* f) const { std::fclose(f); }
  };
  std::filesystem::path file_;
  std::unique_ptr<std::FILE, Close> stream_;
  std::uintmax_t size_ = 0;  ///< of what was written whole [bytes]
};

}  // namespace courant
