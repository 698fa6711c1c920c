#pragma once
#include <memory>
#include <new>

#include "base/real.hpp"

namespace courant {

/// Memory that only grows and whose contents are not kept when it does; starts on a cache line. Nothing
/// touches it before its user does.
template <class T>
class Buffer {
 public:
  T* grow_to(std::size_t n) {
    if (n > capacity_) {
      capacity_ = n + n / 4;
      data_.reset(static_cast<T*>(::operator new(capacity_ * sizeof(T), line)));
    }
    return data_.get();
  }
  void free() {
    data_.reset();
    capacity_ = 0;
  }
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  std::size_t capacity() const { return capacity_; }

 private:
  static constexpr std::align_val_t line{64};
  struct Delete {
    void operator()(T* p) const { ::operator delete(p, line); }
  };
  std::unique_ptr<T, Delete> data_;
  std::size_t capacity_ = 0;
};

}  // namespace courant
