#pragma once
// Mass scaling: what elements weigh beyond their material, so that a longer step is stable.
#include <vector>

#include "keyword/deck.hpp"
#include "model/model.hpp"
#include "state/world.hpp"

namespace courant {

/// DT2MS and MS1ST of *CONTROL_TIMESTEP.
struct MassScaling {
  Real step = 0;        ///< |DT2MS|: what an element's own step, before TSSFAC, shall be; 0: no scaling [T]
  bool of_all = false;  ///< DT2MS > 0: at the start elements whose step is longer lose mass
  bool once = false;    ///< MS1ST 1: masses are those of the start
};
MassScaling mass_scaling_of(const Deck& deck);
/// Refuses what is not supported of it.
void check_mass_scaling(const Deck& deck, Diagnostics& diagnostics);

/// The masses of a group of elements, which grow with the square of what their step lacks: inertia, and the
/// viscosities that are measured by it, are those of a denser material, stress is not. Nodes of rigid bodies
/// get none once the run goes on; what no node gets counts as mass of no element, although the element is as
/// dense as if they had it.
class ScaledMass {
 public:
  /// Adds the fields `added_mass` of elements and nodes, and `inertial_mass`. `corner_inertia`: rotary
  /// inertia of shells for each corner, of which the nodes get more in the same ratio; null: solids. [ML2]
  ScaledMass(const MassScaling& rules, const ElementGroup& group, const Field<Real>* corner_inertia,
             World& world);
  /// Brings elements to the requested step; `wave_time`: the step that each has so far, without viscosity
  /// [T].
  void start(const std::vector<Real>& wave_time, World& world);
  void declare(const World& world, Accesses& a) const;
  /// Notes elements of a block that lack mass, and makes `step_limit` what it will be with it. Returns
  /// whether there are any. [T]
  bool look(Index begin, Index count, const Real* wave_time, Real* step_limit);
  /// On one thread, after all blocks: gives them the mass, and returns them. What comes with the velocity of
  /// a node counts as work from outside.
  const std::vector<Index>& grow(World& world);
  /// Density over that of the material. [-]
  Real ratio(Index e) const { return inertial_[e] / of_material(e); }
  Real added(Index e) const { return added_[e]; }  ///< to nodes [M]
  /// What corner c has of the mass of an element. [M]
  Real of_corner(Index e, int c) const {
    return of_material(e) * group_.share(e, c) + of_corners_.data(c)[e];
  }
  /// Of elements that were as dense all through, which is more than their nodes got. [M]
  const Field<Real>& inertial() const { return inertial_; }

 private:
  struct Lack {
    Index element;
    Real growth;  ///< new mass over old
  };
  void add(Index e, Real mass, bool started, World& world);
  Real of_material(Index e) const { return group_.mass[e] - added_[e]; }

  MassScaling rules_;
  const ElementGroup& group_;
  const Field<Real>* corner_inertia_;
  Field<Real>&added_, &of_corners_;  ///< to nodes, of each corner
  Field<Real>& inertial_;
  Field<Real>& of_nodes_;
  std::vector<std::vector<Lack>> lacks_;  ///< by block
  std::vector<Index> grown_;
};

/// Which of the values is the least; the first that is not a number, where there is one.
inline Index least_of(const Real* values, Index count) {
  Index at = 0;
  for (Index i = 1; i < count; ++i)
    if (!(values[i] >= values[at]) && values[at] == values[at]) at = i;
  return at;
}

/// Takes back what was added to nodes that give their mass to nothing, as those of rigid bodies with an
/// inertia of their own. Call before the run starts. `nodes`: indices into World::nodes.
void take_back_added_mass(const std::vector<Index>& nodes, World& world);

/// What was added to the elements of a group. [M]
Real added_mass(const ElementGroup& group);

/// Tells for each part what was added at the start, as warnings where it is more than a few per cent, and
/// where nothing can be scaled. Adds a pass that ends the run at ENDMAS of *CONTROL_TERMINATION.
void report_mass_scaling(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics);

}  // namespace courant
