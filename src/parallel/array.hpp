#pragma once
#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace courant {

/// Allocator that starts every array on a cache line, so that vector loads do not straddle lines, and that
/// leaves new numbers as they are: `resize` neither writes nor touches what it adds. Memory belongs to the
/// processor that touches it first, so the loop that fills an array should be the parallel one.
template <class T>
struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::align_val_t line{64};
  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), line)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, line); }
  template <class U>
  void construct(U* at) noexcept(std::is_nothrow_default_constructible_v<U>) {
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
  }
  template <class U>
  bool operator==(const CacheLineAllocator<U>&) const {
    return true;
  }
};

/// Mind: `Array<T> a(n)` and `a.resize(n)` leave numbers without a value; `Array<T> a(n, value)` gives one.
template <class T>
using Array = std::vector<T, CacheLineAllocator<T>>;

}  // namespace courant
