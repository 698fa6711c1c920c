#include "elements/solid/mode_watch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

#include "laws/strength/left_cauchy_green.hpp"
#include "laws/strength/strength.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

constexpr int corners = 8;
using Corners = std::array<Vec, corners>;
using Modes = std::array<Vec, 7>;

/// Sums over the corners with the signs of xi, eta, zeta, eta zeta, zeta xi, xi eta, xi eta zeta.
Modes modes_of(const Corners& x) {
  Modes out;
  out.fill(Vec::Zero());
  for (std::size_t c = 0; c < x.size(); ++c) {
    const Real xi = c % 4 == 1 || c % 4 == 2 ? 1 : -1, eta = c % 4 >= 2 ? 1 : -1, zeta = c >= 4 ? 1 : -1;
    const std::array<Real, 7> sign{xi, eta, zeta, eta * zeta, zeta * xi, xi * eta, xi * eta * zeta};
    for (std::size_t m = 0; m < sign.size(); ++m) out[m] += sign[m] * x[c];
  }
  return out;
}

/// 64 times the derivatives of the volume by modes 1 to 6 (hexahedron_modes.hpp).
std::array<Vec, 6> volume_slopes(const Modes& a) {
  const auto face = [&](std::size_t i, std::size_t j) { return Vec(a[i].cross(a[j])); };
  return {face(1, 2) + face(5, 4) / 3,   face(2, 0) + face(3, 5) / 3,   face(0, 1) + face(4, 3) / 3,
          (face(2, 4) + face(5, 1)) / 3, (face(3, 2) + face(0, 5)) / 3, (face(1, 3) + face(4, 0)) / 3};
}

/// Axes of a brick and its half lengths along them, as hourglass control has them.
struct Brick {
  Matrix e;
  Vec l;
};
Brick brick_of(const Modes& a) {
  Brick out;
  out.e.col(0) = a[0].normalized();
  out.e.col(1) = (a[1] - a[1].dot(Vec(out.e.col(0))) * out.e.col(0)).normalized();
  out.e.col(2) = Vec(out.e.col(0)).cross(Vec(out.e.col(1)));
  for (int i = 0; i < 3; ++i) out.l[i] = 0.125 * a[static_cast<std::size_t>(i)].dot(Vec(out.e.col(i)));
  return out;
}

/// Mode m varies along the two other axes.
constexpr int next_axis(int m) {
  return (m + 1) % 3;
}

/// v w^T + w v^T as xx yy zz xy yz zx, and twice v^T S w of such a tensor.
Eigen::Matrix<Real, 1, 6> product(const Vec& v, const Vec& w) {
  Eigen::Matrix<Real, 1, 6> out;
  for (int k = 0; k < 3; ++k) {
    const int n = next_axis(k);
    out[k] = 2 * v[k] * w[k], out[3 + k] = v[k] * w[n] + v[n] * w[k];
  }
  return out;
}
Real contracted(const Eigen::Matrix<Real, 1, 6>& S, const Vec& v, const Vec& w) {
  Real out = 0;
  for (int k = 0; k < 3; ++k) {
    const int n = next_axis(k);
    out += S[k] * v[k] * w[k] + S[3 + k] * (v[k] * w[n] + v[n] * w[k]);
  }
  return out;
}

/// Elements of one part that are examined.
struct WatchedSolids {
  const ElementGroup& group;
  Id part;
  SolidControl material;
  bool stores;  ///< hourglass control is a stiffness
  const Field<Real>&internal, &hourglass;
  const Field<Real>* plastic;
  const Field<Index>* eroded;
  std::vector<Index> bricks{};                               ///< elements of eight different corners
  std::vector<Index> nodes{};                                ///< their nodes
  std::vector<std::array<std::uint32_t, corners>> corner{};  ///< of each brick, among `nodes`
  std::vector<Vec> start{};                                  ///< of `nodes`
  Real missing = 0, held = 0, kinetic = 0;                   ///< summed over the looks [ML2/T2]

