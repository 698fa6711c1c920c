#pragma once
// *SENSOR_DEFINE_NODE, _SWITCH and _CONTROL: what nodes do switches motions on and off, or ends the run.
#include <string>
#include <vector>

#include "keyword/deck.hpp"
#include "model/model.hpp"
#include "state/restartable.hpp"
#include "state/world.hpp"

namespace courant {

/// What a node does along a direction, seen from another one.
struct NodeSensor {
  Id id = 0;
  Index node = 0, base = -1;             ///< of the world; base -1: none
  Vec direction = Vec::Zero();           ///< 0: the magnitude
  bool velocity = false;                 ///< else the coordinate
  Real value(const World& world) const;  ///< [L], [L/T]
};

struct SensorSwitch {
  Id id = 0;
  int sensor = -1;                        ///< among the sensors; -1: of time
  bool greater = false;                   ///< on where the value is above `value`, else below
  Real value = 0, window = 0, delay = 0;  ///< window, delay [T]
};

/// ON and OFF in turn: each switch that is on makes the next change.
struct SensorControl {
  Id id = 0, motion = 0;
  bool on_first = true;
  std::vector<int> switches{};
  int repeats = 0;  ///< < 0: for ever
};

/// All sensors of a deck. It looks once in each step, when forces and dt are known, so that what it switches
/// holds from this step on.
class SensorBoard : public Impact, public Restartable {
 public:
  SensorBoard(std::vector<NodeSensor> sensors, std::vector<SensorSwitch> switches,
              std::vector<SensorControl> controls);
  std::string name() const override { return "sensors"; }
  void strike(World& world, const Clock& clock) override;
  void keep(Archive& archive) override;
  /// Index of the control of a motion; -1: none.
  int control_of_motion(Id motion) const;
  bool control_is_on(int control) const;
  /// -1: there is none.
  int find_switch(Id id) const;
  bool switch_is_on(int k) const { return on_[static_cast<std::size_t>(k)] != 0; }
  /// What it measures now, in words.
  std::string text_of_switch(int k, const World& world, const Clock& clock) const;

 private:
  void look(const World& world, const Clock& clock, std::size_t k);

  std::vector<NodeSensor> sensors_;
  std::vector<SensorSwitch> switches_;
  std::vector<SensorControl> controls_;
  std::vector<Real> holds_since_;  ///< of each switch; < 0: its condition does not hold [T]
  std::vector<Index> on_;          ///< of each switch
  std::vector<Index> changes_;     ///< of each control, so far
  std::int64_t looked_at_ = -1;    ///< cycle
};

/// That of the world, which the first call makes and adds to its passes; null where the deck has no sensors.
/// Refuses by name what is not there: other kinds of sensors and controls, filters, curves that are shifted.
SensorBoard* sensors_of(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics);

}  // namespace courant
