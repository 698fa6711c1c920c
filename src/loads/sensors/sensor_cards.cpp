// Cards of sensors, and the end of a run by one.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <memory>
#include <optional>
#include <set>
#include <string_view>
#include <unordered_map>

#include "extension/additions.hpp"
#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"
#include "loads/load_cards.hpp"
#include "loads/sensors/sensor_force.hpp"
#include "loads/sensors/sensor_math.hpp"
#include "loads/sensors/sensors.hpp"
#include "model/conditions/motion_ids.hpp"
#include "state/ending.hpp"

namespace courant {

namespace {

using namespace rules;

struct SensorControlCard : Entry {
  Id cntlid = 0, typid = 0;
  std::string type, estyp, initstt;
  Real timeoff = 0;
  int nrep = 0;
  Id swit1 = 0, swit2 = 0, swit3 = 0, swit4 = 0, swit5 = 0, swit6 = 0, swit7 = 0;
};

using Node = SensorDefineNode;
const RegisterKeyword<Node> sensor_define_node{sensor_define_node_table()};

using Misc = SensorDefineMisc;

const RegisterKeyword<Misc> sensor_define_misc{sensor_define_misc_table()};

using Math = SensorCalcMath;
const RegisterKeyword<Math> sensor_calc_math{sensor_define_calc_math_table()};

using Switch = SensorSwitchCard;

const RegisterKeyword<Switch> sensor_switch{sensor_switch_table()};

using Control = SensorControlCard;
IdSpace controlled_space(const Control& c) {
  return c.type == "CONTACT" ? IdSpace::contact : IdSpace::boundary;
}
const FieldRules switch_id{.check = Check::not_negative};
const RegisterKeyword<Control> sensor_control{
    {.names = {"SENSOR_CONTROL"},
     .purpose = "prescribed motions of nodes, and contacts of elements, that switches turn on and off",
     .cards = {
         {.fields = {{"CNTLID", &Control::cntlid, "-", "id", required_id},
                     {"TYPE", &Control::type, "-",
                      "PRESC-MOT: a *BOUNDARY_PRESCRIBED_MOTION_NODE or _SET; CONTACT: one of elements"},
                     {"TYPEID", &Control::typid, "-", "its number, by _ID", required_id, controlled_space},
                     {"TIMEOFF", &Control::timeoff, "-", "1 shifts its curve to the time of the switch",
                      unsupported},
                     {"NREP", &Control::nrep, "-",
                      "how often the switches are gone through again; -1: for ever"},
                     {"ESTYP", &Control::estyp, "-", "of sets of elements"}}},
         {.fields = {{"INITSTT", &Control::initstt, "-", "at the start: ON (also blank) or OFF"},
                     {"SWIT1", &Control::swit1, "-", "switch that changes it first", required_id},
                     {"SWIT2", &Control::swit2, "-", "that changes it next", switch_id},
                     {"SWIT3", &Control::swit3, "-", "next", switch_id},
                     {"SWIT4", &Control::swit4, "-", "next", switch_id},
                     {"SWIT5", &Control::swit5, "-", "next", switch_id},
                     {"SWIT6", &Control::swit6, "-", "next", switch_id},
                     {"SWIT7", &Control::swit7, "-", "last", switch_id}}}}}};

const RegisterKeyword<TerminationSensor> termination_sensor{termination_sensor_table()};

class SensorReader {
 public:
  SensorReader(const Deck& deck, const Model& model, const World& world, Diagnostics& diagnostics)
      : deck_(deck), model_(model), world_(world), diagnostics_(diagnostics) {
    for (Index n = 0; n < world.nodes.size(); ++n) node_of_id_.emplace(world.nodes.id[n], n);
  }

  std::shared_ptr<SensorBoard> read() {
    find_used();
    for (const Node& card : deck_.all<Node>()) add(card);
    for (const Misc& card : deck_.all<Misc>()) add(card);
    for (const SensorKind& kind : sensor_kinds())
      for (Sensor& one : kind(deck_, model_, world_, diagnostics_)) add_one(std::move(one));
    for (const Math& card : deck_.all<Math>()) add(card);
    for (const Switch& card : deck_.all<Switch>()) add(card);
    for (const Control& card : deck_.all<Control>()) add(card);
    return std::make_shared<SensorBoard>(std::move(sensors_), std::move(switches_), std::move(controls_));
  }

