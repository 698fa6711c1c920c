#pragma once
// What analyses give: tables, numbers and gridded fields, and how they are written.
#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "base/real.hpp"

namespace courant {

struct PostColumn {
  std::string name, unit;    ///< name without blanks or commas; "-": no dimension
  std::vector<Real> values;  ///< NaN: there is none
};

/// Columns of the same length.
struct PostTable {
  std::string name;  ///< of the file, without its ending
  std::vector<PostColumn> columns;
  std::size_t rows() const { return columns.empty() ? 0 : columns.front().values.size(); }
  const PostColumn* find(const std::string& column) const;
};

/// A single number.
struct PostScalar {
  std::string name, unit;
  Real value = 0;
};

/// Fields on points of a regular grid; x runs fastest.
struct PostImage {
  std::string name;  ///< of the file, without its ending
  Real t = 0;        ///< [T]
  std::array<int, 3> n{1, 1, 1};
  std::array<Real, 3> origin{}, spacing{1, 1, 1};  ///< [L]
  std::vector<PostColumn> fields;                  ///< values of all points each; NaN: no water there
};

/// Head "name [unit],..." and one line per row; NaN is "nan". Nine digits.
std::string csv_text(const PostTable& table);

/// One file with a group per table and a dataset per column with the attribute `unit`. Throws OutputError.
void write_tables_h5(const std::filesystem::path& file, const std::vector<PostTable>& tables);

/// ImageData as VTK writes it (Float32), with a field `wet` aside for thresholds if the caller gives one.
/// Throws OutputError.
void write_vti(const std::filesystem::path& file, const PostImage& image);

}  // namespace courant
