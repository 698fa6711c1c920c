#pragma once
// *LOAD_BODY and *LOAD_GRAVITY_PART: an acceleration over position, time and part.
#include <memory>
#include <span>
#include <vector>

#include "keyword/deck.hpp"
#include "model/model.hpp"

namespace courant {

/// The sum of all body loads, and its potential: a = -grad of it at each time. A load on parts acts on
/// nothing that belongs to no part (part < 0). Cheap to copy.
class BodyAcceleration {
 public:
  /// The loads at one time, so that a loop evaluates curves once. Also the difference of two times.
  class At {
   public:
    /// [L/T2]
    Vec operator()(const Vec& x, Index part) const;
    /// [L2/T2], 0 at the origin for translations and on the axis of rotations
    Real potential(const Vec& x, Index part) const;
    /// Of the potential from `x` to `x + step`; what is far from the origin loses no digits. [L2/T2]
    Real rise(const Vec& x, const Vec& step, Index part) const;
    /// The part that is the same everywhere: all of it where the loads are uniform. [L/T2]
    const Vec& everywhere() const { return everywhere_; }
    bool zero() const;

   private:
    friend class BodyAcceleration;
    struct Term {
      const BodyLoad* load;
      Vec a = Vec::Zero();  ///< of a translation [L/T2]
      Real omega2 = 0;      ///< of a rotation [1/T2]
    };
    static bool acts(const Term& term, Index part);
    std::shared_ptr<const std::vector<BodyLoad>> loads_;
    Vec everywhere_ = Vec::Zero();
    std::vector<Term> terms_;  ///< rotations, and translations of some of the parts
  };

  BodyAcceleration() : BodyAcceleration(std::vector<BodyLoad>()) {}
  explicit BodyAcceleration(std::vector<BodyLoad> loads);

  /// The same as those see it who belong to these parts: a load that acts on all of them counts as one on
  /// everything, one that acts on none of them does not count.
  BodyAcceleration on(std::span<const Index> parts) const;
  /// Without the component along a unit vector.
  BodyAcceleration without(const Vec& normal) const;

  bool none() const { return loads_->empty(); }
  /// Whether it depends on time alone.
  bool uniform() const { return uniform_; }

  /// Whether parts differ.
  bool by_parts() const;

  At at(Real t) const;
  /// at(to) - at(from): its potential times mass is the work from outside between these times.
  At change(Real from, Real to) const;
  Vec operator()(const Vec& x, Real t, Index part) const { return at(t)(x, part); }
  Real potential(const Vec& x, Real t, Index part) const { return at(t).potential(x, part); }

 private:
  std::shared_ptr<const std::vector<BodyLoad>> loads_;
  std::vector<Vec> normals_;  ///< along which there is none
  bool uniform_ = true;
};

/// The body loads of a model as its particles see them.
BodyAcceleration acceleration_of_particles(const Model& model);

/// Refuses rotations that turn a 2D scene out of its plane, and warns of loads along z, which do nothing
/// there.
void check_body_loads_2d(const Deck& deck, Diagnostics& diagnostics);
/// Refuses rotations whose acceleration is not the same again a period on: those about another axis than
/// along `normal`, that of a periodic plane.
void check_body_loads_periodic(const Deck& deck, const Vec& normal, Diagnostics& diagnostics);

}  // namespace courant