 private:
  void error(const Entry& card, const char* field, std::string message, std::string hint = {}) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
  }
  template <class List>
  static int find(const List& list, Id id) {
    for (std::size_t k = 0; k < list.size(); ++k)
      if (list[k].id == id) return static_cast<int>(k);
    return -1;
  }
  Index node(const Entry& card, const char* field, Id id) {
    const auto found = node_of_id_.find(id);
    if (found != node_of_id_.end()) return found->second;
    error(card, field, fmt::format("node {} belongs to no element or body", id),
          "take a corner of a shell or solid, or a node of a rigid body");
    return -1;
  }

  template <class Card>
  bool is_new(const Card& card) {
    if (find(sensors_, card.sensid) < 0) return true;
    error(card, "SENSID", fmt::format("sensor {} is defined twice", card.sensid), "give it another number");
    return false;
  }

  /// Ids of sensors that something looks at.
  void find_used() {
    for (const Switch& card : deck_.all<Switch>()) used_.insert(card.sensid);
    for (const Math& card : deck_.all<Math>())
      for (const Id id : {card.sens1, card.sens2, card.sens3, card.sens4, card.sens5, card.sens6})
        used_.insert(id);
  }

  std::vector<Index> nodes_of(const Node& card, const char* field, Id id) {
    constexpr int of_set = 1;
    if (id == 0) return {};
    if (card.name != of_set) return {node(card, field, id)};
    const auto set = model_.node_sets.find(id);
    if (set == model_.node_sets.end()) {
      error(card, field, fmt::format("node set {} does not exist", id), "define it with *SET_NODE");
      return {};
    }
    std::vector<Index> out;
    for (const Index n : set->second)
      out.push_back(node(card, field, model_.nodes[static_cast<std::size_t>(n)].id));
    return out;
  }

  void add(const Node& card) {
    if (!is_new(card)) return;
    if (!used_.contains(card.sensid))
      return diagnostics_.note(deck_.where(card),
                               fmt::format("sensor {}: no switch looks at it: no effect", card.sensid));
    NodeSensor out;
    out.nodes = nodes_of(card, "NODE1", card.node1), out.base = nodes_of(card, "NODE2", card.node2);
    out.velocity = card.ctype == "VEL";
    const auto of = std::find(set_options.begin(), set_options.end(), card.setopt);
    out.of = static_cast<NodeSensor::Of>(of - set_options.begin());
    if (card.name == 1 && (of == set_options.end() || (out.of >= NodeSensor::Of::largest && card.node2 != 0)))
      error(card, "SETOPT",
            fmt::format("'{}' is not supported", card.setopt.empty() ? "blank: any node" : card.setopt),
            "AVG or SUM; without NODE2 also MAX, MIN");
    if (card.ctype != "COORD" && card.ctype != "VEL")
      error(card, "CTYPE",
            fmt::format("'{}' is not supported", card.ctype.empty() ? "ACC (blank)" : card.ctype),
            "COORD or VEL: accelerations are of single steps");
    out.direction = sensor_direction(deck_, model_, card, card.vid, diagnostics_);
    sensors_.push_back({card.sensid, [out](const World& world, const Clock&) { return out.value(world); }});
  }

  static bool whole_number(const std::string& text, Id& value) {
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    return fault == std::errc() && end == text.data() + text.size();
  }

  void add_one(Sensor sensor) {
    if (find(sensors_, sensor.id) < 0) return sensors_.push_back(std::move(sensor));
    error(sensor.card, "SENSID", fmt::format("sensor {} is defined twice", sensor.id),
          "give it another number");
  }

  void add(const Misc& card) {
    if (!is_new(card)) return;
    Sensor out{.id = card.sensid, .value = nullptr, .card = card};
    if (card.mtype == "TIME") {
      out.value = [](const World&, const Clock& clock) { return clock.t; };
    } else if (card.mtype == "CURVE") {
      Id id = 0;
      const auto curve = whole_number(card.i0, id) ? model_.curves.find(id) : model_.curves.end();
      if (curve == model_.curves.end())
        return error(card, "I0", fmt::format("curve {} does not exist", card.i0),
                     "define it with *DEFINE_CURVE");
      out.value = [of_time = curve->second](const World&, const Clock& clock) { return of_time(clock.t); };
    } else {
      return error(card, "MTYPE",
                   fmt::format("'{}' is not supported", card.mtype.empty() ? "ANGLE (blank)" : card.mtype),
                   "TIME or CURVE");
    }
    sensors_.push_back(std::move(out));
  }

