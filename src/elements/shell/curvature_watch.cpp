#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "elements/shell/facets.hpp"
#include "state/shared_fields.hpp"

namespace courant {

namespace {

constexpr Real smooth = 0.7;  // cosine of the angle up to which neighbours are one surface, 45 degrees

/// Symmetric tensor of a surface: 11 22 12.
using Sheet = std::array<Real, 3>;

/// Shells of one group that are looked at.
struct Watched {
  const ElementGroup& group;
  const Field<Real>&stress, &thickness, &internal, &hourglass;
  const Field<Index>* eroded;
  std::vector<const Field<Real>*> plastic{};  ///< of the layers
  std::vector<Real> zeta, share;
  ElasticConstants elastic;
  Real second_moment = 0;  ///< of the thickness, over its third power
  std::size_t first = 0;   ///< of the shells of all groups

  bool yielded(Index e) const {
    return std::any_of(plastic.begin(), plastic.end(), [e](const auto* p) { return (*p)[e] > 0; });
  }
  /// Twice the energy per area of a curvature; of a moment. [M/T2]
  Real of_curvature(const Sheet& k, Real t) const {
    const Real nu = elastic.nu, D = elastic.E * second_moment * t * t * t / (1 - nu * nu);
    return D * (k[0] * k[0] + k[1] * k[1] + 2 * nu * k[0] * k[1] + 2 * (1 - nu) * k[2] * k[2]);
  }
  Real of_moment(Index e, Real t) const {
    Sheet m{};
    for (std::size_t layer = 0; layer < zeta.size(); ++layer)
      for (std::size_t k = 0; k < 3; ++k)
        m[k] += 0.5 * t * t * zeta[layer] * share[layer] *
                stress.data(at_layer(static_cast<int>(layer), k == 2 ? 3 : static_cast<int>(k)))[e];
    const Real nu = elastic.nu, EI = elastic.E * second_moment * t * t * t;
    return (m[0] * m[0] + m[1] * m[1] - 2 * nu * m[0] * m[1] + 2 * (1 + nu) * m[2] * m[2]) / EI;
  }
};

/// Linear, or elastic until it yields, with the same law in all layers.
bool is_looked_at(const ShellPart& p) {
  return p.law && !p.null && !p.full && !p.control.warps && p.control.shear_factor != 0 && !p.has_axes() &&
         p.laws.empty() && (p.law->history().empty() || plastic_strain_of(*p.law) >= 0);
}

class OfFacets : public ShapeWatch {
 public:
  OfFacets(std::vector<Watched> groups, const World& world) : groups_(std::move(groups)) {
    for (const Watched& w : groups_)
      for (Index e = 0; e < w.group.size(); ++e) {
        std::array<Index, 4> node;
        for (std::size_t c = 0; c < 4; ++c) node[c] = w.group.node.data(static_cast<int>(c))[e];
        corners_.push_back(node);
      }
    find_neighbours(world, normals(world));
    at_start_ = forms(world);
  }
  std::string name() const override { return "curvature of shells"; }

  void look(World& world, std::int64_t cycle) override {
    if (cycle < next_) return;
    next_ = cycle + steps_between;
    const std::vector<Sheet> now = forms(world);
    Real missing = 0, held = 0;
    for (const Watched& w : groups_)
      for (Index e = 0; e < w.group.size(); ++e) {
        held += w.internal[e] + w.hourglass[e];
        const std::size_t s = w.first + static_cast<std::size_t>(e);
        if (!inside_[s] || (w.eroded && (*w.eroded)[e] != 0) || w.yielded(e)) continue;
        const Real t = w.thickness[e];
        Sheet change;
        for (std::size_t k = 0; k < 3; ++k) change[k] = now[s][k] - at_start_[s][k];
        const Bent bent = bent_by(world, s, change);
        missing += 0.5 * bent.area * (w.of_curvature(bent.curvature, t) - w.of_moment(e, t));
      }
    if (!std::isfinite(missing)) return;
    missing_ += missing, held_ += held, scene_ += world.energy.scale();
    constexpr Real least = 1e-3;  // of the scene's energy: what is less does no harm
    const bool counts = held_ > 0 && missing_ > least * scene_;
    world.maxima["unresisted_curvature"] = counts ? missing_ / held_ : 0;
  }
  void keep(Archive& archive) override {
    archive("next", next_);
    archive("missing", missing_);
    archive("held", held_);
    archive("scene", scene_);
  }

