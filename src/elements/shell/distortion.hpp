#pragma once
// Options of CONTROL_SHELL beside the loops: shells that turn inwards, and thickness by flow alone.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "elements/erosion.hpp"
#include "elements/shell/shell_loops.hpp"
#include "elements/shell/shells.hpp"

namespace courant {

/// Whether the area of a quadrilateral, seen along its normal, is turned inwards: at a corner, or with 2 x 2
/// points at one of these.
inline bool turns_inwards(const std::array<Vec, 4>& x, bool at_points) {
  const Vec n = Vec(x[2] - x[0]).cross(Vec(x[3] - x[1]));
  std::array<Real, 4> corner{};  // n times the Jacobian
  for (std::size_t c = 0; c < 4; ++c)
    corner[c] = Vec(x[(c + 1) % 4] - x[c]).cross(Vec(x[(c + 3) % 4] - x[c])).dot(n);
  const Real near = 0.25 * (1 + 1 / std::sqrt(3.0)) * (1 + 1 / std::sqrt(3.0)), beside = 1.0 / 6,
             far = 0.25 * (1 - 1 / std::sqrt(3.0)) * (1 - 1 / std::sqrt(3.0));
  for (std::size_t c = 0; c < 4; ++c) {
    const Real at_point =
        near * corner[c] + beside * (corner[(c + 1) % 4] + corner[(c + 3) % 4]) + far * corner[(c + 2) % 4];
    if (!((at_points ? at_point : corner[c]) > 0)) return true;
  }
  return false;
}

/// NFAIL1, NFAIL4: of each block of quadrilaterals, which are deleted and which stop the run. With 2 x 2
/// points one that is turned inwards has no meaning, whatever the deck asks for.
class DistortionWatch {
 public:
  DistortionWatch(DistortedShells asked, int corners, bool full)
      : asked_(asked), looks_(corners == 4 && (full || asked != DistortedShells::stay)), full_(full) {}
  bool full() const { return full_; }
  void start(std::size_t blocks) { stops_.assign(looks_ ? blocks : 0, -1); }
  void look(Index begin, Index count, const ShellMesh& mesh, const ShellScratch& scratch, Erosion* erosion) {
    for (Index i = 0; looks_ && i < count; ++i) {
      const Index e = begin + i;
      if ((erosion && erosion->dead(e)) || !inwards(e, i, mesh, scratch)) continue;
      if (asked_ == DistortedShells::deleted)
        erosion->fail(begin, e, "it is distorted");
      else
        stops_[static_cast<std::size_t>(begin / block_size)] = e;
    }
  }
  /// One that stops the run; -1: none.
  Index found() const {
    const auto at = std::find_if(stops_.begin(), stops_.end(), [](Index e) { return e >= 0; });
    return at == stops_.end() ? -1 : *at;
  }

 private:
  bool inwards(Index e, Index i, const ShellMesh& mesh, const ShellScratch& s) const {
    if (full_)
      return !(std::min({s.quarter_area[0][i], s.quarter_area[1][i], s.quarter_area[2][i],
                         s.quarter_area[3][i]}) > 0);
    std::array<Vec, 4> x;
    for (std::size_t c = 0; c < 4; ++c)
      for (int k = 0; k < 3; ++k) x[c][k] = mesh.x[k][mesh.corner[c][e]];
    return turns_inwards(x, false);
  }

  DistortedShells asked_;
  bool looks_, full_;
  std::vector<Index> stops_;
};

/// ISTUPD 4: of the strain through the thickness what flow makes. Hooke's law of a plane stress has
/// -nu/E (s_xx + s_yy) of it; laws without a plastic strain have all, but those that stiffen.
class FlowThinning {
 public:
  void before(const PointBlock& points) {
    for (Index i = 0; i < points.count; ++i) stress_[i] = points.stress[0][i] + points.stress[1][i];
  }
  /// `rate_zz` of all strain becomes that of the flow. [1/T]
  void after(const PointBlock& points, const StrengthLaw& law, bool flows, Real* rate_zz) const {
    if (!flows && law.stiffens()) return;
    const ElasticConstants elastic = elastic_constants(law);
    const Real per_stress = flows && points.dt > 0 ? elastic.nu / (elastic.E * points.dt) : 0;
    for (Index i = 0; i < points.count; ++i) {
      const Real change = points.stress[0][i] + points.stress[1][i] - stress_[i];
      rate_zz[i] = flows ? rate_zz[i] + per_stress * change : 0;
    }
  }

 private:
  Real stress_[block_size];
};

}  // namespace courant