  void add(const Math& card) {
    if (!is_new(card)) return;
    const SensorMath calculate = sensor_math(card.calc);
    if (!calculate)
      return error(card, "CALC", fmt::format("'{}' is not supported", card.calc),
                   "SUM, ABSSUM, SUMABS, MAX, MIN, MAXMAG, MINMAG, MULTIPLY, SQRE, SQRTSQRE, SQRT");
    std::vector<Sensor> of;
    const std::pair<const char*, Id> fields[] = {{"SENS1", card.sens1}, {"SENS2", card.sens2},
                                                 {"SENS3", card.sens3}, {"SENS4", card.sens4},
                                                 {"SENS5", card.sens5}, {"SENS6", card.sens6}};
    for (const auto& [field, id] : fields) {
      if (id == 0) continue;
      const int k = find_sensor(card, field, id);
      if (k < 0) return;
      of.push_back(sensors_[static_cast<std::size_t>(k)]);
    }
    sensors_.push_back({.id = card.sensid,
                        .value =
                            [of, calculate](const World& world, const Clock& clock) {
                              std::vector<Real> values;
                              for (const Sensor& one : of) values.push_back(one.value(world, clock));
                              return calculate(values);
                            },
                        .card = card});
  }
  void add(const Switch& card) {
    if (find(switches_, card.switid) >= 0)
      return error(card, "SWITID", fmt::format("switch {} is defined twice", card.switid),
                   "give it another number");
    SensorSwitch out{.id = card.switid, .greater = card.logic == "GT", .value = card.value};
    out.window = card.timwin, out.delay = card.tdelay;
    const bool of_time = card.type == "TIME";
    if (!of_time && !card.type.empty() && card.type != "SENSOR")
      error(card, "TYPE", fmt::format("'{}' is not supported", card.type), "SENSOR or TIME");
    if (!card.logic.empty() && card.logic != "GT" && card.logic != "LT")
      error(card, "LOGIC", fmt::format("'{}' is not supported", card.logic), "GT or LT");
    if (!of_time) out.sensor = find_sensor(card, "SENSID", card.sensid);
    switches_.push_back(out);
  }

  int find_sensor(const Entry& card, const char* field, Id id) {
    const int found = find(sensors_, id);
    if (found >= 0) return found;
    const auto& forces = deck_.all<SensorDefineForce>();
    const auto force =
        std::find_if(forces.begin(), forces.end(), [&](const auto& f) { return f.sensid == id; });
    if (force != forces.end())
      error(card, field,
            fmt::format("sensor {} is a force ({}), by which nothing can be switched", id, force->ftype),
            "forces of CONTACT, JOINT, PRESC-MOT, RWALL, SPC and XSECTION can");
    else
      error(card, field, fmt::format("sensor {} does not exist", id),
            "define it with *SENSOR_DEFINE_NODE or its like; those of CALC-MATH above it");
    return -1;
  }

  void add(const Control& card) {
    const bool contact = card.type == "CONTACT";
    SensorControl out{.id = card.cntlid, .controlled = card.typid, .on_first = card.initstt != "OFF"};
    if (contact) out.kind = SensorControl::Of::contact, out.card = card;
    out.repeats = card.nrep;
    if (!contact && card.type != "PRESC-MOT")
      return error(card, "TYPE", fmt::format("'{}' is not supported", card.type), "PRESC-MOT or CONTACT");
    if (!card.initstt.empty() && card.initstt != "ON" && card.initstt != "OFF")
      error(card, "INITSTT", fmt::format("'{}' is not supported", card.initstt), "ON or OFF");
    if (card.nrep < -1) error(card, "NREP", fmt::format("'{}' is not supported", card.nrep), "-1 or more");
    if (!contact && !has_motion_of_nodes(deck_, card.typid))
      error(card, "TYPEID", fmt::format("no prescribed motion of nodes has the number {}", card.typid),
            "give it one by *BOUNDARY_PRESCRIBED_MOTION_SET_ID");
    const std::pair<const char*, Id> fields[] = {
        {"SWIT1", card.swit1}, {"SWIT2", card.swit2}, {"SWIT3", card.swit3}, {"SWIT4", card.swit4},
        {"SWIT5", card.swit5}, {"SWIT6", card.swit6}, {"SWIT7", card.swit7}};
    for (const auto& [field, id] : fields) {
      if (id == 0) continue;
      const int k = find(switches_, id);
      if (k < 0)
        return error(card, field, fmt::format("switch {} does not exist", id),
                     "define it with *SENSOR_SWITCH");
      out.switches.push_back(k);
    }
    for (const SensorControl& other : controls_)
      if (other.kind == out.kind && other.controlled == out.controlled)
        return error(
            card, "TYPEID",
            fmt::format("control {} switches this {} already", other.id, contact ? "contact" : "motion"),
            "give it all of its switches");
    controls_.push_back(std::move(out));
  }

