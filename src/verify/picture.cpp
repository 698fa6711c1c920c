#include "verify/picture.hpp"

#include <fmt/format.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "verify/particle_states.hpp"

namespace courant {
namespace {

using Colour = std::array<unsigned char, 3>;

/// From dark to light, so that it reads without colours, too. value: 0 to 1.
Colour colour_of(Real value) {
  constexpr std::array<std::array<Real, 3>, 5> anchors = {
      {{58, 34, 104}, {44, 96, 148}, {32, 148, 136}, {116, 194, 82}, {248, 226, 66}}};
  const Real place = std::clamp(value, 0.0, 1.0) * (anchors.size() - 1);
  const auto k = std::min<std::size_t>(static_cast<std::size_t>(place), anchors.size() - 2);
  const Real share = place - static_cast<Real>(k);
  Colour out{};
  for (std::size_t c = 0; c < 3; ++c)
    out[c] =
        static_cast<unsigned char>(std::lround(anchors[k][c] + share * (anchors[k + 1][c] - anchors[k][c])));
  return out;
}

/// What is drawn: places in the plane of the picture, radius and value of each particle. shape of all: (n)
struct Dots {
  std::vector<Real> u, v, radius, value;
};

/// The two axes of the picture, the upright one last: those in which the particles extend most.
std::array<std::size_t, 2> axes_of(const std::array<std::vector<Real>, 3>& x) {
  std::array<Real, 3> extent{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [low, high] = std::minmax_element(x[k].begin(), x[k].end());
    extent[k] = *high - *low;
  }
  if (extent[2] == 0) return {0, 1};
  const auto least =
      static_cast<std::size_t>(std::min_element(extent.begin(), extent.end()) - extent.begin());
  if (least == 0) return {1, 2};
  return least == 1 ? std::array<std::size_t, 2>{0, 2} : std::array<std::size_t, 2>{0, 1};
}

class Canvas {
 public:
  explicit Canvas(const Dots& dots) {
    const Real r = *std::max_element(dots.radius.begin(), dots.radius.end());
    const auto [u0, u1] = std::minmax_element(dots.u.begin(), dots.u.end());
    const auto [v0, v1] = std::minmax_element(dots.v.begin(), dots.v.end());
    left_ = *u0 - r, top_ = *v1 + r;
    const Real across = *u1 - *u0 + 2 * r, upright = *v1 - *v0 + 2 * r;
    pixel_ = std::max(across / widest, upright / highest);
    width_ = std::max(1, static_cast<int>(std::ceil(across / pixel_)));
    height_ = std::max(1, static_cast<int>(std::ceil(upright / pixel_)));
    nearest_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_),
                    {std::numeric_limits<Real>::infinity(), -1});
    for (std::size_t i = 0; i < dots.u.size(); ++i) draw(dots, i);
  }

