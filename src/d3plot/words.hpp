#pragma once
// Words of a d3plot file: numbers of one width, and text.
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "base/real.hpp"

namespace courant {

class Words {
 public:
  explicit Words(int bits) : wide_(bits == 64) {}
  std::size_t width() const { return wide_ ? 8 : 4; }            ///< bytes of a word
  std::size_t count() const { return bytes_.size() / width(); }  ///< words so far
  const std::string& bytes() const { return bytes_; }
  std::string take() { return std::move(bytes_); }
  void reserve(std::size_t words) { bytes_.reserve(words * width()); }

  void real(Real value) {
    if (wide_)
      add(static_cast<double>(value));
    else
      add(static_cast<float>(value));
  }
  void vec(const Vec& v) {
    for (int k = 0; k < 3; ++k) real(v[k]);
  }
  void zeros(std::size_t words) { bytes_.append(words * width(), '\0'); }
  void integer(std::int64_t value) {
    if (wide_)
      add(value);
    else
      add(static_cast<std::int32_t>(value));
  }
  /// So many bytes, cut or filled with blanks.
  void text(std::string_view value, std::size_t bytes) {
    bytes_ += value.substr(0, bytes);
    if (value.size() < bytes) bytes_.append(bytes - value.size(), ' ');
  }

 private:
  template <class T>
  void add(T value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    bytes_.append(bytes, sizeof value);
  }
  bool wide_;
  std::string bytes_;
};

}  // namespace courant
