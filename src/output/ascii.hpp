#pragma once
// LS-DYNA's ASCII histories. Layouts: those that LS-DYNA R16 prints, measured on real files.
#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "output/binout.hpp"
#include "output/file.hpp"
#include "output/history.hpp"
#include "output/output_schedule.hpp"
#include "output/sample.hpp"
#include "state/saved_state.hpp"

namespace courant {

struct Legend {
  Id id = 0;
  std::string title;
};

/// Head of each file: title line, then the program and the date.
std::string ascii_header(const std::string& title, const std::string& date);
/// `{BEGIN LEGEND}` ... `{END LEGEND}`.
std::string ascii_legend(const std::vector<Legend>& entries);

/// One state of glstat. LS-DYNA knows no potential energy: it counts the work of gravity as external work.
/// Therefore external work here is `external_work + first_potential - potential`, total energy is without the
/// potential, sliding energy holds springs, contact damping and friction, stonewall energy what rigid walls
/// took, internal energy the rest of what was dissipated. The ratio is total / (initial + external work), 1
/// exactly when the ledger's residual is 0. first_potential: potential energy at the first state [ML2/T2].
std::string glstat_text(const Sample& sample, Real first_potential);
/// One state of matsum: per part energies, momentum, rigid body velocity.
std::string matsum_text(const Sample& sample);
/// One state of rcforc: per interface the force on SURFA (the particles) and on SURFB. The mass is printed as
/// 0; the columns of moments, which newer LS-DYNA versions append, are not there.
std::string rcforc_text(const Sample& sample);
/// One state of sleout: per interface the energy of springs, damping and friction, all of it on the side
/// SURFA (the particles), and the friction among it. Their sum is the sliding energy of glstat.
std::string sleout_text(const Sample& sample);
/// One state of sphout: stress (sigma = tau - p I, tension positive), strain (not kept: 0), density,
/// smoothing length, neighbours, active; yield stress (0) and effective stress.
std::string sphout_text(const Sample& sample);
/// One state of nodout: displacement, velocity, acceleration and place of nodes, in global axes; then, where
/// a node belongs to a rigid body or turns with shells and beams, its rotation. Velocities are those of the
/// last half step.
std::string nodout_text(const Sample& sample);
/// One state of rbdout: motion of the centre of each rigid body, in global and in principal axes.
std::string rbdout_text(const Sample& sample);
/// One state of bndout: the forces that drive particles and bodies, and their work so far.
std::string bndout_text(const Sample& sample);
/// One state of spcforc: the forces and moments that hold particles and nodes.
std::string spcforc_text(const Sample& sample);

/// One state of rwforc: the force on each rigid wall.
std::string rwforc_text(const Sample& sample);

struct HistoryRequests {
  OutputSchedule glstat{}, matsum{}, rcforc{}, sleout{}, sphout{}, nodout{}, rbdout{}, bndout{}, spcforc{},
      rwforc{};
  /// history.h5; where it is not wanted: with the file of the shortest interval, and with those that a curve
  /// times; none if there is no other.
  OutputSchedule h5{};
  /// Histories that files add, in the order of their registry.
  struct Added {
    std::string name;
    OutputSchedule schedule{};
    std::vector<Legend> legend{};
    std::string columns{};  ///< behind it
  };
  std::vector<Added> added{};
  /// Of a history by its name, as BINARY has it: 2 in binout, 3 in both; others are text.
  std::map<std::string, int> binary{};
  std::string title{};
  std::vector<Legend> parts{}, contacts{}, nodes{}, rigid_walls{};
};

/// How far the files of a run have come: what a restart cuts them back to.
struct HistoryPositions {
  std::map<std::string, std::int64_t> bytes;            ///< of each text file
  std::int64_t rows = 0;                                ///< of history.h5
  std::vector<Real> first_potential;                    ///< none before the first sample [ML2/T2]
  std::map<std::string, std::int64_t> binout_states{};  ///< of each history in binout
  std::int64_t binout_bytes = 0;
  void keep(Archive& archive) {
    archive("bytes", bytes);
    archive("rows", rows);
    archive("first_potential", first_potential);
    archive("binout_states", binout_states);
    archive("binout_bytes", binout_bytes);
  }
};

/// All histories of a run, each at its own interval.
class Histories {
 public:
  /// Opens the files that were asked for: empty ones, or those of an earlier run, cut back to where they were
  /// then. Throws OutputError.
  Histories(const std::filesystem::path& dir, HistoryRequests requests,
            const HistoryPositions* resume = nullptr);
  /// What of the earlier run's files is missing, a line each.
  const std::vector<std::string>& lost() const { return lost_; }
  /// When what was written last. `t`: where the run goes on [T]
  void keep(Archive& archive, Real t);
  /// How long the files are, with what `finish` would still write. Belongs to the thread that writes.
  HistoryPositions positions() const;
  void set_first_potential(const HistoryPositions& before) {
    if (!before.first_potential.empty()) first_potential_ = before.first_potential[0];
  }

  /// Whether any file is due at the cycle that goes from t to t + dt: only then a Sample need be filled.
  bool is_due(Real t, Real dt) const;
  /// Which files a sample goes to: one entry for each ASCII file, the last one for history.h5.
  using Due = std::vector<bool>;
  /// The files that are due at the cycle that goes from t to t + dt, with `always` (the end of the run) all
  /// that have no sample of time t yet. From here on they count as written.
  Due take(Real t, Real dt, bool always = false);
  /// Writes the sample to those files. Touches nothing that `is_due` and `take` use: they may go on while
  /// another thread writes. Throws OutputError.
  void write(const Sample& sample, const Due& due);
  void write(const Sample& sample, bool always = false) { write(sample, take(sample.t, sample.dt, always)); }
  /// Writes what is buffered. Throws OutputError.
  void finish();
  std::int64_t bytes() const;  ///< of all files, after `finish`

 private:
  void choose_h5_times(const OutputSchedule& wanted);

  struct Ascii {
    OutputSchedule schedule;
    std::string name;
    std::optional<TextFile> file;  // none: in binout alone
    bool in_binout = false;
    std::function<std::string(const Sample&)> text;  // empty: glstat, which needs the first potential
    Real last = -1;                                  // time of the last state
  };
  void write(Ascii& to, const Sample& sample);

  std::filesystem::path dir_;
  std::vector<Ascii> files_;
  std::vector<OutputSchedule> h5_schedules_;  // any of them
  std::optional<History> h5_;
  std::optional<Binout> binout_;
  Real h5_last_ = -1;
  std::optional<Real> first_potential_;
  std::vector<std::string> lost_;
};

}  // namespace courant
