#pragma once
// *SENSOR_DEFINE_, _SWITCH and _CONTROL: what nodes do and bear switches motions and contacts on and off, or
// ends the run.
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "keyword/deck.hpp"
#include "model/model.hpp"
#include "state/restartable.hpp"
#include "state/world.hpp"

namespace courant {

/// The quantity of a switch.
struct Sensor {
  Id id = 0;
  std::function<Real(const World&, const Clock&)> value;
  /// Whether the source of the force is in the world; null: none is needed.
  std::function<bool(const World&)> there = nullptr;
  Entry card{};  ///< for messages
};

/// A file that adds sensors reads its cards and returns them; they may look at the passes of the world, which
/// are all there when the first value is asked for.
using SensorKind = std::function<std::vector<Sensor>(const Deck&, const Model&, const World&, Diagnostics&)>;
std::vector<SensorKind>& sensor_kinds();
struct RegisterSensors {
  explicit RegisterSensors(SensorKind kind) { sensor_kinds().push_back(std::move(kind)); }
};

/// What nodes do along a direction, seen from others.
struct NodeSensor {
  enum class Of { mean, sum, largest, least } of = Of::mean;  ///< of several
  std::vector<Index> nodes{}, base{};                         ///< of the world; base empty: none
  Vec direction = Vec::Zero();                                ///< 0: the magnitude
  bool velocity = false;                                      ///< else the coordinate
  Real value(const World& world) const;                       ///< [L], [L/T]
};

struct SensorSwitch {
  Id id = 0;
  int sensor = -1;                        ///< among the sensors; -1: of time
  bool greater = false;                   ///< on where the value is above `value`, else below
  Real value = 0, window = 0, delay = 0;  ///< window, delay [T]
};

/// ON and OFF in turn: each switch that is on makes the next change.
struct SensorControl {
  enum class Of { motion, contact };
  Id id = 0;
  Of kind = Of::motion;
  Id controlled = 0;     ///< number of the motion or contact
  Entry card{};          ///< for messages
  bool claimed = false;  ///< by a contact: there is one
  bool on_first = true;
  std::vector<int> switches{};
  int repeats = 0;  ///< < 0: without end
};

class SensorBoard;

/// Whether sensors let a contact act; without any they do.
class SensorGate {
 public:
  SensorGate() = default;
  SensorGate(const SensorBoard* board, int control) : board_(board), control_(control) {}
  bool there() const { return board_ != nullptr; }
  bool open() const;

 private:
  const SensorBoard* board_ = nullptr;
  int control_ = -1;
};

/// All sensors of a deck. It looks once in each step, when forces and dt are known, so that what it switches
/// holds from this step on.
class SensorBoard : public Impact, public Restartable {
 public:
  SensorBoard(std::vector<Sensor> sensors, std::vector<SensorSwitch> switches,
              std::vector<SensorControl> controls);
  std::string name() const override { return "sensors"; }
  void strike(World& world, const Clock& clock) override;
  void keep(Archive& archive) override;
  /// Index of the control of a motion or contact; -1: none.
  int control_of(SensorControl::Of kind, Id controlled) const;
  bool control_is_on(int control) const;
  /// That of a contact which is built.
  SensorGate gate_of_contact(Id contact);
  const std::vector<SensorControl>& controls() const { return controls_; }
  /// -1: there is none.
  int find_switch(Id id) const;
  bool switch_is_on(int k) const { return on_[static_cast<std::size_t>(k)] != 0; }
  /// What it measures now, in words.
  std::string text_of_switch(int k, const World& world, const Clock& clock) const;
  const std::vector<Sensor>& sensors() const { return sensors_; }

 private:
  void look(const World& world, const Clock& clock, std::size_t k);

  std::vector<Sensor> sensors_;
  std::vector<SensorSwitch> switches_;
  std::vector<SensorControl> controls_;
  std::vector<Real> holds_since_;  ///< of each switch; < 0: its condition does not hold [T]
  std::vector<Index> on_;          ///< of each switch
  std::vector<Index> changes_;     ///< of each control, so far
  std::int64_t looked_at_ = -1;    ///< cycle
};

/// After the set-up: forces without a source are errors.
void check_sensors(const Deck& deck, const World& world, Diagnostics& diagnostics);

/// That of the world, which the first call makes and adds to its passes; null where the deck has no sensors.
/// Refuses by name what is not there: other kinds of sensors and controls, filters, curves that are shifted.
SensorBoard* sensors_of(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics);

}  // namespace courant