 private:
  struct Bent {
    Real area;
    Sheet curvature;  ///< in orthogonal axes
  };
  /// Derivatives by the natural coordinates, -1 to 1, in the middle.
  static std::array<Vec, 2> slopes(const std::array<Vec, 4>& v) {
    return {0.25 * (v[1] + v[2] - v[0] - v[3]), 0.25 * (v[2] + v[3] - v[0] - v[1])};
  }
  std::array<Vec, 4> places(const World& world, std::size_t s) const {
    std::array<Vec, 4> x;
    for (std::size_t c = 0; c < 4; ++c) x[c] = world.nodes.x.vec(corners_[s][c]);
    return x;
  }
  /// Of length of twice the area.
  std::vector<Vec> normals(const World& world) const {
    std::vector<Vec> out;
    for (std::size_t s = 0; s < corners_.size(); ++s) {
      const auto x = places(world, s);
      out.emplace_back((x[2] - x[0]).cross(x[3] - x[1]));
    }
    return out;
  }
  void find_neighbours(const World& world, const std::vector<Vec>& normal) {
    std::vector<std::vector<std::uint32_t>> at(static_cast<std::size_t>(world.nodes.size()));
    for (std::size_t s = 0; s < corners_.size(); ++s)
      for (const Index n : corners_[s])
        at[static_cast<std::size_t>(n)].push_back(static_cast<std::uint32_t>(s));
    std::vector<std::uint32_t> met;  // at the corners of a shell
    for (std::size_t s = 0; s < corners_.size(); ++s) {
      met.clear();
      for (const Index n : corners_[s]) {
        for (const std::uint32_t other : at[static_cast<std::size_t>(n)]) {
          const Real cosine = normal[s].dot(normal[other]) / (normal[s].norm() * normal[other].norm());
          if (!(std::abs(cosine) > smooth)) continue;
          neighbour_.push_back({other, cosine > 0});
          met.push_back(other);
        }
        end_.push_back(neighbour_.size());
      }
      std::sort(met.begin(), met.end());
      int sides = 0;  // shared with another: two corners
      for (std::size_t k = 1, run = 1; k <= met.size(); ++k)
        if (k < met.size() && met[k] == met[k - 1])
          ++run;
        else
          sides += std::exchange(run, 1) == 2;
      inside_.push_back(sides >= 4);
    }
  }
  /// Second fundamental form of each shell by the mean normals of its corners, in natural coordinates.
  std::vector<Sheet> forms(const World& world) const {
    const std::vector<Vec> normal = normals(world);
    std::vector<Sheet> out;
    std::size_t k = 0;
    for (std::size_t s = 0; s < corners_.size(); ++s) {
      std::array<Vec, 4> n;
      for (std::size_t c = 0; c < 4; ++c) {
        Vec sum = Vec::Zero();
        for (; k < end_[4 * s + c]; ++k)
          sum += neighbour_[k].alike ? normal[neighbour_[k].shell] : Vec(-normal[neighbour_[k].shell]);
        n[c] = sum.normalized();
      }
      const auto dn = slopes(n), dx = slopes(places(world, s));
      out.push_back({-dn[0].dot(dx[0]), -dn[1].dot(dx[1]), -0.5 * (dn[0].dot(dx[1]) + dn[1].dot(dx[0]))});
    }
    return out;
  }
  /// A change of the form, in orthogonal axes of the shell.
  Bent bent_by(const World& world, std::size_t s, const Sheet& b) const {
    const auto x = places(world, s);
    const auto dx = slopes(x);
    const Real a = dx[0].norm(), c = dx[0].dot(dx[1]) / a, d = dx[0].cross(dx[1]).norm() / a;
    // with e1 along dx[0]: dx[0] = a e1, dx[1] = c e1 + d e2
    const Real k11 = b[0] / (a * a), k12 = (b[2] - c * a * k11) / (a * d),
               k22 = (b[1] - c * c * k11 - 2 * c * d * k12) / (d * d);
    return {4 * a * d, {k11, k22, k12}};
  }

  struct Neighbour {
    std::uint32_t shell;
    bool alike;  ///< its normal points to the same side
  };
  static constexpr std::int64_t steps_between = 100;
  std::vector<Watched> groups_;
  std::vector<std::array<Index, 4>> corners_;
  std::vector<Neighbour> neighbour_;  ///< of each corner of each shell in turn, itself among them
  std::vector<std::size_t> end_;      ///< where those of corner c of shell s end, at 4 s + c
  std::vector<bool> inside_;          ///< shells with a smooth neighbour on each side
  std::vector<Sheet> at_start_;
  std::int64_t next_ = 0;
  Real missing_ = 0, held_ = 0, scene_ = 0;  ///< summed over the looks [ML2/T2]
};

}  // namespace

std::shared_ptr<ShapeWatch> make_curvature_watch(const std::vector<ShellPart>& parts, World& world) {
  std::vector<Watched> groups;
  std::size_t first = 0;
  for (const auto& group : world.groups) {
    if (!group->segment || !group->pushes || group->corners() != 4) continue;
    const ShellPart& part = parts[static_cast<std::size_t>(group->part)].of(group->layup);
    if (!is_looked_at(part)) continue;
    const auto energy = [&](const char* name) -> const Field<Real>& {
      return dynamic_cast<const Field<Real>&>(*group->fields.find(name));
    };
    Watched w{.group = *group,
              .stress = layer_stress_of(*group, static_cast<int>(part.zeta.size())),
              .thickness = thickness_of_shells(*group),
              .internal = energy("internal_energy"),
              .hourglass = energy("hourglass_energy"),
              .eroded = shared_fields::eroded.find(group->fields),
              .zeta = part.zeta,
              .share = part.share,
              .elastic = elastic_constants(part),
              .first = first};
    for (std::size_t k = 0; k < part.zeta.size(); ++k) {
      w.second_moment += 0.25 * part.share[k] * part.zeta[k] * part.zeta[k];
      if (const int plastic = plastic_strain_of(*part.law); plastic >= 0)
        w.plastic.push_back(&layer_history_of(*group, part.law->history()[static_cast<std::size_t>(plastic)],
                                              static_cast<int>(k)));
    }
    if (!(w.second_moment > 0)) continue;
    first += static_cast<std::size_t>(group->size());
    groups.push_back(std::move(w));
  }
  if (groups.empty()) return nullptr;
  return std::make_shared<OfFacets>(std::move(groups), world);
}

}  // namespace courant
