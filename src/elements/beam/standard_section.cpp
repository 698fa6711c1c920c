// Standard sections of beams.
#include "elements/beam/standard_section.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace courant {

namespace {

/// Cuts pieces into cells of four Gauss points, which integrate polynomials of the third degree exactly.
class Cutter {
 public:
  explicit Cutter(int refinement) : along_(2 * std::max(1, refinement)) {}

  /// A rectangle, cut along its longer side.
  void rectangle(Real s0, Real s1, Real t0, Real t1) {
    const bool wide = s1 - s0 > t1 - t0;
    rectangle(s0, s1, t0, t1, wide ? along_ : 1, wide ? 1 : along_);
  }
  void rectangle(Real s0, Real s1, Real t0, Real t1, int cells_s, int cells_t) {
    const Real ds = (s1 - s0) / cells_s, dt = (t1 - t0) / cells_t;
    for (int j = 0; j < cells_t; ++j)
      for (int i = 0; i < cells_s; ++i)
        for (const Real t : {-gauss, gauss})
          for (const Real s : {-gauss, gauss})
            out.push_back({s0 + ds * (i + 0.5 + 0.5 * s), t0 + dt * (j + 0.5 + 0.5 * t), ds * dt / 4});
  }
  /// Symmetric about s = 0, of width `below` at t0 and `above` at t1.
  void trapezoid(Real below, Real above, Real t0, Real t1) {
    const Real dt = (t1 - t0) / along_;
    for (int j = 0; j < along_; ++j)
      for (const Real at : {-gauss, gauss}) {
        const Real t = t0 + dt * (j + 0.5 + 0.5 * at);
        const Real width = below + (above - below) * (t - t0) / (t1 - t0);
        for (const Real s : {-gauss, gauss}) out.push_back({0.5 * width * s, t, width * dt / 4});
      }
  }
  /// Between two radii, or from the middle on; rings of the same thickness, each at its radius of gyration.
  void ring(Real inner, Real outer) {
    const int rings = inner > 0 ? along_ / 2 : along_, around = 4 * along_;
    for (int j = 0; j < rings; ++j) {
      const Real a = inner + (outer - inner) * j / rings, b = inner + (outer - inner) * (j + 1) / rings;
      const Real r = std::sqrt(0.5 * (a * a + b * b)), area = pi * (b * b - a * a) / around;
      for (int k = 0; k < around; ++k) {
        const Real angle = 2 * pi * (k + 0.5) / around;
        out.push_back({r * std::cos(angle), r * std::sin(angle), area});
      }
    }
  }
  int along() const { return along_; }

  std::vector<SectionCell> out{};

