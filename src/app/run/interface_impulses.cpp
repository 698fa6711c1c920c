#include "app/run/interface_impulses.hpp"

#include "extension/builders.hpp"
#include "model/model.hpp"

namespace courant {

namespace {

/// A contact may act on particles and on nodes.
void add_interface(const InterfaceForce& one, std::vector<InterfaceForce>& all) {
  for (InterfaceForce& known : all) {
    if (known.id != one.id) continue;
    known.on_surfa += one.on_surfa;
    known.energy_stored += one.energy_stored, known.energy_damping += one.energy_damping;
    known.energy_friction += one.energy_friction;
    return;
  }
  all.push_back(one);
}

/// Integrates over every step: samples of histories miss what acts between them. v^{n-1/2} has got these
/// impulses.
class SumOfImpulses : public EnergyTerm {
 public:
  SumOfImpulses(Contacts contacts, std::shared_ptr<InterfaceImpulses> sum)
      : contacts_(std::move(contacts)), sum_(std::move(sum)) {}
  std::string name() const override { return "impulses of contacts, each step"; }
  void record(World& world, const Clock& clock, EnergyLedger&) override {
    sum_->add(interface_forces(world, contacts_), clock.dt_mean());
  }
  void sample(const World&, const Clock&, EnergyLedger&) const override {}

 private:
  Contacts contacts_;
  std::shared_ptr<InterfaceImpulses> sum_;
};

void watch_impulses(const Model& model, World& world, const Contacts& contacts) {
  if (contacts.empty() && world.passes.all<InterfaceReporter>().empty() &&
      world.passes.all<WallForceReporter>().empty())
    return;
  auto sum = world.passes.add(std::make_shared<InterfaceImpulses>());
  sum->summed = model.output.histories.contains("rcforc");
  if (sum->summed) world.passes.add(std::make_shared<SumOfImpulses>(contacts, sum));
}

const RegisterBuilder watch_all(BuildPhase::checks, "impulses of contacts", watch_impulses);

}  // namespace

std::vector<InterfaceForce> interface_forces(const World& world, const Contacts& contacts) {
  std::vector<InterfaceForce> out;
  for (const auto& contact : contacts) out.push_back(contact->report());
  for (const auto* nodes : world.passes.all<const InterfaceReporter>()) add_interface(nodes->report(), out);
  for (const auto* walls : world.passes.all<const WallForceReporter>()) out.push_back(walls->report(world));
  return out;
}

void InterfaceImpulses::add(const std::vector<InterfaceForce>& forces, Real dt) {
  impulses_.resize(forces.size(), Vec::Zero());
  for (std::size_t k = 0; k < forces.size(); ++k) impulses_[k] += dt * forces[k].on_surfa;
}

std::vector<Vec> InterfaceImpulses::so_far(std::size_t count) const {
  std::vector<Vec> out = impulses_;
  out.resize(count, Vec::Zero());
  return out;
}

}  // namespace courant