  std::string png(const Dots& dots, Real low, Real high) const {
    vtkNew<vtkImageData> image;
    image->SetDimensions(width_, height_, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    for (int row = 0; row < height_; ++row) {
      for (int column = 0; column < width_; ++column) {
        const Pixel& pixel = nearest_[at(column, row)];
        Colour colour{255, 255, 255};
        if (pixel.particle >= 0) {
          const Real value = dots.value[static_cast<std::size_t>(pixel.particle)];
          colour = colour_of(high > low ? (value - low) / (high - low) : 0.5);
        }
        auto* to = static_cast<unsigned char*>(image->GetScalarPointer(column, height_ - 1 - row, 0));
        std::copy(colour.begin(), colour.end(), to);  // VTK's rows go upwards
      }
    }
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputData(image);
    writer->WriteToMemoryOn();
    writer->Write();
    vtkUnsignedCharArray* bytes = writer->GetResult();
    if (!bytes) return {};
    return {reinterpret_cast<const char*>(bytes->GetPointer(0)),
            static_cast<std::size_t>(bytes->GetNumberOfValues())};
  }

 private:
  struct Pixel {
    Real distance2 = 0;
    int particle = -1;
  };
  static constexpr Real widest = 640, highest = 480;  // pixels

  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(column);
  }
  void draw(const Dots& dots, std::size_t i) {
    const Real u = (dots.u[i] - left_) / pixel_ - 0.5, v = (top_ - dots.v[i]) / pixel_ - 0.5;
    const Real r = std::max(0.75, dots.radius[i] / pixel_);
    const int first_row = std::max(0, static_cast<int>(std::ceil(v - r))),
              last_row = std::min(height_ - 1, static_cast<int>(std::floor(v + r))),
              first_column = std::max(0, static_cast<int>(std::ceil(u - r))),
              last_column = std::min(width_ - 1, static_cast<int>(std::floor(u + r)));
    for (int row = first_row; row <= last_row; ++row) {
      for (int column = first_column; column <= last_column; ++column) {
        const Real distance2 = (column - u) * (column - u) + (row - v) * (row - v);
        Pixel& pixel = nearest_[at(column, row)];
        if (distance2 <= r * r && distance2 < pixel.distance2) pixel = {distance2, static_cast<int>(i)};
      }
    }
  }

  Real left_ = 0, top_ = 0, pixel_ = 1;
  int width_ = 1, height_ = 1;
  std::vector<Pixel> nearest_;
};

/// Particles of the state that are to be seen.
Dots dots_of(const StateTable& state, Formula& of, Selection& where) {
  constexpr Real share_of_h = 0.75;  // just closes the gaps of a square lattice with h = dx
  std::array<std::vector<Real>, 3> x;
  Dots dots;
  for (std::size_t i = 0; i < state.size(); ++i) {
    const auto row = state.row(i);
    if (!where.counts(state, i, row.data())) continue;
    const Real value = of(row.data());
    if (!std::isfinite(value)) continue;
    for (std::size_t k = 0; k < 3; ++k) x[k].push_back(row[k]);
    dots.radius.push_back(share_of_h * state.length(i));
    dots.value.push_back(value);
  }
  if (dots.value.empty()) return dots;
  const auto [across, upright] = axes_of(x);
  dots.u = std::move(x[across]), dots.v = std::move(x[upright]);
  return dots;
}

}  // namespace

std::optional<ReportPicture> draw_particles(const SuiteCase& definition, const Variables& variables,
                                            const std::filesystem::path& folder) {
  Diagnostics faults;
  const std::vector<StateFiles> states = read_states(folder, faults);
  if (states.empty()) return std::nullopt;
  int index = static_cast<int>(states.size()) - 1;
  std::string why;
  if (!definition.picture_at.empty())
    index = nearest_state(states, constant_value(definition.picture_at, variables, why));
  if (index < 0) return std::nullopt;
  Formula of(definition.picture_of, particle_variables(), variables);
  Selection where(definition.picture_where, of, variables);
  if (!of.ok() || !where.ok()) return std::nullopt;
  StateTable::Used used{};
  note_used(of, used);
  note_used(where.formula(), used);
  const StateTable state(states[static_cast<std::size_t>(index)], used, false, faults);
  if (!faults.ok()) return std::nullopt;
  const Dots dots = dots_of(state, of, where);
  if (dots.value.empty()) return std::nullopt;
  const Real low = reduce("p01", dots.value, dots.radius), high = reduce("p99", dots.value, dots.radius);
  ReportPicture out;
  out.png = Canvas(dots).png(dots, low, high);
  if (out.png.empty()) return std::nullopt;
  out.title = fmt::format("{}, t = {:.4g}, {} particles",
                          definition.picture_title.empty() ? definition.picture_of : definition.picture_title,
                          state.t(), dots.value.size());
  out.low = fmt::format("{:.3g}", low), out.high = fmt::format("{:.3g}", high);
  return out;
}

}  // namespace courant
