// Cards of sensors, and the end of a run by one.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <unordered_map>

#include "extension/additions.hpp"
#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"
#include "loads/sensors.hpp"
#include "model/conditions/motion_ids.hpp"
#include "state/ending.hpp"

namespace courant {

namespace {

using namespace rules;

struct SensorDefineNode : Entry {
  Id sensid = 0, node1 = 0, node2 = 0;
  std::string vid, ctype, setopt;
};
struct SensorDefineForce : Entry {
  Id sensid = 0, typeid_ = 0;
  std::string ftype, vid;
  int crd = 0;
};
struct SensorSwitchCard : Entry {
  Id switid = 0, sensid = 0, filtrid = 0;
  std::string type, logic;
  Real value = 0, timwin = 0, tdelay = 0;
};
struct SensorControlCard : Entry {
  Id cntlid = 0, typid = 0;
  std::string type, estyp, initstt;
  Real timeoff = 0;
  int nrep = 0;
  Id swit1 = 0, swit2 = 0, swit3 = 0, swit4 = 0, swit5 = 0, swit6 = 0, swit7 = 0;
};
struct TerminationSensor : Entry {
  Id swid = 0;
};

using Node = SensorDefineNode;
const RegisterKeyword<Node> sensor_define_node{
    {.names = {"SENSOR_DEFINE_NODE"},
     .purpose = "what a node does, seen from another one, for switches",
     .cards = {
         {.fields = {
              {"SENSID", &Node::sensid, "-", "id that switches refer to", required_id},
              {"NODE1", &Node::node1, "-", "node", required_id_of(IdSpace::node)},
              {"NODE2", &Node::node2, "-", "node it is seen from; 0: none", optional_id_of(IdSpace::node)},
              {"VID", &Node::vid, "-", "X, Y, Z, or a vector; blank or 0: the magnitude"},
              {},
              {"CTYPE", &Node::ctype, "-", "COORD or VEL; ACC, which a blank field means, is refused"},
              {"SETOPT", &Node::setopt, "-", "of sets of nodes", unsupported}}}}}};

using Force = SensorDefineForce;
const RegisterKeyword<Force> sensor_define_force{
    {.names = {"SENSOR_DEFINE_FORCE"},
     .purpose = "forces, which are read; switches that ask for one are refused",
     .cards = {{.fields = {{"SENSID", &Force::sensid, "-", "id that switches refer to", required_id},
                           {"FTYPE", &Force::ftype, "-", "what exerts it"},
                           {"TYPEID", &Force::typeid_, "-", "number of that"},
                           {"VID", &Force::vid, "-", "direction"},
                           {"CRD", &Force::crd, "-", "coordinate system", no_effect}}}}}};

using Switch = SensorSwitchCard;
const RegisterKeyword<Switch> sensor_switch{
    {.names = {"SENSOR_SWITCH"},
     .purpose = "on while a sensor is above or below a value, or from a time on",
     .cards = {{.fields = {
                    {"SWITID", &Switch::switid, "-", "id that controls refer to", required_id},
                    {"TYPE", &Switch::type, "-", "SENSOR (also blank) or TIME"},
                    {"SENSID", &Switch::sensid, "-", "sensor", {.check = Check::not_negative}},
                    {"LOGIC", &Switch::logic, "-", "GT, or LT (also blank)"},
                    {"VALUE", &Switch::value, "-", "value, or time"},
                    {"FILTRID", &Switch::filtrid, "-", "filter", unsupported},
                    {"TIMWIN", &Switch::timwin, "T", "how long it must hold", {.check = Check::not_negative}},
                    {"TDELAY",
                     &Switch::tdelay,
                     "T",
                     "how much later it is on",
                     {.check = Check::not_negative}}}}}}};

using Control = SensorControlCard;
const FieldRules switch_id{.check = Check::not_negative};
const RegisterKeyword<Control> sensor_control{
    {.names = {"SENSOR_CONTROL"},
     .purpose = "prescribed motions of nodes that switches turn on and off",
     .cards = {
         {.fields =
              {{"CNTLID", &Control::cntlid, "-", "id", required_id},
               {"TYPE", &Control::type, "-", "PRESC-MOT: a *BOUNDARY_PRESCRIBED_MOTION_NODE or _SET"},
               {"TYPEID", &Control::typid, "-", "its number, by _ID", required_id_of(IdSpace::boundary)},
               {"TIMEOFF", &Control::timeoff, "-", "1 shifts its curve to the time of the switch",
                unsupported},
               {"NREP", &Control::nrep, "-", "how often the switches are gone through again; -1: for ever"},
               {"ESTYP", &Control::estyp, "-", "of sets of elements"}}},
         {.fields = {{"INITSTT", &Control::initstt, "-", "at the start: ON (also blank) or OFF"},
                     {"SWIT1", &Control::swit1, "-", "switch that changes it first", required_id},
                     {"SWIT2", &Control::swit2, "-", "that changes it next", switch_id},
                     {"SWIT3", &Control::swit3, "-", "next", switch_id},
                     {"SWIT4", &Control::swit4, "-", "next", switch_id},
                     {"SWIT5", &Control::swit5, "-", "next", switch_id},
                     {"SWIT6", &Control::swit6, "-", "next", switch_id},
                     {"SWIT7", &Control::swit7, "-", "last", switch_id}}}}}};

const RegisterKeyword<TerminationSensor> termination_sensor{
    {.names = {"TERMINATION_SENSOR"},
     .purpose = "the run ends when a switch is on",
     .cards = {{.fields = {{"SWID", &TerminationSensor::swid, "-", "switch", required_id}}}}}};

class SensorReader {
 public:
  SensorReader(const Deck& deck, const Model& model, const World& world, Diagnostics& diagnostics)
      : deck_(deck), model_(model), diagnostics_(diagnostics) {
    for (Index n = 0; n < world.nodes.size(); ++n) node_of_id_.emplace(world.nodes.id[n], n);
  }

