#pragma once
// The files of states requested by a deck: VTK's, d3plot, or both.
#include <filesystem>
#include <limits>
#include <optional>
#include <string>

#include "app/run/simulation.hpp"
#include "d3plot/d3plot_model.hpp"
#include "d3plot/family.hpp"
#include "output/fields/field_writer.hpp"

namespace courant {

/// Members named as of FieldWriter do the same for all kinds; `take` is for the thread of the time loop, what
/// writes is for the one that writes.
class StateFiles {
 public:
  /// Throws OutputError.
  StateFiles(const std::filesystem::path& dir, Simulation& simulation);

  struct State {
    int number = 0;
    std::optional<FieldState> vtk{};
    std::string d3plot_head{}, d3plot{};
  };
  bool with_vtk() const { return !model_ || model_->beside_vtk; }
  State take(World& world, const Clock& clock, int number);
  void write(State state);
  void write_failed(const World& world, Real t) { vtk_.write_failed(world, t); }
  void keep(Archive& archive);
  /// Removes states from `number` on. Returns what is missing of those before; empty: nothing.
  std::string cut(int number);
  void finish() { vtk_.finish(); }
  int states() const { return states_; }
  std::int64_t bytes() const { return vtk_.bytes() + (d3plot_ ? d3plot_->bytes() : 0); }

 private:
  std::filesystem::path dir_;
  D3plotModel* model_;  ///< null: no d3plot
  FieldWriter vtk_;
  std::optional<D3plotFamily> d3plot_;
  bool has_head_ = false;
  static constexpr int none = std::numeric_limits<int>::min();
  int first_ = none;  ///< number of the first state of the family, below 0 where a gap moved it; or `none`
  int states_ = 0;
};

}  // namespace courant
