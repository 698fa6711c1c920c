// *SENSOR_DEFINE_ELEMENT and _SET, and *SENSOR_DEFINE_FORCE of cross sections.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>

#include "elements/discrete/discrete.hpp"
#include "elements/histories/element_choice.hpp"
#include "elements/histories/history_cards.hpp"
#include "elements/histories/secforc.hpp"
#include "keyword/registry.hpp"
#include "loads/sensors/sensor_force.hpp"
#include "loads/sensors/sensors.hpp"

namespace courant {

namespace {

struct SensorDefineElement : SensorDefineElementFields {
  bool of_set() const { return name == 1; }
};

using ElementSensor = SensorDefineElement;
const RegisterKeyword<ElementSensor> sensor_define_element{sensor_define_element_table()};

using Number = std::function<Real(const World&)>;

class ElementSensors {
 public:
  ElementSensors(const Deck& deck, const Model& model, const World& world, Diagnostics& diagnostics)
      : deck_(deck), diagnostics_(diagnostics), choice_(deck, model, world, diagnostics) {}

  void add(const ElementSensor& card) {
    const bool spring = card.etype == "DISC-ELE";
    std::vector<Number> members;
    if (spring ? !read_spring(card, members) : !read_elements(card, members)) return;
    const auto combine = combination(card);
    if (!combine || (members.empty() && !spring)) return;
    Sensor out{.id = card.sensid, .value = nullptr, .card = card};
    const Real sf = card.sf;
    out.value = [members, combine, sf](const World& world, const Clock&) {
      std::vector<Real> values;
      for (const Number& one : members) values.push_back(one(world));
      return sf * combine(values);
    };
    if (spring)
      out.there = [id = card.elemid](const World& world) { return find_spring(world, id).has_value(); };
    out_.push_back(std::move(out));
  }
  std::vector<Sensor> take() { return std::move(out_); }

 private:
  using Combine = Real (*)(const std::vector<Real>&);

  void error(const ElementSensor& card, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
  }
  bool refuse(const ElementSensor& card, const char* field, const std::string& text, const char* hint) {
    error(card, field, fmt::format("'{}' is not supported", text), hint);
    return false;
  }

  Combine combination(const ElementSensor& card) {
    if (!card.of_set()) return [](const std::vector<Real>& values) { return values.front(); };
    const std::map<std::string, Combine> known{
        {"AVG",
         [](const std::vector<Real>& v) {
           return std::accumulate(v.begin(), v.end(), Real(0)) / static_cast<Real>(v.size());
         }},
        {"MAX", [](const std::vector<Real>& v) { return *std::max_element(v.begin(), v.end()); }},
        {"MIN", [](const std::vector<Real>& v) { return *std::min_element(v.begin(), v.end()); }},
        {"SUM", [](const std::vector<Real>& v) { return std::accumulate(v.begin(), v.end(), Real(0)); }}};
    if (const auto found = known.find(card.setopt); found != known.end()) return found->second;
    refuse(card, "SETOPT", card.setopt.empty() ? "blank" : card.setopt, "give AVG, MAX, MIN or SUM");
    return nullptr;
  }

  bool read_elements(const ElementSensor& card, std::vector<Number>& out) {
    const std::map<std::string, ElementKind> kinds{{"", ElementKind::beam},
                                                   {"BEAM", ElementKind::beam},
                                                   {"SHELL", ElementKind::shell},
                                                   {"SOLID", ElementKind::solid}};
    const auto kind = kinds.find(card.etype);
    if (kind == kinds.end()) return refuse(card, "ETYPE", card.etype, "BEAM, SHELL, SOLID or DISC-ELE");
    const auto number = number_of(card, kind->second);
    if (!number) return false;
    std::vector<ReportedElement> elements;
    if (card.of_set()) {
      elements = choice_.set(card, "ELEMID", kind->second, card.elemid, "the sensor");
      if (elements.empty() && diagnostics_.ok())
        error(card, "ELEMID", "no element of the set deforms", "name others");
    } else if (const auto* one = choice_.find(card, "ELEMID", kind->second, card.elemid, "the sensor")) {
      elements.push_back(*one);
    } else if (diagnostics_.ok()) {
      error(card, "ELEMID", "a rigid element has no stress and never fails", "name one that deforms");
    }
    const bool pull = card.ctype == "FAIL" || (card.ctype == "FORCE" && card.comp == "AXIAL");
    for (const ReportedElement& one : elements)
      if (!pull && !one.reporter->bends()) {
        error(card, "COMP", "trusses and cables have no moments and no shear", "AXIAL, with FORCE");
        return false;
      }
    for (const ReportedElement& one : elements)
      out.push_back([one, number](const World& world) {
        return number(one.reporter->report_element(world, one.e, {}));
      });
    return !out.empty();
  }

