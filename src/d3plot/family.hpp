#pragma once
// The files of a d3plot family: `d3plot` with the model, `d3plot01`, `d3plot02`, ... with the states.
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace courant {

/// The word behind the last state of a file, and behind the model.
inline constexpr float d3plot_end = -999999.0F;

/// Each file holds a whole number of states and then the end mark. A state is written behind the mark, which
/// its time replaces at last: whenever the program is killed, a reader finds whole states alone.
class D3plotFamily {
 public:
  /// most: bytes of a file of states, if it has space for more than one.
  D3plotFamily(std::filesystem::path dir, int bits, std::size_t state_bytes, std::size_t most);

  /// The model's file, and no states: those of an earlier run are removed. Throws OutputError.
  void begin(std::string_view model);
  /// Whether the model's file is there, and the files of the states before `number`.
  bool has_head() const;
  bool has_states(int number) const;
  /// The number of the first state of the next file where that of `number` has lost states before it, else
  /// `number`.
  int next_whole(int number) const;
  /// The model's file alone. Throws OutputError.
  void write_head(std::string_view model);
  /// A state, its time first, by its number from 0 on. Throws OutputError.
  void write(int number, std::string_view state);
  /// Removes states from `number` on. Throws OutputError.
  void cut(int number);

  std::size_t state_bytes() const { return state_bytes_; }
  std::int64_t bytes() const { return bytes_; }  ///< of what this object wrote

 private:
  std::filesystem::path file(int index) const;  ///< from 1 on
  void remove_from(int index);

  std::filesystem::path dir_;
  std::string end_;  ///< the end mark
  std::size_t state_bytes_;
  int states_in_file_;
  std::int64_t bytes_ = 0;
};

}  // namespace courant