 private:
  static constexpr Real gauss = 0.57735026918962576451;  // sqrt(1/3)
  int along_;
};

/// 1 to 6. Half the width, half the depth; thicknesses of flange and web.
void cut_profile(int icst, Real w, Real d, Real tf, Real tw, Cutter& cut) {
  const bool lower = icst != 4, upper = icst != 3, z = icst == 6;
  const Real right_of_z = z ? tw / 2 : w, left_of_z = z ? -tw / 2 : -w;  // where its flanges end
  if (upper) cut.rectangle(-w, right_of_z, d - tf, d);
  if (lower) cut.rectangle(left_of_z, w, -d, -d + tf);
  const Real below = lower ? -d + tf : -d, above = upper ? d - tf : d;
  if (icst == 2 || icst == 3 || icst == 5) cut.rectangle(-w, -w + tw, below, above);
  if (icst == 5) cut.rectangle(w - tw, w, below, above);
  if (icst == 1 || icst == 4 || icst == 6) cut.rectangle(-tw / 2, tw / 2, below, above);
}

/// A rectangle: Roark's fit, within 0.5 % of the series.
Real torsion_of_rectangle(Real a, Real b) {
  const Real ratio = std::min(a, b) / std::max(a, b);
  const Real fit = 1.0 / 3 - 0.21 * ratio * (1 - std::pow(ratio, 4) / 12);
  return fit * std::max(a, b) * std::pow(std::min(a, b), 3);
}

void twist_and_shear(int icst, const std::array<Real, 4>& d, StandardSection& out) {
  const Real area = out.moments().area;
  out.shear = 5.0 / 6 * area;
  if (icst == 5) {
    const Real w = d[0] - d[3], h = d[2] - d[1];
    out.torsion = 2 * w * w * h * h / (w / d[1] + h / d[3]);
    out.shear = 2 * d[3] * d[2];
  } else if (icst <= 6) {
    const int flanges = icst == 3 || icst == 4 ? 1 : 2;
    out.torsion = (flanges * d[0] * std::pow(d[1], 3) + (d[2] - flanges * d[1]) * std::pow(d[3], 3)) / 3;
    out.shear = d[3] * d[2];
  } else if (icst == 7) {
    const auto m = out.moments();
    out.torsion = std::pow(area, 4) / (40 * (m.ss + m.tt));
  } else if (icst == 11) {
    out.torsion = torsion_of_rectangle(d[0], d[1]);
  } else {
    out.torsion = pi / 2 * (std::pow(d[0], 4) - (icst == 9 ? std::pow(d[1], 4) : 0));
    out.shear = (icst == 9 ? 0.5 : 0.9) * area;
  }
}

}  // namespace

StandardSection::Moments StandardSection::moments() const {
  Moments out;
  Real s = 0, t = 0;
  for (const SectionCell& cell : cells)
    out.area += cell.area, s += cell.area * cell.s, t += cell.area * cell.t;
  s /= out.area, t /= out.area;
  for (const SectionCell& cell : cells) {
    out.ss += cell.area * (cell.t - t) * (cell.t - t), out.tt += cell.area * (cell.s - s) * (cell.s - s);
    out.st += cell.area * (cell.s - s) * (cell.t - t);
  }
  return out;
}

StandardSection standard_section(int icst, const std::array<Real, 4>& d, int refinement, std::string& why) {
  Cutter cut(refinement);
  StandardSection out{.width_s = d[0], .width_t = d[2]};
  const auto refuse = [&](std::string text) {
    why = std::move(text);
    return StandardSection{};
  };
  if (icst >= 1 && icst <= 6) {
    const int flanges = icst == 3 || icst == 4 ? 1 : 2, webs = icst == 5 ? 2 : 1;
    if (!(d[1] > 0 && d[3] > 0 && flanges * d[1] < d[2] && webs * d[3] < d[0]))
      return refuse(
          fmt::format("W {:g}, TF {:g}, D {:g}, TW {:g} are no section: flanges must be thinner than "
                      "D, webs than W",
                      d[0], d[1], d[2], d[3]));
    cut_profile(icst, d[0] / 2, d[2] / 2, d[1], d[3], cut);
  } else if (icst == 7) {
    if (!(d[0] + d[1] > 0 && d[2] > 0)) return refuse("the trapezoid has no area");
    cut.trapezoid(d[0], d[1], -d[2] / 2, d[2] / 2);
    out.width_s = std::max(d[0], d[1]);
  } else if (icst == 8 || icst == 9) {
    const Real inner = icst == 9 ? d[1] : 0;
    if (!(d[0] > inner)) return refuse("the outer radius is not larger than the inner one");
    cut.ring(inner, d[0]);
    out.width_s = out.width_t = 2 * d[0];
  } else if (icst == 11) {
    if (!(d[0] > 0 && d[1] > 0)) return refuse("the box has no area");
    cut.rectangle(-d[0] / 2, d[0] / 2, -d[1] / 2, d[1] / 2, cut.along(), cut.along());
    out.width_t = d[1];
  } else {
    return refuse(fmt::format("'{}' is not supported: 1 to 9 and 11 are", icst));
  }
  out.cells = std::move(cut.out);
  twist_and_shear(icst, d, out);
  return out;
}

}  // namespace courant