  bool dead(Index e) const { return eroded && (*eroded)[e] != 0; }
  bool yielded(Index e) const { return plastic && (*plastic)[e] > 0; }
  void find_bricks(const World& world) {
    for (Index e = 0; e < group.size(); ++e) {
      std::set<Index> different;
      for (int c = 0; c < corners; ++c) different.insert(group.node.data(c)[e]);
      if (different.size() < corners) continue;
      bricks.push_back(e);
      nodes.insert(nodes.end(), different.begin(), different.end());
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    for (const Index e : bricks) {
      auto& of_brick = corner.emplace_back();
      for (std::size_t c = 0; c < of_brick.size(); ++c)
        of_brick[c] = static_cast<std::uint32_t>(
            std::lower_bound(nodes.begin(), nodes.end(), group.node.data(static_cast<int>(c))[e]) -
            nodes.begin());
    }
    for (const Index n : nodes) start.push_back(world.nodes.x.vec(n));
  }
  Corners at_start(std::size_t brick) const {
    Corners out;
    for (std::size_t c = 0; c < out.size(); ++c) out[c] = start[corner[brick][c]];
    return out;
  }
  Corners at(std::size_t brick, const World& world) const {
    Corners out;
    for (std::size_t c = 0; c < out.size(); ++c) out[c] = world.nodes.x.vec(nodes[corner[brick][c]]);
    return out;
  }
  /// Means at nodes over the bricks around them.
  std::vector<SecondGradient> at_nodes(const World& world) const {
    std::vector<SecondGradient> out(nodes.size(), SecondGradient::Zero());
    std::vector<Real> count(nodes.size(), 0);
    for (std::size_t b = 0; b < bricks.size(); ++b) {
      if (dead(bricks[b])) continue;
      const SecondGradient own = second_gradient(at_start(b), at(b, world));
      for (const std::uint32_t n : corner[b]) out[n] += own, count[n] += 1;
    }
    for (std::size_t n = 0; n < out.size(); ++n)
      if (count[n] > 0) out[n] /= count[n];
    return out;
  }
  /// One look.
  void examine(const World& world) {
    const std::vector<SecondGradient> gradient = at_nodes(world);
    Real lacks = 0, energy = 0, stored = 0;
    for (std::size_t b = 0; b < bricks.size(); ++b) {
      const Index e = bricks[b];
      if (dead(e) || yielded(e)) continue;
      SecondGradient mean = SecondGradient::Zero();
      for (const std::uint32_t n : corner[b]) mean += gradient[n] / corners;
      lacks += bending_energy(at_start(b), mean, material);
      if (stores) stored += hourglass[e];
    }
    Real motion = 0;
    for (Index e = 0; e < group.size(); ++e) {
      if (dead(e)) continue;
      energy += internal[e];
      for (int c = 0; c < corners; ++c)
        motion +=
            0.5 * group.mass[e] * group.share(e, c) * world.nodes.v.vec(group.node.data(c)[e]).squaredNorm();
    }
    if (!std::isfinite(lacks + energy + stored + motion)) return;
    missing += std::max(lacks - stored, Real(0));
    held += std::abs(energy) + std::abs(stored);
    kinetic += motion;
  }
  /// Where a part holds less than 1 % of its own motion, as blocks that slide or fly, only what is beyond all
  /// of that matters.
  Real share() const {
    constexpr Real negligible = 0.01, instead = 10;
    const Real of = held < negligible * kinetic ? instead * kinetic : held;
    return of > 0 ? missing / of : 0;
  }
};

/// What springs back at once: rubbers, too, which remember their stretches.
bool is_elastic(const StrengthLaw& law) {
  const auto history = law.history();
  return history.empty() || history.front().name == left_cauchy_green.name;
}

bool is_examined(const SolidPart& p) {
  const StrengthLaw* law = p.law.get();
  return law && p.formulation->points == 1 && !p.formulation->nodal_pressure && law->shear_modulus() > 0 &&
         !law->axes() && (is_elastic(*law) || plastic_strain_of(*law) >= 0);
}

class OfModes : public ShapeWatch {
 public:
  explicit OfModes(std::vector<WatchedSolids> parts) : parts_(std::move(parts)) {}
  std::string name() const override { return "hourglass modes of solids"; }

