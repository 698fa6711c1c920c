#pragma once
// Gauges: quantities that a run measures at positions of the deck, each at an interval of its own.
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "loads/body_acceleration.hpp"
#include "output/sample.hpp"
#include "search/neighbours.hpp"
#include "sph/kernel/kernel_choice.hpp"
#include "state/reports.hpp"

namespace courant {

struct GaugeBox {
  Vec low = Vec::Zero(), high = Vec::Zero();
  Real distance(const Vec& x) const { return (x - x.cwiseMax(low).cwiseMin(high)).norm(); }
};

/// What a gauge sees of the world at t^n.
struct GaugeView {
  const World& world;
  KernelChoice kernel;
  const std::vector<RigidBodyMotion>& bodies;
  std::span<const PointForce> forces{};  ///< where a gauge takes them
  BodyAcceleration::At loads{};
  bool uniform_loads = false;              ///< the same everywhere, for all parts
  std::span<const GhostPlane> periodic{};  ///< planes of which the far sides are near, too
  /// Kernel of particle i at a distance r. [1/L^dim]
  Real weight(Index i, Real r) const;
  /// The same for loops that know the kernel `k` of `with_kernel`.
  template <class Kernel>
  Real weight_of(Kernel k, Index i, Real r) const {
    const Real per_h = 1 / world.particles.h[i], R = r * per_h;
    if (R >= Kernel::support) return 0;
    return Kernel::C(world.dim) * k.shape(R) * (world.dim == 2 ? per_h * per_h : per_h * per_h * per_h);
  }
  Real reach(Index i) const { return kernel_support(kernel) * world.particles.h[i]; }
  Real volume(Index i) const { return world.particles.m[i] / world.particles.rho[i]; }
  /// Distance between particles of the size of particle i. [L]
  Real spacing(Index i) const;
  /// Position of particle i; in the plane without z.
  Vec position(Index i) const { return flat(world.particles.x.vec(i)); }
  Vec flat(const Vec& x) const { return world.dim == 2 ? Vec(x.x(), x.y(), 0) : x; }
};

/// A particle near a gauge, and its position there: beyond a periodic plane not that of its field. [L]
struct NearParticle {
  Index i;
  Vec x;
};

class Gauge {
 public:
  Gauge(GaugeLayout layout, Real interval) : layout_(std::move(layout)), interval_(interval) {}
  virtual ~Gauge() = default;
  const GaugeLayout& layout() const { return layout_; }
  Real interval() const { return interval_; }
  /// Appends boxes that hold all that the gauge measures; particles within a kernel's reach of them are near
  /// it. None: it needs no particles.
  virtual void cover(const GaugeView& view, std::vector<GaugeBox>& boxes) const = 0;
  virtual bool takes_forces() const { return false; }
  /// Values in the order of the columns of `layout`. `near`: of `particles_near`.
  virtual std::vector<Real> measure(const GaugeView& view, std::span<const NearParticle> near) const = 0;

 private:
  GaugeLayout layout_;
  Real interval_;
};

/// Active particles within their kernel's reach of any of the boxes, ascending; behind them those beyond
/// periodic planes.
std::vector<NearParticle> particles_near(const GaugeView& view, const Neighbours& neighbours,
                                         std::span<const GaugeBox> boxes);

/// A straight line from `begin` to `end` [L].
struct GaugeLine {
  Vec begin = Vec::Zero(), end = Vec::Zero();
  Real length() const { return (end - begin).norm(); }
  Vec direction() const { return (end - begin) / length(); }
  Vec at(Real s) const { return begin + s * direction(); }
  /// Boxes of pieces of the line, of about the length `piece`.
  void cover(Real piece, std::vector<GaugeBox>& boxes) const;
};

std::unique_ptr<Gauge> make_level_gauge(GaugeLayout layout, Real interval, const GaugeLine& line);
std::unique_ptr<Gauge> make_runup_gauge(GaugeLayout layout, Real interval, const GaugeLine& line);
/// `body`: index into the bodies with which the point moves; -1: none.
std::unique_ptr<Gauge> make_point_gauge(GaugeLayout layout, Real interval, const Vec& point, int body,
                                        const RigidBodyMotion& start);
/// In the plane `third` does not count.
std::unique_ptr<Gauge> make_flux_gauge(GaugeLayout layout, Real interval, int dim, const Vec& first,
                                       const Vec& second, const Vec& third);
/// `faces`: of each segment, whether it counts.
std::unique_ptr<Gauge> make_force_gauge(GaugeLayout layout, Real interval, std::vector<char> faces,
                                        const Vec& centre, const World& world);

/// All gauges of a deck. A pass of no phase: the run calls it when one of them is due.
class Gauges : public Pass {
 public:
  /// `neighbours`: of the particles; null: there are none.
  Gauges(std::vector<std::unique_ptr<Gauge>> gauges, KernelChoice kernel, BodyAcceleration loads,
         std::shared_ptr<const Neighbours> neighbours, std::vector<GhostPlane> periodic)
      : gauges_(std::move(gauges)),
        kernel_(kernel),
        loads_(std::move(loads)),
        neighbours_(std::move(neighbours)),
        periodic_(std::move(periodic)) {}
  std::string name() const override { return "gauges"; }
  const std::vector<std::unique_ptr<Gauge>>& all() const { return gauges_; }
  /// Those of the given indices, at t^n.
  std::vector<GaugeSample> measure(World& world, const Clock& clock,
                                   const std::vector<RigidBodyMotion>& bodies,
                                   const std::vector<std::size_t>& which) const;

 private:
  std::vector<std::unique_ptr<Gauge>> gauges_;
  KernelChoice kernel_;
  BodyAcceleration loads_;
  std::shared_ptr<const Neighbours> neighbours_;
  std::vector<GhostPlane> periodic_;
};

}  // namespace courant
