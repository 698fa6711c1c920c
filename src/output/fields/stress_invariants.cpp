#include "output/fields/stress_invariants.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string_view>

#include "output/fields/vtk_arrays.hpp"

namespace courant {
namespace {

constexpr std::string_view stress = "stress";
using Tensor = std::array<Real, 6>;

bool is_stress(const VtkArray& array) {
  return array.components == 6 && array.dimension == "M/LT2" &&
         std::string_view(array.name).starts_with(stress);
}

std::vector<Tensor> tensors_of(const VtkArray& array) {
  const bool wide = std::string_view(array.type) == vtk_type<double>;
  const std::size_t width = wide ? sizeof(double) : sizeof(float);
  std::vector<Tensor> out(array.bytes.size() / (6 * width));
  const char* at = array.bytes.data();
  for (Tensor& t : out)
    for (Real& value : t) {
      float narrow = 0;
      if (wide)
        std::memcpy(&value, at, width);
      else
        std::memcpy(&narrow, at, width), value = narrow;
      at += width;
    }
  return out;
}

Real mises(const Tensor& t) {
  const auto square = [](Real a) { return a * a; };
  const Real differences = square(t[0] - t[1]) + square(t[1] - t[2]) + square(t[2] - t[0]);
  return std::sqrt(0.5 * differences + 3 * (square(t[3]) + square(t[4]) + square(t[5])));
}

std::array<Real, 3> principal(const Tensor& t) {
  Eigen::Matrix3d m;
  m << t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2];
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(m, Eigen::EigenvaluesOnly);
  const auto& values = solver.eigenvalues();
  return {values[2], values[1], values[0]};
}

}  // namespace

void add_stress_invariants(std::vector<VtkArray>& arrays) {
  std::vector<VtkArray> found;
  const auto add = [&](VtkArray array) {
    const auto same = [&](const VtkArray& one) { return one.name == array.name; };
    if (std::none_of(arrays.begin(), arrays.end(), same)) found.push_back(std::move(array));
  };
  for (const VtkArray& array : arrays) {
    if (!is_stress(array)) continue;
    const std::vector<Tensor> of = tensors_of(array);
    const std::string suffix = array.name.substr(stress.size());
    const RealFormat format{std::string_view(array.type) == vtk_type<double>};
    const auto make = [&]<int components>(const char* name, const auto& put) {
      add(make_reals<components>(name + suffix, array.dimension, of.size(), format, put));
    };
    make.template operator()<1>("von_mises", [&](std::size_t i, Real* to) { *to = mises(of[i]); });
    make.template operator()<1>(
        "pressure", [&](std::size_t i, Real* to) { *to = -(of[i][0] + of[i][1] + of[i][2]) / 3; });
    make.template operator()<3>("principal_stress", [&](std::size_t i, Real* to) {
      const std::array<Real, 3> values = principal(of[i]);
      std::copy(values.begin(), values.end(), to);
    });
  }
  std::move(found.begin(), found.end(), std::back_inserter(arrays));
}

}  // namespace courant
