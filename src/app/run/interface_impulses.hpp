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

/// What they add up to since the start of the run. There without rcforc, too, which a restart may add.
class InterfaceImpulses : public virtual Pass, public Restartable {
 public:
  std::string name() const override { return "impulses of contacts"; }
  void keep(Archive& archive) override { archive("impulses", impulses_); }
  void begin() { impulses_.clear(); }
  void add(const std::vector<InterfaceForce>& forces, Real dt);
  /// So far, of so many forces as there are.
  std::vector<Vec> so_far(std::size_t count) const;
  bool summed = false;  ///< by a pass of each step: rcforc is asked for

 private:
  std::vector<Vec> impulses_;  ///< in the order of `interface_forces` [ML/T]
};

}  // namespace courant
