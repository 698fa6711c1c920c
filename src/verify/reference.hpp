#pragma once
// Curves from CSV files.
#include <filesystem>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "base/real.hpp"

namespace courant {

/// Two columns of a file, in order of x.
struct ReferenceTable {
  std::vector<Real> x, y;  ///< shape: (rows)
  bool empty() const { return x.empty(); }
};

/// Reads the columns `column_x` and `column_y`, each a name of the head or a number from 1, of a file whose
/// values are separated by commas (or by blanks, where the first line holds no comma). Lines that begin with
/// # are comments; the first other line may hold names. Rows where one of the two is blank are skipped, and
/// rows with the same x averaged. Faults (a column that is not there, no number, fewer than two rows) go to
/// `diagnostics` with their line.
ReferenceTable read_table(const std::filesystem::path& file, const std::string& column_x,
                          const std::string& column_y, Diagnostics& diagnostics);

}  // namespace courant