  std::shared_ptr<SensorBoard> read() {
    for (const Node& card : deck_.all<Node>()) add(card);
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

  void add(const Node& card) {
    if (find(sensors_, card.sensid) >= 0)
      return error(card, "SENSID", fmt::format("sensor {} is defined twice", card.sensid),
                   "give it another number");
    NodeSensor out;
    out.id = card.sensid;
    out.node = node(card, "NODE1", card.node1);
    if (card.node2 != 0) out.base = node(card, "NODE2", card.node2);
    out.velocity = card.ctype == "VEL";
    if (card.ctype != "COORD" && card.ctype != "VEL")
      error(card, "CTYPE",
            fmt::format("'{}' is not supported", card.ctype.empty() ? "ACC (blank)" : card.ctype),
            "COORD or VEL: accelerations are of single steps");
    set_direction(card, out);
    sensors_.push_back(out);
  }

  void set_direction(const Node& card, NodeSensor& out) {
    if (card.vid.empty() || card.vid == "0") return;
    constexpr std::string_view axes = "XYZ";
    const auto axis = card.vid.size() == 1 ? axes.find(card.vid[0]) : std::string_view::npos;
    if (axis != std::string_view::npos) {
      out.direction[static_cast<Eigen::Index>(axis)] = 1;
      return;
    }
    Id id = 0;
    const auto [end, fault] = std::from_chars(card.vid.data(), card.vid.data() + card.vid.size(), id);
    const auto vector = model_.vectors.find(id);
    if (fault != std::errc() || end != card.vid.data() + card.vid.size() || vector == model_.vectors.end())
      return error(card, "VID", fmt::format("vector {} does not exist", card.vid),
                   "X, Y, Z, or a *DEFINE_VECTOR");
    const Vec along = vector->second.head - vector->second.tail;
    if (vector->second.moves || !(along.norm() > 0))
      return error(card, "VID", fmt::format("vector {} turns with nodes, or has no direction", card.vid),
                   "give it by two places that differ");
    out.direction = along.normalized();
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
    if (!of_time) out.sensor = find_sensor(card);
    switches_.push_back(out);
  }

  int find_sensor(const Switch& card) {
    const int found = find(sensors_, card.sensid);
    if (found >= 0) return found;
    const auto& forces = deck_.all<Force>();
    const auto force =
        std::find_if(forces.begin(), forces.end(), [&](const Force& f) { return f.sensid == card.sensid; });
    if (force != forces.end())
      error(card, "SENSID",
            fmt::format("sensor {} is a force ({}), by which nothing can be switched", card.sensid,
                        force->ftype),
            "use a *SENSOR_DEFINE_NODE");
    else
      error(card, "SENSID", fmt::format("sensor {} does not exist", card.sensid),
            "define it with *SENSOR_DEFINE_NODE");
    return -1;
  }

  void add(const Control& card) {
    SensorControl out{.id = card.cntlid, .motion = card.typid, .on_first = card.initstt != "OFF"};
    out.repeats = card.nrep;
    if (card.type != "PRESC-MOT")
      return error(card, "TYPE", fmt::format("'{}' is not supported", card.type), "PRESC-MOT");
    if (!card.initstt.empty() && card.initstt != "ON" && card.initstt != "OFF")
      error(card, "INITSTT", fmt::format("'{}' is not supported", card.initstt), "ON or OFF");
    if (card.nrep < -1) error(card, "NREP", fmt::format("'{}' is not supported", card.nrep), "-1 or more");
    if (!has_motion_of_nodes(deck_, card.typid))
      error(card, "TYPEID", fmt::format("no prescribed motion of nodes has the number {}", card.typid),
            "give it one by *BOUNDARY_PRESCRIBED_MOTION_SET_ID");
    const std::pair<const char*, Id> fields[] = {
        {"SWIT1", card.swit1}, {"SWIT2", card.swit2}, {"SWIT3", card.swit3}, {"SWIT4", card.swit4},
        {"SWIT5", card.swit5}, {"SWIT6", card.swit6}, {"SWIT7", card.swit7}};
    for (const auto& [field, id] : fields) {
      if (id == 0) break;
      const int k = find(switches_, id);
      if (k < 0)
        return error(card, field, fmt::format("switch {} does not exist", id),
                     "define it with *SENSOR_SWITCH");
      out.switches.push_back(k);
    }
    for (const SensorControl& other : controls_)
      if (other.motion == out.motion)
        return error(card, "TYPEID", fmt::format("control {} switches this motion already", other.id),
                     "give it all of its switches");
    controls_.push_back(std::move(out));
  }

  const Deck& deck_;
  const Model& model_;
  Diagnostics& diagnostics_;
  std::unordered_map<Id, Index> node_of_id_;
  std::vector<NodeSensor> sensors_;
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

SensorBoard* sensors_of(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics) {
  const std::vector<SensorBoard*> known = world.passes.all<SensorBoard>();
  if (!known.empty()) return known.front();
  if (deck.all<Node>().empty() && deck.all<Switch>().empty() && deck.all<Control>().empty()) return nullptr;
  return world.passes.add(SensorReader(deck, model, world, diagnostics).read()).get();
}

}  // namespace courant
