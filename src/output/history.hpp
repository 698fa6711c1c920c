#pragma once
// history.h5: time histories as growing datasets.
#include <array>
#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "output/file.hpp"
#include "output/sample.hpp"

namespace courant {

/// Collects samples and appends them to an HDF5 file. Row i of every dataset belongs to /global/time[i]; a
/// quantity that is missing in a sample is NaN. Datasets, scalars of shape (n), vectors of shape (n, 3),
/// symmetric tensors of shape (n, 6), each with an attribute `dimension` (M, L, T):
///   /global/{time dt cycle mass velocity kinetic internal potential contact dissipated external_work total
///   residual throughput}
///   /parts/<id>/{mass kinetic internal momentum}          with attribute `title`
///   /contacts/<id>/{force energy_stored energy_damping energy_friction}   force: on the particles
///   /rigid_bodies/<part id>/{x v omega force moment kinetic displacement rotation a angular_a}
///   /particles/<id>/{x v p rho E h tau neighbours active}
///   /nodes/<id>/{displacement x v a}, of those that turn also {rotation omega angular_a}
///   of histories that files add, as elout, secforc, deforc, jntforc, swforc and trhist do:
///   /solids/<id>/{stress plastic_strain deleted}, of several points stress_of_point_1, ...; /shells the
///   same; /beams/<id>/{axial shear_s shear_t moment_s moment_t torsion deleted}, /sections/<id>/{force
///   moment centroid area}, /springs/<id>/{force resultant change_in_length}, /joints/<id>/{force moment},
///   /welds/<id>/{axial shear resultant_moment torsion length failure_time}, /tracers/<id>/{x v stress rho
///   active} /driven_particles/<id>/{force work}, /driven_bodies/<part id>/{force moment work},
///   /held_particles/<id>/force, /driven_rotations/<id>/{moment work}, /held_rotations/<id>/moment
///   /gauges/<name>/{time ...}: rows of their own, at the times of that gauge
/// A flush replaces the file by a longer one, so it is readable at any time, also after a killed run.
class History {
 public:
  explicit History(std::filesystem::path file, std::size_t buffered_samples = 1024,
                   std::chrono::seconds longest_wait = std::chrono::seconds(10));

  /// Continues an existing file behind its first `rows` rows; later rows are removed. Returns the number of
  /// rows kept: less if the file has less. Throws OutputError. `gauge_rows`: the same for the groups of
  /// gauges, which have separate rows.
  std::size_t resume(std::size_t rows, const std::map<std::string, std::int64_t>& gauge_rows = {});
  std::size_t rows() const { return rows_in_file_ + rows_; }  ///< samples so far

  /// Adds a sample; writes to the file when the buffer is full or old. Throws OutputError.
  void record(const Sample& sample);
  /// The same for one gauge, in separate rows. Throws OutputError.
  void record_gauge(const GaugeLayout& layout, Real t, const std::vector<Real>& values);
  std::map<std::string, std::int64_t> gauge_rows() const;  ///< so far, by name of the gauge
  /// Appends buffered samples. Call it at the end of the run. Throws OutputError.
  void flush();

 private:
  struct Column {
    std::string dimension;
    int components = 1;
    std::vector<double> values;  // shape: (buffered rows, components)
  };
  /// Of one gauge.
  struct OwnRows {
    GaugeLayout layout;
    std::vector<double> values;  // shape: (buffered rows, 1 + numbers of the gauge), time first
    std::size_t rows = 0, rows_in_file = 0;
    /// Numbers [first, first + count) of each row.
    std::vector<double> columns(std::size_t first, std::size_t count) const;
  };
  void put(const std::string& path, const char* dimension, double value);
  void put(const std::string& path, const char* dimension, const Vec& value);
  void put(const std::string& path, const char* dimension, const std::array<Real, 6>& value);
  void put_added(const Sample& sample);
  Column& column(const std::string& path, const std::string& dimension, int components);
  void put_global(const Sample& sample);
  void put_entities(const Sample& sample);
  void put_bodies(const Sample& sample);
  void put_points(const Sample& sample);
  std::size_t bytes_buffered() const;
  std::size_t enough_rows() const;  ///< number of buffered rows that justify a flush

  std::filesystem::path file_;
  std::size_t buffered_samples_;
  std::chrono::seconds longest_wait_;
  std::chrono::steady_clock::duration wait_;
  std::chrono::steady_clock::time_point last_flush_;
  std::map<std::string, Column> columns_;
  std::map<std::string, OwnRows> gauges_;      // by name
  std::map<std::string, std::string> titles_;  // of groups
  std::size_t rows_ = 0;                       // buffered
  std::size_t rows_in_file_ = 0;
};

}  // namespace courant
