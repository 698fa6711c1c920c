#include "output/fields/vtk_arrays.hpp"

#include <array>
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
  if (info.components != 1) throw std::logic_error("field '" + info.name + "' has more than one component");
  return make_array<T, 1>(info.name, info.dimension, which.size(),
                          [from = field.data(), &which](std::size_t i, T* to) { *to = from[which[i]]; });
}

template <int components>
VtkArray reals(const Field<Real>& field, const std::vector<Index>& which, bool float64, Real eps) {
  std::array<const Real*, components> from;
  for (int k = 0; k < components; ++k) from[static_cast<std::size_t>(k)] = field.data(k);
  return make_reals_of_range<components>(field.info().name, field.info().dimension, which.size(), float64,
                                         eps, [from, index = which.data()](std::size_t i, Real* to) {
                                           for (std::size_t k = 0; k < components; ++k)
                                             to[k] = from[k][index[i]];
                                         });
}

}  // namespace

VtkArray copy_of(const FieldBase& field, const std::vector<Index>& which, bool float64, Real eps) {
  const FieldInfo& info = field.info();
  if (const auto* values = dynamic_cast<const Field<Real>*>(&field)) {
    if (info.components == 1) return reals<1>(*values, which, float64, eps);
    if (info.components == 3) return reals<3>(*values, which, float64, eps);
    if (info.components == 6) return reals<6>(*values, which, float64, eps);
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
