#pragma once
// Inertia of nodes that go exactly where others, their carriers, take them.
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "state/world.hpp"

namespace courant {

/// How nodes are carried.
struct Carriage {
  /// After a step: where a carried node is, and the velocities that took it there.
  struct Chord {
    Vec x = Vec::Zero(), v = Vec::Zero(), spin = Vec::Zero();
  };
  /// Velocities of a carried node where one carrier alone moves: B v, W v.
  struct Rate {
    Matrix B = Matrix::Zero(), W = Matrix::Zero();
  };
  virtual ~Carriage() = default;
  virtual std::size_t size() const = 0;
  virtual Index node(std::size_t i) const = 0;
  virtual std::span<const Index> carriers(std::size_t i) const = 0;
  /// Of the mass of a carried node, which World::nodes has at the carriers. The sum is 1. [-]
  virtual std::span<const Real> shares(std::size_t i) const = 0;
  /// Whether it is still carried.
  virtual bool holds(const World& /*world*/, std::size_t /*i*/) const { return true; }
  /// Whether its inertia counts where it is; else the masses of World::nodes are all there is.
  virtual bool weighs(const World& /*world*/, std::size_t /*i*/) const { return true; }
  /// Whether W counts: no carrier has a rotation that the carried node follows.
  virtual bool spins(std::size_t /*i*/) const { return false; }
  /// At t^n, of each carrier.
  virtual void rates(const World& world, std::size_t i, std::span<Rate> out) const = 0;
  /// The carriers are at x after a step dt with the velocities v; the carried node is where it was.
  virtual Chord chord(const World& world, std::size_t i, std::span<const Vec> x, std::span<const Vec> v,
                      Real dt) const = 0;
};

/// The momentum of each carried node is its mass times the velocity that it really has, the chord of the
/// step. Carriers get what that changes beyond its own forces:
///   m_k (v_k^{n+1/2} - v_k^{n-1/2}) = dt f_k + sum_s B_sk^T (dt f_s - m_s (v_s^{n+1/2} - v_s^{n-1/2})),
/// v_s that of the motion of the carriers in this very step. B^T keeps sums of forces and moments, so that
/// momentum and angular momentum change by forces from outside alone. Forces of carriers are changed so that
/// the usual kick does that with the mass that they have in World::nodes. What later forces of the same step
/// (walls, impacts) leave open is made good in the next one.
class CarriedMass : public Impact, public EnergyTerm {
 public:
  CarriedMass(std::shared_ptr<const Carriage> how, std::string name, World& world);
  std::string name() const override { return name_; }
  void strike(World& world, const Clock& clock) override;
  void record(World& world, const Clock& clock, EnergyLedger& ledger) override;
  void sample(const World& world, const Clock& clock, EnergyLedger& ledger) const override;
  /// Velocities at the start that fit: those with the least sum m |change|^2, as after a plastic impact.
  void join(World& world);
  /// Once the carriers have moved, in the finish of a pass.
  void move(World& world, const Clock& clock);
  void declare_move(const World& world, Accesses& accesses) const;
  /// Whether the inertia of a carried node counts here, and its acceleration then.
  bool counts(std::size_t i) const { return counts_[i] != 0; }
  const Vec& acceleration(std::size_t i) const { return a_[i]; }

 private:
  using Vecs = std::vector<Vec>;
  struct Energies {
    Real kinetic = 0, half_step = 0, below = 0;
  };
  void find_free_axes(const World& world);
  void find_own_masses(const World& world);
  void look(World& world);
  void precondition();
  void find_velocities(World& world, const Clock& clock);
  void note_changes(const World& world, const Vecs& x, const Vecs& v, const Clock& clock);
  void push(World& world, const Clock& clock);
  Vec free(std::size_t c, Vec value) const;
  Vec pulled(std::size_t c, const Vecs& momenta, const Vecs& turning) const;
  void times(const Vecs& p, Vecs& out);
  Vecs solve(Vecs r);
  Real dot(const Vecs& a, const Vecs& b) const;
  template <class Value>
  void each_carrier(const Value& value) const;
  Energies energies(const World& world, Real dt) const;
  Carriage::Chord chord(const World& world, std::size_t i, const Vecs& x, const Vecs& v, Real dt) const;

  std::shared_ptr<const Carriage> how_;
  std::string name_;
  Field<Real>& open_;                               ///< momentum of carriers that the step before left open
  Field<Real>*inertia_, *spin_;                     ///< of nodes; null: nothing turns
  std::vector<char> weighs_, counts_;               ///< of each carried node; and now
  std::vector<std::size_t> first_;                  ///< slots of each carried node, one for each carrier
  std::vector<std::size_t> carrier_, carried_;      ///< of each slot
  std::vector<Real> share_;                         ///< of each slot, of the mass
  std::vector<Carriage::Rate> rate_;                ///< of each slot
  std::vector<Index> node_;                         ///< of each carrier
  std::vector<std::vector<std::size_t>> slots_of_;  ///< of each carrier, those that count
  std::vector<Real> own_;                           ///< mass of each carrier without those of carried nodes
  std::vector<std::array<bool, 3>> is_free_;
  std::vector<Matrix> inverse_;            ///< of each carrier's block of the matrix
  Vecs before_, v_, x_, wanted_, pushed_;  ///< of carriers: v before, after, x, momenta to get, forces added
  std::vector<Real> mass_, turns_;         ///< of carried nodes: mass, rotary inertia that counts
  Vecs was_, had_spin_;                    ///< of carried nodes: velocities before
  Vecs change_, turned_;                   ///< of their momenta in the step
  Vecs a_, spin_a_;                        ///< their accelerations
  Vecs momenta_, turning_;                 ///< for products
  bool any_ = false;                       ///< some inertia counts
};

}  // namespace courant
