#pragma once
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "state/particle_loops.hpp"
#include "state/world.hpp"

namespace courant {

/// A symmetry or periodic plane, behind which particles have ghost particles.
struct GhostPlane {
  enum class Kind { mirror, periodic } kind = Kind::mirror;
  Vec point = Vec::Zero();   ///< on the plane [L]
  Vec normal = Vec::Zero();  ///< into the material, of length 1
  Real period = 0;           ///< periodic: the other plane is at point + period normal [L]
};

/// Distance from the plane, into the material [L].
inline Real depth(const GhostPlane& plane, Real x, Real y, Real z) {
  const Vec &n = plane.normal, &p = plane.point;
  return n[0] * (x - p[0]) + n[1] * (y - p[1]) + n[2] * (z - p[2]);
}
inline Real depth(const GhostPlane& plane, const Vec& x) {
  return depth(plane, x[0], x[1], x[2]);
}
/// Distances from the plane of the particles [begin, end), so that blocks of them far from it cost next to
/// nothing; within round-off of `depth`. [L]
ParticleLoops::Range depth_range(const ParticleLoops& loops, const GhostPlane& plane, const Particles& p,
                                 Index begin, Index end);

/// What loads give at a position, a time, to a part [L/T2]
using Acceleration = std::function<Vec(const Vec& x, Real t, Index part)>;

/// Neighbours that are no particles: they have no lists, and pair loops take them like any other. They are
/// behind all particles in the fields that are exchanged, from index particles.size() on.
class Ghosts : public Exchanger {
 public:
  /// Before sorting: brings back particles [0, n) that are outside of the scene.
  virtual void bring_back(World& /*world*/, Index /*n*/) {}
  /// Of each part, sum of mass times shift of the active particles that the last call brought back. [ML]
  virtual const std::map<Index, Vec>& brought_back() const {
    static const std::map<Index, Vec> none;
    return none;
  }
  /// Finds the ghosts that particles within `support` + `skin` may see, allocates them and sets their
  /// positions; nothing of earlier ghosts is kept. `first` is set, ghosts before it are sorted. [L]
  virtual void build(World& world, Real support, Real skin) = 0;
  virtual Index count() const = 0;
  /// The entity that is ghost 0: behind particles, and behind the ghosts that were given to Neighbours
  /// before.
  Index first() const { return first_; }
  void set_first(Index first) { first_ = first; }
  /// Puts ghost k at order[k]'s place.
  virtual void sort(World& world, std::span<const Index> order) = 0;
  /// The entity, a particle or a ghost before `first`, of which ghost k is a copy; -1: of none.
  virtual Index source(Index /*k*/) const { return -1; }
  /// How far any of them has moved by itself since `build`. [L]
  virtual Real largest_move(const World& /*world*/) const { return 0; }

 protected:
  /// Makes the fields long enough for these ghosts and those before them.
  void allocate(World& world) const {
    world.particles.fields.make_room_for_ghosts(first_ - world.particles.size() + count());
  }

 private:
  Index first_ = 0;
};

/// Ghost particles behind planes: neighbours that the pair loops take like any other. A particle within
/// reach of a mirror has a copy behind it with reflected velocity and stress; one near a periodic plane has a
/// copy beyond the other plane. A particle that has gone through a mirror changes places with its ghost,
/// which is the same flow; one that has gone through a periodic plane comes back at the other.
class GhostParticles : public Ghosts {
 public:
  /// Planes must be perpendicular to each other, or parallel and farther apart than particles reach.
  /// `of`: ghosts without a source, which have copies behind the planes instead of the particles.
  explicit GhostParticles(std::vector<GhostPlane> planes, std::shared_ptr<const Ghosts> of = nullptr);
  std::string name() const override { return of_ ? "copies of " + of_->name() : "ghost particles"; }

  /// A pass that reflects at the end of each step what went through a mirror in it; null without mirrors.
  /// `loads`: the acceleration of body loads [L/T2]. It pulled the whole path, towards the mirror and then
  /// away from it, where it would have turned round: the speed across the mirror gives back what that was too
  /// much.
  std::shared_ptr<Relocation> make_mirrors(Acceleration loads) const;
  void bring_back(World& world, Index n) override;
  /// Through periodic planes.
  const std::map<Index, Vec>& brought_back() const override { return brought_back_; }

  /// Ghosts of particles [0, moving), or of `of`. Throws RunError where h has grown so much that support
  /// reaches from one plane to the one opposite.
  void build(World& world, Real support, Real skin) override;
  Index count() const override { return static_cast<Index>(source_.size()); }
  Index source(Index k) const override { return source_[k]; }
  void sort(World& world, std::span<const Index> order) override;

  void exchange(World& world, std::span<const FieldBase* const> fields) override;
  void exchange_all(World& world) override;

 private:
  /// x -> A x + b for positions, A v for vectors, A S A^T for tensors.
  struct Motion {
    Matrix A = Matrix::Identity();
    Vec b = Vec::Zero();
    Motion after(const Motion& first) const { return {A * first.A, A * first.b + b}; }
    Vec of(const Vec& x) const { return A * x + b; }
  };
  /// Leaves in scratch_ those of entities [first, last) whose depth is wanted; no depth may be wanted between
  /// two that are not.
  template <class Wanted>
  void find(const GhostPlane& plane, const Particles& p, Index first, Index last, const Wanted& is_wanted);
  void copy_block(Field<Real>& field, bool place, Index begin, Index end) const;

  ParticleLoops loops_ = particle_loops();
  std::vector<GhostPlane> planes_;
  std::shared_ptr<const Ghosts> of_;    ///< null: copies are of particles
  Real narrowest_;                      ///< distance of planes that face each other; infinite if none do [L]
  std::vector<Motion> mirror_;          ///< of each plane; periodic ones: the shift by +period
  std::vector<Index> source_, motion_;  ///< of each ghost: the entity, and an index of motions_
  std::vector<Motion> motions_;         ///< the first one is none
  std::map<Index, Vec> brought_back_;
  std::vector<Index> scratch_;
};

}  // namespace courant
