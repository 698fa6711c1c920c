#pragma once
// Arrays of a run's fields for numpy, without a copy while the program reads them, and safe when it keeps
// them.
#include <pybind11/numpy.h>

#include <map>
#include <memory>
#include <utility>

#include "state/field.hpp"

namespace courant::native {

/// Gives out components of fields as read-only arrays. When it is closed, an array that Python still holds
/// keeps its memory and its values, and the field goes on in a copy.
class LentArrays {
 public:
  LentArrays() = default;
  LentArrays(const LentArrays&) = delete;
  LentArrays& operator=(const LentArrays&) = delete;
  ~LentArrays() { close(); }
  /// shape: n. `ghosts`: values behind them, which belong to ghost particles.
  pybind11::array get(FieldBase& field, int component, Index n, Index ghosts);
  void close();

 private:
  struct Lent {
    FieldBase* field = nullptr;
    int component = 0;
    Index length = 0;
    std::unique_ptr<FieldBase> kept{};  ///< the memory, once it is no longer the field's
  };
  std::map<std::pair<FieldBase*, int>, std::shared_ptr<Lent>> lent_;
};

}  // namespace courant::native
