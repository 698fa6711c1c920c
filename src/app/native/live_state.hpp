#pragma once
// The state of a run as its program sees it at a time level.
#include <pybind11/pybind11.h>

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "app/native/lent_arrays.hpp"
#include "app/run/simulation.hpp"
#include "loads/program_forces.hpp"

namespace courant::native {

/// Valid while the program is called; afterwards all but `t`, `dt` and `cycle` throw std::runtime_error.
class LiveState {
 public:
  explicit LiveState(Simulation& simulation);
  void end();  ///< the run continues

  const Real t, dt;
  const std::int64_t cycle;

  int dim();
  /// Names of mass, length, time; nothing where they are not known.
  std::vector<std::string> units();
  /// Names of the sets of entities: particles, nodes, segments, "solids of part 1".
  std::vector<std::string> sets();
  Index size(const std::string& set);
  /// Particles that are inside of the computational box: the first ones.
  Index active();
  /// (name, dimension, components) of each field of a set.
  std::vector<std::tuple<std::string, std::string, int>> fields(const std::string& set);
  /// Throws pybind11::key_error for a name that is not there.
  pybind11::array array(const std::string& set, const std::string& field, int component);
  /// By part: mass, centre, velocity, angular velocity, force, moment, kinetic energy.
  std::map<Id, RigidBodyReport> bodies();

  /// Of points `at`: row by row three components; forces act from the next step on. Throws
  /// std::invalid_argument where a point takes none; then none is changed but those before it.
  void set_forces(const std::string& set, const std::vector<Index>& at, const std::vector<Real>& values);
  void set_velocities(const std::string& set, const std::vector<Index>& at, const std::vector<Real>& values);
  void push_body(Id part, const Vec& force, const Vec& moment);
  void move_body(Id part, const Vec& v, const Vec& omega);

 private:
  Simulation& now() const;
  FieldSet& set_of(const std::string& name) const;
  PointChanges& changes_of(const std::string& set) const;
  std::size_t body_of(Id part) const;
  void check(const std::string& set, const std::vector<Index>& at, const std::vector<Real>& values) const;

  Simulation* simulation_;
  LentArrays lent_;
};

}  // namespace courant::native
