#pragma once
// Forces of all contacts and supporting walls, and what they add up to over time.
#include <memory>
#include <vector>

#include "contact/contact.hpp"
#include "state/pass.hpp"
#include "state/reports.hpp"
#include "state/restartable.hpp"

namespace courant {

using Contacts = std::vector<std::shared_ptr<Contact>>;

/// All at t^n, those of the same number together.
std::vector<InterfaceForce> interface_forces(const World& world, const Contacts& contacts);

/// Integrates them over every step: samples of histories miss what acts between them. v^{n-1/2} has got these
/// impulses.
class InterfaceImpulses : public EnergyTerm, public Restartable {
 public:
  InterfaceImpulses(Contacts contacts, bool asked) : contacts_(std::move(contacts)), asked_(asked) {}
  std::string name() const override { return "impulses of contacts"; }
  void record(World& world, const Clock& clock, EnergyLedger& ledger) override;
  void sample(const World&, const Clock&, EnergyLedger&) const override {}
  void keep(Archive& archive) override { archive("impulses", impulses_); }
  void begin() { impulses_.clear(); }
  /// So far, of so many forces as there are; empty without rcforc.
  std::vector<Vec> so_far(std::size_t count) const;

 private:
  Contacts contacts_;
  bool asked_;
  std::vector<Vec> impulses_;  ///< in the order of `interface_forces` [ML/T]
};

}  // namespace courant
