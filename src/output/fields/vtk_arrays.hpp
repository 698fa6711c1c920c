#pragma once
// Arrays of VTK files from fields of the world.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "output/fields/vtk_xml.hpp"
#include "state/field.hpp"

namespace courant {

template <class T>
inline constexpr const char* vtk_type = nullptr;
template <>
inline constexpr const char* vtk_type<float> = "Float32";
template <>
inline constexpr const char* vtk_type<double> = "Float64";
template <>
inline constexpr const char* vtk_type<std::int64_t> = "Int64";
template <>
inline constexpr const char* vtk_type<std::int32_t> = "Int32";
template <>
inline constexpr const char* vtk_type<std::uint8_t> = "UInt8";

/// An array of n tuples, each filled by `put(i, to)`. The number of components is known to the compiler:
/// this is what the computation waits for at an output.
template <class T, int components, class Put>
VtkArray make_array(std::string name, std::string dimension, std::size_t n, const Put& put) {
  VtkArray out{std::move(name), vtk_type<T>, components, std::move(dimension), {}};
  constexpr std::size_t width = sizeof(T) * components;
  out.bytes.resize(n * width);
  for (std::size_t i = 0; i < n; ++i) {
    T tuple[components];
    put(i, tuple);
    std::memcpy(out.bytes.data() + i * width, tuple, width);
  }
  return out;
}

/// How reals are kept.
struct RealFormat {
  bool float64 = false;
  Real error = 0;  ///< values may be off by so much; 0: as the format has them
};

/// An array of reals; put(i, Real to[]) gives a tuple. With an error, values are rounded to multiples of the
/// largest power of two that keeps it, so that their last bits are 0 and pack well.
template <int components, class Put>
VtkArray make_reals(std::string name, std::string dimension, std::size_t n, const RealFormat& format,
                    const Put& put);

/// The same, where the error is a part of the range (largest - smallest component) of the values.
template <int components, class Put>
VtkArray make_reals_of_range(std::string name, std::string dimension, std::size_t n, bool float64,
                             Real part_of_range, const Put& put);

/// The largest power of two that is at most 2 `error`: rounding to its multiples is off by `error` at most.
/// 0 where error is 0.
Real quantum_of(Real error);
/// The multiple of `quantum` nearest to a value; the value itself for 0 and for what is not finite.
Real rounded(Real value, Real quantum);

/// The values of a field, for entities `which`. eps: see FieldWriterOptions.
VtkArray copy_of(const FieldBase& field, const std::vector<Index>& which, bool float64, Real eps);
/// 0 ... n - 1
std::vector<Index> all_of(Index n);

// ---------------------------------------------------------------------------------------------------------

template <int components, class Put>
VtkArray make_reals(std::string name, std::string dimension, std::size_t n, const RealFormat& format,
                    const Put& put) {
  const Real quantum = quantum_of(format.error);
  const auto rounding = [&](std::size_t i, auto* to) {
    Real tuple[components];
    put(i, tuple);
    for (int k = 0; k < components; ++k)
      to[k] = static_cast<std::remove_pointer_t<decltype(to)>>(rounded(tuple[k], quantum));
  };
  const auto plain = [&](std::size_t i, auto* to) {
    Real tuple[components];
    put(i, tuple);
    for (int k = 0; k < components; ++k) to[k] = static_cast<std::remove_pointer_t<decltype(to)>>(tuple[k]);
  };
  const auto make = [&](const auto& fill) {
    return format.float64 ? make_array<double, components>(std::move(name), std::move(dimension), n, fill)
                          : make_array<float, components>(std::move(name), std::move(dimension), n, fill);
  };
  return quantum == 0 ? make(plain) : make(rounding);
}

template <int components, class Put>
VtkArray make_reals_of_range(std::string name, std::string dimension, std::size_t n, bool float64,
                             Real part_of_range, const Put& put) {
  RealFormat format{float64, 0};
  if (part_of_range > 0 && n > 0) {
    Real tuple[components];
    put(0, tuple);
    Real low = tuple[0], high = tuple[0];
    for (std::size_t i = 0; i < n; ++i) {
      put(i, tuple);
      for (int k = 0; k < components; ++k) low = std::min(low, tuple[k]), high = std::max(high, tuple[k]);
    }
    format.error = part_of_range * (high - low);
  }
  return make_reals<components>(std::move(name), std::move(dimension), n, format, put);
}

}  // namespace courant
