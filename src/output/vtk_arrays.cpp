#include "output/vtk_arrays.hpp"

#include <cmath>
#include <numeric>
#include <stdexcept>

namespace courant {

Real quantum_of(Real error) {
  if (!(error > 0) || !std::isfinite(error)) return 0;
  return std::exp2(std::floor(std::log2(2 * error)));
}

Real rounded(Real value, Real quantum) {
  if (quantum == 0 || !std::isfinite(value)) return value;
  return std::round(value / quantum) * quantum + 0.0;  // no -0
}

namespace {

template <class T>
VtkArray whole_numbers(const Field<T>& field, const std::vector<Index>& which) {
  const FieldInfo& info = field.info();
  return make_array<T>(info.name, info.components, info.dimension, which.size(), [&](std::size_t i, T* to) {
    for (int k = 0; k < info.components; ++k) to[k] = field.data(k)[which[i]];
  });
}

}  // namespace

VtkArray copy_of(const FieldBase& field, const std::vector<Index>& which, bool float64, Real eps) {
  const FieldInfo& info = field.info();
  if (const auto* reals = dynamic_cast<const Field<Real>*>(&field)) {
    const Real* from[6] = {};
    for (int k = 0; k < info.components; ++k) from[k] = reals->data(k);
    return make_reals_of_range(info.name, info.components, info.dimension, which.size(), float64, eps,
                               [&](std::size_t i, Real* to) {
                                 for (int k = 0; k < info.components; ++k) to[k] = from[k][which[i]];
                               });
  }
  if (const auto* ids = dynamic_cast<const Field<Id>*>(&field)) return whole_numbers(*ids, which);
  if (const auto* indices = dynamic_cast<const Field<Index>*>(&field)) return whole_numbers(*indices, which);
  throw std::logic_error("field '" + info.name + "' has a type the field files do not know");
}

std::vector<Index> all_of(Index n) {
  std::vector<Index> out(static_cast<std::size_t>(n));
  std::iota(out.begin(), out.end(), 0);
  return out;
}

}  // namespace courant
