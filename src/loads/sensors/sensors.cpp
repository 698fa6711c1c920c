#include "loads/sensors/sensors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace courant {

std::vector<SensorKind>& sensor_kinds() {
  static std::vector<SensorKind> all;
  return all;
}

Real NodeSensor::value(const World& world) const {
  const auto along = [&](const Vec& a) { return direction.squaredNorm() > 0 ? a.dot(direction) : a.norm(); };
  const auto at = [&](Index n) { return velocity ? world.nodes.v.vec(n) : world.nodes.x.vec(n); };
  if (of == Of::largest || of == Of::least) {
    Real out = along(at(nodes.front()));
    for (const Index n : nodes)
      out = of == Of::largest ? std::max(out, along(at(n))) : std::min(out, along(at(n)));
    return out;
  }
  const auto total = [&](const std::vector<Index>& some) {
    Vec out = Vec::Zero();
    for (const Index n : some) out += at(n);
    return of == Of::mean && !some.empty() ? Vec(out / static_cast<Real>(some.size())) : out;
  };
  return along(total(nodes) - total(base));
}

SensorBoard::SensorBoard(std::vector<Sensor> sensors, std::vector<SensorSwitch> switches,
                         std::vector<SensorControl> controls)
    : sensors_(std::move(sensors)),
      switches_(std::move(switches)),
      controls_(std::move(controls)),
      holds_since_(switches_.size(), -1),
      on_(switches_.size(), 0),
      changes_(controls_.size(), 0) {}

void SensorBoard::strike(World& world, const Clock& clock) {
  if (clock.cycle == looked_at_) return;
  looked_at_ = clock.cycle;
  for (std::size_t k = 0; k < switches_.size(); ++k) look(world, clock, k);
  for (std::size_t c = 0; c < controls_.size(); ++c) {
    const SensorControl& control = controls_[c];
    const auto count = static_cast<Index>(control.switches.size());
    if (control.repeats >= 0 && changes_[c] >= count * (1 + control.repeats)) continue;
    if (switch_is_on(control.switches[static_cast<std::size_t>(changes_[c] % count)])) ++changes_[c];
  }
}

void SensorBoard::look(const World& world, const Clock& clock, std::size_t k) {
  const SensorSwitch& s = switches_[k];
  const Real now = s.sensor < 0 ? clock.t : sensors_[static_cast<std::size_t>(s.sensor)].value(world, clock);
  const bool holds = s.sensor < 0 ? now >= s.value : s.greater ? now > s.value : now < s.value;
  if (!holds)
    holds_since_[k] = -1;
  else if (holds_since_[k] < 0)
    holds_since_[k] = clock.t;
  on_[k] = holds && clock.t - holds_since_[k] >= s.window + s.delay;
}

void SensorBoard::keep(Archive& archive) {
  archive("holds_since", holds_since_);
  archive("on", on_);
  archive("changes", changes_);
}

int SensorBoard::control_of(SensorControl::Of kind, Id controlled) const {
  for (std::size_t c = 0; c < controls_.size(); ++c)
    if (controlled != 0 && controls_[c].kind == kind && controls_[c].controlled == controlled)
      return static_cast<int>(c);
  return -1;
}

SensorGate SensorBoard::gate_of_contact(Id contact) {
  const int control = control_of(SensorControl::Of::contact, contact);
  if (control < 0) return {};
  controls_[static_cast<std::size_t>(control)].claimed = true;
  return {this, control};
}

bool SensorGate::open() const {
  return !board_ || board_->control_is_on(control_);
}

bool SensorBoard::control_is_on(int control) const {
  const auto c = static_cast<std::size_t>(control);
  return controls_[c].on_first == (changes_[c] % 2 == 0);
}

int SensorBoard::find_switch(Id id) const {
  for (std::size_t k = 0; k < switches_.size(); ++k)
    if (switches_[k].id == id) return static_cast<int>(k);
  return -1;
}

std::string SensorBoard::text_of_switch(int k, const World& world, const Clock& clock) const {
  const SensorSwitch& s = switches_[static_cast<std::size_t>(k)];
  if (s.sensor < 0)
    return fmt::format("switch {}: the time {:.6g} has come to {:.6g}", s.id, clock.t, s.value);
  const Sensor& sensor = sensors_[static_cast<std::size_t>(s.sensor)];
  return fmt::format("switch {}: sensor {} measures {:.6g}, {} {:.6g}", s.id, sensor.id,
                     sensor.value(world, clock), s.greater ? "above" : "below", s.value);
}

}  // namespace courant
