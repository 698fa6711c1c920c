#pragma once
// Reads one field file of a run: VTK's XML with raw appended data, as `courant run` writes it.
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/real.hpp"

namespace courant {

/// A .vtp or .vtu file that is open for reading. Nothing in it is trusted: sizes are held against the length
/// of the file before memory is asked for, and each block of data against its own size. VTK's reader crashes
/// on damaged files, and takes files of other programs, which have not what is wanted here.
class FieldFile {
 public:
  /// Nothing where it cannot be read or is no field file.
  static std::optional<FieldFile> open(const std::filesystem::path& file);

  std::int64_t points() const { return points_; }
  std::int64_t cells() const { return cells_; }  ///< of a file of cells
  /// Whether a section ("PointData", "Points", "Cells") has an array of that name.
  bool has(const std::string& section, const std::string& name) const;
  /// Components of that array, 0 where there is none.
  int components(const std::string& section, const std::string& name) const;
  /// Its values; shape: (tuples, components). Nothing where there is none, or its data are damaged.
  std::optional<std::vector<Real>> values(const std::string& section, const std::string& name,
                                          std::int64_t tuples);
  /// All values of an array that tells its own length, as "connectivity"; at most so many.
  std::optional<std::vector<std::int64_t>> integers(const std::string& section, const std::string& name,
                                                    std::int64_t most);

 private:
  struct Array {
    std::string type;  ///< "Float32", "Int64"
    int components = 1;
    std::int64_t offset = 0;
  };
  enum class Packing { none, zlib, xz };
  bool read_head(const std::string& head);
  bool take_tag(const std::string& name, const std::map<std::string, std::string>& attributes,
                std::string& section);
  const Array* find(const std::string& section, const std::string& name) const;
  std::optional<std::string> bytes_of(const Array& array, double most);
  std::optional<std::string> packed_bytes(double most);
  bool read(std::uint32_t* to, std::size_t count);

  std::ifstream stream_;
  std::int64_t size_ = 0, data_ = 0;  ///< of the file; where its appended data begin [bytes]
  std::int64_t points_ = 0, cells_ = 0;
  Packing packing_ = Packing::none;
  std::map<std::string, Array> arrays_;  ///< by section/name
};

}  // namespace courant
