#pragma once
// Field files for ParaView: one .vtp (particles) and one .vtu (shells) per state, tied together in time by
// fields.pvd.
#include <filesystem>
#include <string>
#include <vector>

#include "output/file.hpp"
#include "state/world.hpp"

namespace courant {

struct FieldWriterOptions {
  std::vector<Id> part_ids;    ///< deck number of each part index, for the array `part`
  bool hide_inactive = false;  ///< ISHOW = 1: particles that are not active are left out
};

/// Writes `fields/particles_NNNN.vtp`, `fields/shells_NNNN.vtu` (if there are segments) and `fields.pvd`
/// under a folder. All registry fields flagged `output` are written, reals as float32, plus `part` (deck
/// number) and, for particles, `active` (1 or 0). Particles stand in the order of their ids, so that a point
/// keeps its place over time. Each array carries its dimension (M, L, T) as VTK's UNITS_LABEL, each file its
/// time as field data `TimeValue`.
class FieldWriter {
 public:
  /// Makes the folders. Throws OutputError.
  FieldWriter(std::filesystem::path dir, FieldWriterOptions options);

  /// Writes one state and then rewrites fields.pvd, so that a killed run can still be opened. t: [T]. Throws
  /// OutputError, std::out_of_range where a part index has no entry in part_ids.
  void write(const World& world, Real t, int state);

  /// Brings fields.pvd up to date; after this the writer may be dropped. Throws OutputError.
  void finish();

 private:
  void write_index();

  std::filesystem::path dir_;
  FieldWriterOptions options_;
  std::string entries_;  // the <DataSet> lines of fields.pvd so far
  bool index_written_ = true;
};

}  // namespace courant
