#pragma once
// Reads history.h5.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "base/real.hpp"

namespace courant {

/// A history.h5 that is open for reading. Row i of every dataset belongs to /global/time[i]. A quantity that
/// was not there at a sample is NaN in all datasets of its group: rows() tells those apart from numbers that
/// went wrong.
class HistoryFile {
 public:
  /// Faults are reported; then there is no value.
  static std::optional<HistoryFile> open(const std::filesystem::path& file, Diagnostics& diagnostics);
  HistoryFile(HistoryFile&&) noexcept;
  HistoryFile& operator=(HistoryFile&&) noexcept;
  ~HistoryFile();

  /// Paths of all datasets, "/contacts/1/force", sorted.
  const std::vector<std::string>& names() const;
  /// Components of a dataset, 1 or 3; 0 where there is none of that name.
  int components(const std::string& path) const;
  /// Dimension of a dataset in M, L, T as the file names it, "ML/T2"; "-" where there is none.
  std::string dimension(const std::string& path) const;
  /// One component of a dataset; shape: (rows). Nothing if it cannot be read.
  std::optional<std::vector<Real>> column(const std::string& path, int component = 0) const;
  /// 1 for the rows in which the group of a dataset was sampled, else 0; shape: (rows).
  std::vector<char> sampled(const std::string& path) const;

 private:
  struct Content;
  explicit HistoryFile(std::unique_ptr<Content> content);
  std::unique_ptr<Content> content_;
};

}  // namespace courant