  void look(World& world, std::int64_t cycle) override {
    if (cycle < next_) return;
    next_ = cycle + steps_between;
    Real worst = 0;
    for (WatchedSolids& w : parts_) {
      w.examine(world);
      if (!(w.share() > worst)) continue;
      worst = w.share();
      world.maxima["unresisted_modes_part"] = static_cast<Real>(w.part);
    }
    world.maxima["unresisted_modes"] = worst;
  }
  void keep(Archive& archive) override {
    archive("next", next_);
    for (WatchedSolids& w : parts_) {
      const Archive::Group inside(archive, w.group.fields.name());
      archive("missing", w.missing);
      archive("held", w.held);
      archive("kinetic", w.kinetic);
    }
  }

 private:
  static constexpr std::int64_t steps_between = 100;
  std::vector<WatchedSolids> parts_;
  std::int64_t next_ = 0;
};

}  // namespace

SecondGradient second_gradient(const Corners& start, const Corners& now) {
  const Modes A = modes_of(start), a = modes_of(now);
  const std::array<Vec, 6> slope = volume_slopes(A);
  const Real V64 = A[0].dot(slope[0]) + A[3].dot(slope[3]);
  Matrix F = Matrix::Zero();  // mean deformation gradient
  for (std::size_t m = 0; m < slope.size(); ++m) F += a[m] * slope[m].transpose() / V64;
  const Brick before = brick_of(A);
  const Matrix back = before.e * brick_of(a).e.transpose();
  SecondGradient out = SecondGradient::Zero();
  for (int m = 0; m < 3; ++m) {
    const auto mode = static_cast<std::size_t>(3 + m);
    const int c = next_axis(m), d = next_axis(c);
    const Vec u = 0.125 * (back * (a[mode] - F * A[mode])) / (before.l[c] * before.l[d]);
    out += u * product(before.e.col(c), before.e.col(d));
  }
  return out;
}

Real bending_energy(const Corners& start, const SecondGradient& gradient, const SolidControl& material) {
  const Modes A = modes_of(start);
  const Brick brick = brick_of(A);
  const Vec& l = brick.l;
  Matrix q;  // amplitude of mode m along axis b
  for (int m = 0; m < 3; ++m) {
    const int c = next_axis(m), d = next_axis(c);
    for (int b = 0; b < 3; ++b)
      q(b, m) =
          l[c] * l[d] * contracted(brick.e.col(b).transpose() * gradient, brick.e.col(c), brick.e.col(d));
  }
  Real out = 0;
  for (int b = 0; b < 3; ++b) {
    const int c = next_axis(b), d = next_axis(c);
    const Real along_d = q(d, c) / l[d], along_c = q(c, d) / l[c], shear = q(b, b) / l[c] + q(c, c) / l[b];
    out += material.plate_modulus / 6 *
           (along_d * along_d + along_c * along_c + 2 * material.nu * along_d * along_c);
    out += material.G / 6 * shear * shear;
  }
  const std::array<Vec, 6> slope = volume_slopes(A);
  return out * (A[0].dot(slope[0]) + A[3].dot(slope[3])) / 64;
}

std::shared_ptr<ShapeWatch> make_mode_watch(const std::vector<SolidPart>& parts, World& world) {
  std::vector<WatchedSolids> watched;
  for (const auto& group : world.groups) {
    if (group->segment || group->corners() != corners) continue;
    const SolidPart& part = parts[static_cast<std::size_t>(group->part)];
    if (!is_examined(part)) continue;
    const auto field = [&](const std::string& name) {
      return dynamic_cast<const Field<Real>*>(group->fields.find(name));
    };
    const int plastic = plastic_strain_of(*part.law);
    const SolidControl control = control_of(part);
    WatchedSolids w{
        .group = *group,
        .part = world.part_ids[static_cast<std::size_t>(group->part)],
        .material = control,
        .stores = control.stiff(),
        .internal = *field("internal_energy"),
        .hourglass = *field("hourglass_energy"),
        .plastic = plastic < 0 ? nullptr : field(part.law->history()[static_cast<std::size_t>(plastic)].name),
        .eroded = shared_fields::eroded.find(group->fields)};
    w.find_bricks(world);
    if (!w.bricks.empty()) watched.push_back(std::move(w));
  }
  if (watched.empty()) return nullptr;
  return std::make_shared<OfModes>(std::move(watched));
}

}  // namespace courant
