#pragma once
// What cables and discrete beams have alike.
#include <memory>
#include <string>
#include <vector>

#include "elements/element_report.hpp"
#include "elements/erosion.hpp"
#include "state/reports.hpp"

namespace courant {

/// Elements with half of their mass at each of two nodes, worked out one by one, each with a step of its own;
/// their forces stay on the ends, which a pass over the nodes gathers.
class TwoNodeForces : public Material,
                      public TimeLimit,
                      public EnergyTerm,
                      public PartReporter,
                      public ElementReporter {
 public:
  std::string name() const override { return group_.fields.name(); }
  const FieldSet& over(const World&) const override { return group_.fields; }
  void block(World& world, const Clock& clock, Index begin, Index end) override;
  Limit limit(const World&, const Clock&) override;
  void record(World&, const Clock&, EnergyLedger&) override {}
  void sample(const World&, const Clock&, EnergyLedger& ledger) const override { ledger.internal += total(); }
  void report_part(const World& world, std::vector<PartSums>& parts) const override;
  ElementKind kind() const override { return ElementKind::beam; }
  const ElementGroup& reported() const override { return group_; }

 protected:
  /// `what` they are, for messages: "cable". Adds their internal energy.
  TwoNodeForces(ElementGroup& group, Id part_id, Real tssfac, std::string what);
  /// They may fail, and their `force` with them. Once.
  void may_fail(Field<Real>& force, ElementOptions& options, World& world);

  /// An element that is not dead: its forces, energy and step.
  virtual void advance(const World& world, const Clock& clock, Index begin, Index e) = 0;
  /// Of the rotation of an end. [ML2/T2]
  virtual Real turning_energy(Index /*e*/, Index /*node*/) const { return 0; }

  static std::size_t at(Index e) { return static_cast<std::size_t>(e); }
  Field<Real>& add(const char* field, const char* dimension, int components, bool output) {
    return group_.fields.add<Real>(
        {.name = field, .dimension = dimension, .components = components, .output = output});
  }
  bool dead(Index e) const { return erosion_ && erosion_->dead(e); }

  ElementGroup& group_;
  Field<Real>& energy_;
  std::vector<Real> steps_;           ///< of each, alone [T]
  std::shared_ptr<Erosion> erosion_;  ///< null: nothing fails

 private:
  Real total() const;

  Id part_id_;
  Real tssfac_;
  std::string what_;
};

}  // namespace courant