  const Deck& deck_;
  const Model& model_;
  const World& world_;
  Diagnostics& diagnostics_;
  std::unordered_map<Id, Index> node_of_id_;
  static constexpr std::array<std::string_view, 4> set_options{"AVG", "SUM", "MAX", "MIN"};
  std::set<Id> used_;
  std::vector<Sensor> sensors_;
  std::vector<SensorSwitch> switches_;
  std::vector<SensorControl> controls_;
};

class EndAtSensor : public Ending {
 public:
  EndAtSensor(const SensorBoard* board, int k) : board_(board), switch_(k) {}
  std::string name() const override { return "end at a sensor"; }
  std::optional<std::string> ended(const World& world, const Clock& clock) const override {
    if (!board_->switch_is_on(switch_)) return std::nullopt;
    return board_->text_of_switch(switch_, world, clock) + " (*TERMINATION_SENSOR)";
  }

 private:
  const SensorBoard* board_;
  int switch_;
};

const RegisterAddition end_at_sensor{
    "*TERMINATION_SENSOR", [](const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics) {
      const SensorBoard* const board = sensors_of(deck, model, world, diagnostics);
      for (const TerminationSensor& card : deck.all<TerminationSensor>()) {
        const int k = board ? board->find_switch(card.swid) : -1;
        if (k < 0)
          deck.error(diagnostics, card, "SWID", fmt::format("switch {} does not exist", card.swid),
                     "define it with *SENSOR_SWITCH");
        else
          world.passes.add(std::make_shared<EndAtSensor>(board, k));
      }
    }};

}  // namespace

std::string keep_curve_of_sensor(SensorDefineMisc& card, const Conversion& conversion) {
  if (card.mtype != "CURVE" || !(conversion.offsets.any() || conversion.units.any())) return "";
  return "curves of sensors are not shifted or converted: put the card into a file without";
}

std::string convert_switch(SensorSwitchCard& card, const Conversion& conversion) {
  if (card.type == "TIME") card.value *= conversion.units.of("T");
  if (card.type == "TIME" || card.value == 0 || !conversion.units.any()) return "";
  return "VALUE has the unit of its sensor, which is not converted: put the card into a file without unit "
         "factors";
}

void check_sensors(const Deck& deck, const World& world, Diagnostics& diagnostics) {
  for (const auto* board : world.passes.all<const SensorBoard>()) {
    for (const SensorControl& control : board->controls())
      if (control.kind == SensorControl::Of::contact && !control.claimed)
        deck.error(diagnostics, control.card, "TYPEID",
                   fmt::format("no contact that sensors can switch has the number {}", control.controlled),
                   "give it one by _ID; tied contacts stay tied");
    for (const Sensor& sensor : board->sensors())
      if (sensor.there && !sensor.there(world))
        deck.error(
            diagnostics, sensor.card, "TYPEID", "nothing that exerts such a force has this number",
            "give it one by _ID; forces of contacts on particles, and of constraints on nodes of rigid "
            "bodies, are not measured");
  }
}

SensorBoard* sensors_of(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics) {
  const std::vector<SensorBoard*> known = world.passes.all<SensorBoard>();
  if (!known.empty()) return known.front();
  if (deck.all<Node>().empty() && deck.all<Switch>().empty() && deck.all<Control>().empty()) return nullptr;
  return world.passes.add(SensorReader(deck, model, world, diagnostics).read()).get();
}

}  // namespace courant
