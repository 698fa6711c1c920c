#pragma once
// *COURANT_PAIR_GEOMETRY: kernel gradients that are frozen over several steps (a window), where sound is much
// faster than the flow.
#include <array>
#include <memory>
#include <vector>

#include "parallel/buffer.hpp"
#include "search/neighbours.hpp"
#include "sph/options/frozen_loops.hpp"
#include "sph/sph.hpp"

namespace courant {

/// How long a window lasts: until two particles may have moved EPS h towards each other, by the speed of the
/// fastest, or lists are built again.
class Window {
 public:
  explicit Window(Real eps) : eps_(eps) {}
  /// Begins a window if none is open; true if it did. h [L]; the last step dt [T]; how far particles may move
  /// before lists end the window, `room` [L]: beyond that they are not complete.
  bool open(Real h, Real dt, Real room);
  /// From now to the middle of the window: gradients of that position err by the square of EPS, not by EPS.
  /// [T]
  Real ahead() const { return ahead_; }
  bool is_open() const { return open_; }
  void close() { open_ = false; }
  /// After a step of dt in which the fastest particle had the speed `fastest` [L/T]: closes it once the bound
  /// is passed.
  void moved(Real fastest, Real h, Real dt);
  void keep(Archive& archive);

 private:
  Real eps_;
  bool open_ = false;
  Real moved_ = 0, fastest_ = 0;  ///< bound of what a particle moved since it opened [L]; [L/T]
  Real ahead_ = 0;
};

/// The window and the memory for its gradients.
class FrozenPairs {
 public:
  FrozenPairs(const SphSettings& settings, std::shared_ptr<Neighbours> neighbours,
              const FrozenChoice& choice);
  Window window;
  const Resource& gradients() const { return gradients_; }
  bool open(Real h, const Clock& clock);
  /// Before the lists of a window that just opened are filled.
  void prepare(const PairArrays&);
  FrozenLists lists(Index begin, Index end);

 private:
  struct Block {
    Buffer<Index> list;
    Buffer<Fixed16> gradients;
    Buffer<Float16> factors;
    std::array<Index, Neighbours::groups_per_block + 1> start;
  };
  Resource gradients_{"frozen gradients", "particles"};
  std::shared_ptr<Neighbours> neighbours_;
  KernelChoice kernel_;
  int dim_;
  FrozenLists shape_{};  ///< what is the same for all lists
  std::vector<Block> blocks_;
};

}  // namespace courant
