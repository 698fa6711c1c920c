#pragma once
// LSDA, the container of LS-DYNA's binout: folders with arrays of numbers, written state after state.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/real.hpp"
#include "output/file.hpp"

namespace courant {

/// An array in a folder, or text as bytes.
struct LsdaArray {
  enum class Type : std::uint8_t { text = 1, integer = 4, real = 10 };  ///< as LSDA numbers them, I1 I8 R8
  std::string folder, name;
  Type type = Type::real;
  std::string bytes;
  std::size_t count = 0;
};

LsdaArray lsda_reals(std::string folder, std::string name, const std::vector<Real>& values);
LsdaArray lsda_integers(std::string folder, std::string name, const std::vector<std::int64_t>& values);
LsdaArray lsda_text(std::string folder, std::string name, const std::string& text);

/// A file that grows. The arrays of a call and the table that names them are on the disk before the table
/// before refers to them: whenever the program is killed, a reader finds whole calls alone.
class LsdaFile {
 public:
  /// An empty file, or one cut back to `bytes` of a file that this class wrote. Throws OutputError.
  LsdaFile(std::filesystem::path file, std::optional<std::uintmax_t> bytes);
  /// Throws OutputError.
  void write(const std::vector<LsdaArray>& arrays);
  std::uintmax_t size() const { return size_; }  ///< [bytes]

 private:
  void put(std::string_view bytes, std::uintmax_t at);

  std::filesystem::path file_;
  Descriptor descriptor_;
  std::uintmax_t size_ = 0;
  std::uintmax_t link_ = 0;  ///< where the offset of the next table goes
};

}  // namespace courant