  /// What of an element's report it is; null: refused.
  std::function<Real(const ElementReport&)> number_of(const ElementSensor& card, ElementKind kind) {
    if (card.ctype == "FAIL") return [](const ElementReport& report) { return Real(report.deleted); };
    const bool beam = kind == ElementKind::beam, moment = card.ctype == "MOMENT";
    if (beam && (moment || card.ctype == "FORCE")) {
      const std::map<std::string, std::size_t> at{
          {"AXIAL", moment ? 5 : 0}, {"SHEARS", moment ? 3 : 1}, {"SHEART", moment ? 4 : 2}};
      if (const auto k = at.find(card.comp); k != at.end())
        return [k = k->second](const ElementReport& report) { return report.resultants[k]; };
      refuse(card, "COMP", card.comp.empty() ? "XX (blank)" : card.comp,
             "of beams AXIAL (with MOMENT: torsion), SHEARS or SHEART (about s, about t)");
      return nullptr;
    }
    if (!beam && card.ctype == "STRESS") return stress_of(card, kind);
    refuse(card, "CTYPE", card.ctype.empty() ? "STRAIN (blank)" : card.ctype,
           beam ? "FORCE, MOMENT or FAIL" : "STRESS or FAIL");
    return nullptr;
  }
  std::function<Real(const ElementReport&)> stress_of(const ElementSensor& card, ElementKind kind) {
    constexpr std::array names{"XX", "YY", "ZZ", "XY", "YZ", "ZX"};
    const auto* const name =
        card.comp.empty() ? names.begin() : std::find(names.begin(), names.end(), card.comp);
    if (name == names.end()) {
      refuse(card, "COMP", card.comp, "XX, YY, ZZ, XY, YZ or ZX");
      return nullptr;
    }
    const bool top = kind == ElementKind::shell && card.layer == "TOP";
    if (!card.layer.empty() && card.layer != "TOP" && card.layer != "BOT") {
      refuse(card, "LAYER", card.layer, "BOT or TOP");
      return nullptr;
    }
    return [k = static_cast<std::size_t>(name - names.begin()), top](const ElementReport& report) {
      if (report.deleted || report.points.empty()) return Real(0);
      return (top ? report.points.back() : report.points.front()).stress[k];
    };
  }

  bool read_spring(const ElementSensor& card, std::vector<Number>& out) {
    if (card.of_set())
      return refuse(card, "ETYPE", "DISC-ELE of a set", "give each a sensor, and *SENSOR_DEFINE_CALC-MATH");
    if (card.ctype != "FORCE" && card.ctype != "DLEN")
      return refuse(card, "CTYPE", card.ctype.empty() ? "STRAIN (blank)" : card.ctype, "FORCE or DLEN");
    const bool force = card.ctype == "FORCE";
    out.push_back([id = card.elemid, force](const World& world) {
      const SpringForce spring = find_spring(world, id).value_or(SpringForce{});
      return force ? spring.resultant : spring.stretch;
    });
    return true;
  }
  static std::optional<SpringForce> find_spring(const World& world, Id id) {
    for (const auto* pass : world.passes.all<const SpringReporter>())
      if (const auto spring = pass->find_spring(id)) return spring;
    return std::nullopt;
  }

  const Deck& deck_;
  Diagnostics& diagnostics_;
  ElementChoice choice_;
  std::vector<Sensor> out_;
};

const RegisterSensors sensors_of_elements{
    [](const Deck& deck, const Model& model, const World& world, Diagnostics& diagnostics) {
      if (deck.all<ElementSensor>().empty()) return std::vector<Sensor>{};
      ElementSensors sensors(deck, model, world, diagnostics);
      for (const ElementSensor& card : deck.all<ElementSensor>()) sensors.add(card);
      return sensors.take();
    }};

/// Along global axes; nothing: there is no such section.
std::optional<SectionForce> force_of_section(const World& world, Id id) {
  for (const auto* all : world.passes.all<const CrossSections>())
    for (const CrossSection& section : all->sections)
      if (section.id == id) {
        SectionForce out = section.force(world);
        out.force = section.axes * out.force, out.moment = section.axes * out.moment;
        return out;
      }
  return std::nullopt;
}

const RegisterSensors sensors_of_sections{[](const Deck& deck, const Model& model, const World&,
                                             Diagnostics& diagnostics) {
  std::vector<Sensor> out;
  for (const SensorDefineForce& card : deck.all<SensorDefineForce>()) {
    if (card.ftype != "XSECTION" && card.ftype != "X-SECTION") continue;
    const SensorAxis axis = sensor_axis(deck, model, card, true, diagnostics);
    out.push_back(
        {.id = card.sensid,
         .value =
             [id = card.typeid_, axis](const World& world, const Clock&) {
               const auto f = force_of_section(world, id).value_or(SectionForce{});
               return axis.of(f.force, f.moment);
             },
         .there = [id = card.typeid_](const World& world) { return force_of_section(world, id).has_value(); },
         .card = card});
  }
  return out;
}};

}  // namespace

IdSpace measured_space(const SensorDefineElementFields& fields) {
  const auto& card = static_cast<const SensorDefineElement&>(fields);
  if (card.of_set())
    return card.etype == "SOLID"   ? IdSpace::solid_set
           : card.etype == "SHELL" ? IdSpace::shell_set
           : card.etype == "BEAM"  ? IdSpace::beam_set
                                   : IdSpace::none;
  return card.etype == "SOLID"      ? IdSpace::solid
         : card.etype == "SHELL"    ? IdSpace::shell
         : card.etype == "DISC-ELE" ? IdSpace::discrete
                                    : IdSpace::beam;
}

std::string keep_scale_of_element(SensorDefineElementFields& card, const Conversion& conversion) {
  return conversion.units.any() && card.sf != 1
             ? "SF goes with units that are not converted: put the card into a file without unit factors"
             : "";
}

}  // namespace courant
