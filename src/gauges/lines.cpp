// Gauges along lines: the surface of the water, and how far it is up a wall.
#include <algorithm>
#include <cmath>
#include <limits>

#include "gauges/gauge.hpp"

namespace courant {

namespace {

constexpr Real nothing = std::numeric_limits<Real>::quiet_NaN();

std::vector<Real> on_line(const GaugeLine& line, Real wet, Real s) {
  const Vec x = line.at(s);
  return {wet, s, x.x(), x.y(), x.z()};
}
std::vector<Real> dry() {
  return {0, nothing, nothing, nothing, nothing};
}

class LineGauge : public Gauge {
 public:
  LineGauge(GaugeLayout layout, Real interval, const GaugeLine& line)
      : Gauge(std::move(layout), interval), line_(line) {}
  void cover(const GaugeView& view, std::vector<GaugeBox>& boxes) const override {
    const Index n = view.world.particles.active;
    line_.cover(n > 0 ? view.reach(0) : line_.length(), boxes);
  }

 protected:
  GaugeLine line_;
};

/// The surface is where the colour C = sum V W falls to half of what it is below: 1/2 in the open, less at
/// walls, which cut the kernel all along the line.
class LevelGauge : public LineGauge {
 public:
  using LineGauge::LineGauge;
  std::vector<Real> measure(const GaugeView& view, std::span<const NearParticle> near) const override {
    const Profile profile = colour(view, near);
    const auto last = static_cast<std::ptrdiff_t>(profile.colour.size()) - 1;
    for (std::ptrdiff_t k = last; k >= 0; --k) {
      const Real limit = threshold(view, profile, k);
      if (!(at(profile.colour, k) >= limit)) continue;
      if (!is_thick(view, profile, k)) continue;
      if (k == last) return on_line(line_, 2, line_.length());
      const Real a = at(profile.colour, k), b = at(profile.colour, k + 1);
      const Real between = a > b ? std::clamp((a - limit) / (a - b), Real(0), Real(1)) : 0;
      return on_line(line_, 1, (static_cast<Real>(k) + between) * profile.step);
    }
    return dry();
  }

 private:
  struct Profile {
    Real step = 0, h = 0;      ///< [L]
    std::vector<Real> colour;  ///< from the start of the line on
    std::vector<int> count;    ///< particles that add to it
  };
  static Real at(const std::vector<Real>& values, std::ptrdiff_t k) {
    return values[static_cast<std::size_t>(k)];
  }
  Profile colour(const GaugeView& view, std::span<const NearParticle> near) const {
    constexpr Real steps_per_h = 16, most = 1e6;
    Profile out;
    for (const auto& [i, x] : near) out.h = std::max(out.h, view.world.particles.h[i]);
    if (out.h == 0) return out;
    const Real steps = std::clamp<Real>(std::ceil(line_.length() * steps_per_h / out.h), 1, most);
    out.step = line_.length() / steps;
    out.colour.assign(static_cast<std::size_t>(steps) + 1, 0);
    out.count.assign(out.colour.size(), 0);
    for (const auto& [i, x] : near) {
      const Vec d = x - line_.begin;
      const Real along = d.dot(line_.direction()), aside = (d - along * line_.direction()).norm();
      const Real reach = view.reach(i);
      if (aside >= reach) continue;
      const Real half = std::sqrt(reach * reach - aside * aside);
      const Real from = std::max<Real>(0, std::ceil((along - half) / out.step));
      const Real to = std::min(steps, std::floor((along + half) / out.step));
      for (Real k = from; k <= to; k += 1) {
        const auto n = static_cast<std::size_t>(k);
        out.colour[n] += view.volume(i) * view.weight(i, std::hypot(aside, k * out.step - along));
        ++out.count[n];
      }
    }
    return out;
  }
  /// Half the largest colour within a kernel's reach below; infinite where only spray is there.
  static Real threshold(const GaugeView& view, const Profile& profile, std::ptrdiff_t k) {
    const int span = view.world.dim == 2 ? 4 : 8;  // particles, fewer are spray
    constexpr Real least = 0.2;
    const auto below = static_cast<std::ptrdiff_t>(kernel_support(view.kernel) * profile.h / profile.step);
    Real most = 0;
    for (std::ptrdiff_t j = std::max<std::ptrdiff_t>(0, k - below); j <= k; ++j)
      if (profile.count[static_cast<std::size_t>(j)] >= span) most = std::max(most, at(profile.colour, j));
    return most >= least ? 0.5 * std::min(most, Real(1)) : std::numeric_limits<Real>::infinity();
  }
  /// Water that reaches half an h down, or to the start of the line.
  static bool is_thick(const GaugeView& view, const Profile& profile, std::ptrdiff_t k) {
    const auto thick = static_cast<std::ptrdiff_t>(0.5 * profile.h / profile.step);
    for (std::ptrdiff_t j = k; j >= std::max<std::ptrdiff_t>(0, k - thick); --j)
      if (!(at(profile.colour, j) >= threshold(view, profile, j))) return false;
    return true;
  }
};

/// The end of the row of particles that begins at the first one along the line: those within a spacing of the
/// line, each as long as its spacing. A gap of a kernel's reach ends the row; beyond it is spray.
class RunupGauge : public LineGauge {
 public:
  using LineGauge::LineGauge;
  std::vector<Real> measure(const GaugeView& view, std::span<const NearParticle> near) const override {
    struct Piece {
      Real from, to, gap;
    };
    std::vector<Piece> pieces;
    for (const auto& [i, x] : near) {
      const Vec d = x - line_.begin;
      const Real along = d.dot(line_.direction()), dx = view.spacing(i);
      if ((d - along * line_.direction()).norm() > dx) continue;
      if (along < -0.5 * dx || along > line_.length() + 0.5 * dx) continue;
      pieces.push_back({along - 0.5 * dx, along + 0.5 * dx, view.reach(i)});
    }
    if (pieces.empty()) return dry();
    std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.from < b.from; });
    Real end = pieces.front().to;
    for (const Piece& piece : pieces) {
      if (piece.from > end + piece.gap) break;
      end = std::max(end, piece.to);
    }
    return on_line(line_, end >= line_.length() ? 2 : 1, std::clamp<Real>(end, 0, line_.length()));
  }
};

GaugeLayout with_columns(GaugeLayout layout) {
  layout.columns = {{"wet", "-", 1}, {"level", "L", 1}, {"position", "L", 3}};
  return layout;
}

}  // namespace

std::unique_ptr<Gauge> make_level_gauge(GaugeLayout layout, Real interval, const GaugeLine& line) {
  return std::make_unique<LevelGauge>(with_columns(std::move(layout)), interval, line);
}
std::unique_ptr<Gauge> make_runup_gauge(GaugeLayout layout, Real interval, const GaugeLine& line) {
  return std::make_unique<RunupGauge>(with_columns(std::move(layout)), interval, line);
}

}  // namespace courant
