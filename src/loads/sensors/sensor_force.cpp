#include "loads/sensors/sensor_force.hpp"
#include "loads/load_cards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <vector>

#include "keyword/registry.hpp"
#include "state/reports.hpp"

namespace courant {

namespace {

using ForceSensor = SensorDefineForce;

const RegisterKeyword<ForceSensor> sensor_define_force{sensor_define_force_table()};

std::vector<JointForce> forces_of_joint(const World& world, Id id) {
  std::vector<JointForce> all, out;
  for (const auto* pass : world.passes.all<const JointReporter>()) pass->report_joints(all);
  std::copy_if(all.begin(), all.end(), std::back_inserter(out),
               [&](const JointForce& one) { return one.id == id; });
  return out;
}

Sensor sensor_of(const ForceSensor& card, const SensorAxis& axis) {
  const Id id = card.typeid_;
  Sensor out{.id = card.sensid, .value = nullptr, .card = card};
  if (card.ftype == "JOINT") {
    out.there = [id](const World& world) { return !forces_of_joint(world, id).empty(); };
    out.value = [id, axis](const World& world, const Clock&) {
      Vec force = Vec::Zero(), moment = Vec::Zero();
      for (const JointForce& one : forces_of_joint(world, id)) force += one.force, moment += one.moment;
      return axis.of(force, moment);
    };
    return out;
  }
  const auto find = card.ftype == "RWALL" ? force_on_wall : force_of_contact;
  out.there = [id, find](const World& world) { return find(world, id).has_value(); };
  out.value = [id, find, axis](const World& world, const Clock&) {
    return axis.of(find(world, id).value_or(Vec::Zero()));
  };
  return out;
}

/// Of other kinds of forces there is no sensor here; a request for one is reported.
const RegisterSensors sensors_of_forces{
    [](const Deck& deck, const Model& model, const World&, Diagnostics& diagnostics) {
      std::vector<Sensor> out;
      for (const ForceSensor& card : deck.all<ForceSensor>())
        if (card.ftype == "JOINT" || card.ftype == "CONTACT" || card.ftype == "RWALL")
          out.push_back(sensor_of(card, sensor_axis(deck, model, card, card.ftype == "JOINT", diagnostics)));
      return out;
    }};

}  // namespace

IdSpace exerting_space(const SensorDefineForce& f) {
  return f.ftype == "CONTACT"                         ? IdSpace::contact
         : f.ftype == "JOINT"                         ? IdSpace::joint
         : f.ftype == "RWALL"                         ? IdSpace::rigid_wall
         : f.ftype == "SPC" || f.ftype == "PRESC-MOT" ? IdSpace::boundary
                                                      : IdSpace::none;
}

std::optional<Vec> force_of_contact(const World& world, Id id) {
  std::optional<Vec> sum;
  for (const auto* pass : world.passes.all<const InterfaceReporter>())
    if (const InterfaceForce one = pass->report(); one.id == id)
      sum = sum.value_or(Vec::Zero()) + one.on_surfa;
  return sum;
}

std::optional<Vec> force_on_wall(const World& world, Id id) {
  for (const auto* wall : world.passes.all<const RigidWallReporter>())
    if (const RigidWallForce one = wall->report_wall(); one.id == id) return one.force;
  return std::nullopt;
}

Vec sensor_direction(const Deck& deck, const Model& model, const Entry& card, const std::string& vid,
                     Diagnostics& diagnostics) {
  if (vid.empty() || vid == "0") return Vec::Zero();
  constexpr std::string_view axes = "XYZ";
  const auto axis = vid.size() == 1 ? axes.find(vid[0]) : std::string_view::npos;
  if (axis != std::string_view::npos) return Vec::Unit(static_cast<Eigen::Index>(axis));
  Id id = 0;
  const auto [end, fault] = std::from_chars(vid.data(), vid.data() + vid.size(), id);
  const bool whole = fault == std::errc() && end == vid.data() + vid.size();
  const auto vector = whole ? model.vectors.find(id) : model.vectors.end();
  if (vector == model.vectors.end()) {
    deck.error(diagnostics, card, "VID", fmt::format("vector {} does not exist", vid),
               "X, Y, Z, or a *DEFINE_VECTOR");
    return Vec::Zero();
  }
  const Vec along = vector->second.head - vector->second.tail;
  if (vector->second.moves || !(along.norm() > 0))
    deck.error(diagnostics, card, "VID", fmt::format("vector {} turns with nodes, or has no direction", vid),
               "give it by two points that differ");
  return along.norm() > 0 ? Vec(along.normalized()) : Vec(Vec::Zero());
}

SensorAxis sensor_axis(const Deck& deck, const Model& model, const SensorDefineForce& card, bool moments,
                       Diagnostics& diagnostics) {
  constexpr std::string_view moment = "MOMENT";
  std::string vid = card.vid;
  SensorAxis out;
  out.moment = moments && vid.size() == moment.size() + 1 && vid.ends_with(moment);
  if (out.moment) vid.resize(1);
  out.along = vid == "M" ? Vec(Vec::Zero()) : sensor_direction(deck, model, card, vid, diagnostics);
  return out;
}

}  // namespace courant
