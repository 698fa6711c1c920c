#pragma once
// Reads LS-DYNA's ASCII histories, of courant and of LS-DYNA itself.
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "base/real.hpp"

namespace courant {

/// What a series of a file belongs to.
struct AsciiKey {
  std::string name;                ///< as in the file: "kinetic energy", "x-mom", "velocities x"
  std::optional<std::int64_t> id;  ///< of part, node, interface or wall; none: of the whole
  std::string side{};              ///< rcforc: SURFA, SURFB; bndout: "velocity nd#"; spcforc: "setid 3"
  bool operator==(const AsciiKey&) const = default;
};

struct AsciiColumn {
  AsciiKey key;
  std::vector<Real> values;  ///< one per time; NaN: not there, or stars
};

/// A glstat, matsum, rcforc, sleout, nodout, rbdout, bndout, spcforc, rwforc or sphout that was read whole.
/// The kind is told by the content, not by the name. Taken as they come: titles, legends, columns that newer
/// versions append, slave and master for SURFA and SURFB, exponents without E (0.1-100), stars for numbers
/// that did not fit. Where a run was restarted and its times go back, the later states count.
class AsciiFile {
 public:
  /// Faults are reported with file and line; then there is no value.
  static std::optional<AsciiFile> open(const std::filesystem::path& file, Diagnostics& diagnostics);

  const std::string& kind() const { return kind_; }      ///< "glstat", ...
  const std::vector<Real>& times() const { return t_; }  ///< as printed [T]
  const std::vector<AsciiColumn>& columns() const { return columns_; }

  /// The one column with this name; id and side may be left out where they leave no doubt. A side is found by
  /// any of its words. Otherwise nullptr, and `why` and `hint` tell.
  const AsciiColumn* find(const AsciiKey& key, std::string& why, std::string& hint) const;
  /// Dimension in M, L, T, "ML/T2"; "-" for a pure number, "?" where it is not known.
  std::string dimension(const AsciiColumn& column) const;

 private:
  std::string kind_;
  std::vector<Real> t_;
  std::vector<AsciiColumn> columns_;
};

}  // namespace courant
