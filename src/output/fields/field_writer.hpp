#pragma once
// Field files for ParaView: one .vtp (particles) and one .vtu (shells) per state, tied together in time by
// fields.pvd.
#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "output/fields/vtk_xml.hpp"
#include "output/file.hpp"
#include "state/saved_state.hpp"
#include "state/world.hpp"

namespace courant {

struct FieldWriterOptions {
  std::vector<Id> part_ids{};              ///< deck number of each part index, for the array `part`
  std::vector<std::string> part_titles{};  ///< of each part index; each is field data `part ID: title`
  bool hide_inactive = false;              ///< ISHOW = 1: particles that are not active are left out
  std::vector<Index> left_out{};  ///< parts (by index, sorted) without particles and shells in the files
  std::function<bool(const Vec& x)> inside{};  ///< only particles there; empty: everywhere
  /// Arrays of particles: names of fields, `part`, `active`, `acceleration`; empty: what a run usually
  /// writes.
  std::vector<std::string> fields{};
  std::vector<std::string> extra{};  ///< besides these; names that the run does not have are passed over
  bool float64 = false;              ///< reals with 64 bits, not 32
  Real eps = 0;   ///< reals may be off by this part of the range of their array at that time [-]
  Real epsx = 0;  ///< error bound of positions, as a part of the smallest h [-]
  Compression compression{};
  /// Shells without their forces, and a state whose shells are as before names the file from before.
  bool sparse_shells = false;
};

/// Names that FieldWriterOptions::fields may hold.
std::vector<std::string> particle_array_names(const World& world);

/// The content of the field files of one time: a copy, so that the run can continue.
struct FieldState {
  int number = 0;
  Real t = 0;                           ///< [T]
  std::optional<VtkDataSet> particles;  ///< none without particles
  std::optional<VtkDataSet> shells;     ///< none without segments
  std::optional<VtkDataSet> solids;     ///< none without elements
};

/// Writes `fields/particles_NNNN.vtp`, `fields/shells_NNNN.vtu`, `fields/solids_NNNN.vtu`, as far as there
/// are particles, segments, solids, and `fields.pvd` under a folder. All registry fields flagged `output` are
/// written, reals as float32, plus `part` (deck number) and, for particles, `active` (1 or 0), unless the
/// options choose otherwise. Places are float64 where float32 would be off by more than a thousandth of h.
/// Particles are in the order of their ids, so that a point keeps its location over time. Each array carries
/// its dimension (M, L, T) as VTK's UNITS_LABEL, each file its time as field data `TimeValue`.
class FieldWriter {
 public:
  /// Makes the folders. Throws OutputError.
  FieldWriter(std::filesystem::path dir, FieldWriterOptions options);

  /// Copies what a state holds; changes nothing. t: [T]. Throws std::out_of_range where a part index has no
  /// entry in part_ids.
  FieldState take(const World& world, Real t, int number) const;
  /// Writes one state, and fields.pvd again so that others can open what is there, even of a killed run. As
  /// the list grows that is done only when it lacks a sixteenth of the states or is a second old. Throws
  /// OutputError.
  void write(FieldState state);
  void write(const World& world, Real t, int number) { write(take(world, t, number)); }

  int states() const { return states_; }
  std::int64_t bytes() const { return bytes_; }  ///< of all field files

  /// The state of a run that stopped in error, for those that want to look: `fields/failed.vtp` and
  /// `fields/failed_shells.vtu`, which fields.pvd does not list. Active and halo particles whose places a
  /// float32 can hold; nothing where there is none. Other values may be NaN. Throws OutputError.
  void write_failed(const World& world, Real t);

  /// The states that fields.pvd lists. Belongs to the thread that writes.
  void keep(Archive& archive);
  /// After loading: takes off the files of states from `number` on, of which fields.pvd then knows nothing.
  /// Throws OutputError.
  void cut(int number);

  /// Brings fields.pvd up to date; after this the writer may be dropped. Throws OutputError.
  void finish();

 private:
  void write_index();
  void put(const std::string& file, VtkEncoder& encoder, VtkDataSet data);

  std::filesystem::path dir_;
  FieldWriterOptions options_;
  std::vector<VtkArray> titles_;  // of parts
  std::string entries_;           // the <DataSet> lines of fields.pvd so far
  VtkEncoder particle_encoder_, shell_encoder_, solid_encoder_;
  std::vector<VtkSection> shells_before_;
  std::string shell_file_;  // where these stand
  static constexpr std::chrono::seconds longest_wait_{1};
  int states_ = 0, states_not_listed_ = 0;
  std::int64_t bytes_ = 0;
  std::chrono::steady_clock::time_point listed_at_;
};

}  // namespace courant
