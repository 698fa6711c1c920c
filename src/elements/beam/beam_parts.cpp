#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "elements/beam/beams.hpp"
#include "elements/beam/integration_beam.hpp"
#include "elements/beam/section_beam.hpp"
#include "elements/beam/standard_section.hpp"
#include "laws/fluid/mat_null.hpp"
#include "laws/strength/beam_stress.hpp"
#include "model/transforms/transformation.hpp"

namespace courant {

namespace {

constexpr const char* weld_material = "MAT_SPOTWELD";

/// Points of Gauss (1 to 4), or with `lobatto` three of Lobatto, on [-1, 1], and weights with the sum 1.
std::vector<std::array<Real, 2>> points_on_line(int count, bool lobatto) {
  if (lobatto) return {{-1, 1.0 / 6}, {0, 2.0 / 3}, {1, 1.0 / 6}};
  if (count == 1) return {{0, 1}};
  if (count == 2) return {{-std::sqrt(1.0 / 3), 0.5}, {std::sqrt(1.0 / 3), 0.5}};
  if (count == 3) return {{-std::sqrt(0.6), 5.0 / 18}, {0, 4.0 / 9}, {std::sqrt(0.6), 5.0 / 18}};
  const Real root = 2.0 / 7 * std::sqrt(1.2), a = std::sqrt(3.0 / 7 - root), b = std::sqrt(3.0 / 7 + root),
             wa = (18 + std::sqrt(30.0)) / 72, wb = (18 - std::sqrt(30.0)) / 72;
  return {{-b, wb}, {-a, wa}, {a, wa}, {b, wb}};
}

/// Of QR 1 to 5. Of tubes: on the circle that has their second moments.
std::vector<SectionPoint> section_points(int rule, bool tube) {
  std::vector<SectionPoint> out;
  if (tube && rule > 1) {
    const int count = rule == 2 ? 4 : rule == 5 ? 16 : 8;
    for (int k = 0; k < count; ++k) {
      const Real angle = 2 * pi * (k + 0.5) / count;
      out.push_back({std::cos(angle), std::sin(angle), Real(1) / count});
    }
    return out;
  }
  const auto line = points_on_line(rule == 5 ? 4 : std::min(rule, 3), rule == 4);
  for (const auto& [s, ws] : line)
    for (const auto& [t, wt] : line) out.push_back({s, t, ws * wt});
  return out;
}

class BeamReader {
 public:
  BeamReader(const Deck& deck, const Model& model, Diagnostics& diagnostics)
      : deck_(deck), model_(model), diagnostics_(diagnostics) {
    for (const SectionBeam& s : deck.all<SectionBeam>()) sections_.emplace(s.secid, &s);
    for (const IntegrationBeam& rule : deck.all<IntegrationBeam>())
      if (!rules_.emplace(rule.irid, &rule).second)
        error(rule, "IRID", fmt::format("rule {} is defined twice", rule.irid), "give it another number");
    const int errors = diagnostics.errors();
    const bool checked = std::any_of(model.parts.begin(), model.parts.end(), [](const ModelPart& p) {
      return !p.rigid && (p.has_solid || p.has_shell);  // with them
    });
    for (const StrengthEntry& kind : strength_registry()) {
      if (!checked) kind.check(deck, model, diagnostics);
      if (diagnostics.errors() > errors) continue;  // a law is made from valid cards
      for (const auto& [id, law] : kind.all(deck, model)) laws_[id] = {law, kind.keyword};
    }
    whole_ = diagnostics.errors() == errors;
  }

  bool read(std::size_t index, BeamPart& out) {
    const ModelPart& part = model_.parts[index];
    if (part.rigid)
      return error(part.card, "MID",
                   fmt::format("rigid beams, as those of part {}, are not supported", part.id),
                   "rigid bodies are made of shells or solids");
    const auto section = sections_.find(part.secid);
    if (section == sections_.end())
      return error(part.card, "SECID",
                   fmt::format("the beams of part {} need a *SECTION_BEAM with id {}; {}", part.id,
                               part.secid, deck_.found_instead(IdSpace::section, part.secid)),
                   "");
    const SectionBeam& s = *section->second;
    if (part.null) return read_null(index, s, out);
    if (s.used() == 6 || !check_section(s) || !whole_) return false;  // discrete beams are read elsewhere
    out.kind = s.used() == 1 ? BeamKind::integrated : s.used() == 2 ? BeamKind::resultant : BeamKind::truss;
    out.part = static_cast<Index>(index), out.nsm = s.nsm;
    const auto law = laws_.find(part.mid);
    if (law == laws_.end())
      return error(part.card, "MID",
                   fmt::format("the beams of part {} need a material with strength and id {}; {}", part.id,
                               part.mid, deck_.found_instead(IdSpace::material, part.mid)),
                   s.weld() ? "ELFORM 9 takes *MAT_SPOTWELD"
                            : "beams take isotropic materials, such as *MAT_ELASTIC or "
                              "*MAT_PIECEWISE_LINEAR_PLASTICITY");
    const std::string& name = law->second.second;
    const bool elastic = name == "MAT_ELASTIC";
    if (s.weld() || name == weld_material) {
      if (!s.weld() || name != weld_material)
        return error(part.card, "MID",
                     fmt::format("*{} is not supported in the beams of part {}", name, part.id),
                     s.weld() ? "ELFORM 9 takes *MAT_SPOTWELD" : "*MAT_SPOTWELD goes with ELFORM 9");
    } else if (!elastic && (out.kind == BeamKind::resultant || !serves_in_beams(*law->second.first)))
      return error(part.card, "MID",
                   fmt::format("*{} is not supported in the beams of part {}", name, part.id),
                   out.kind == BeamKind::resultant
                       ? "ELFORM 2 takes *MAT_ELASTIC; ELFORM 1 has plastic materials, too"
                       : "beams take isotropic materials that need no equation of state; of rubbers, foams, "
                         "fabrics and composites none");
    if ((out.kind == BeamKind::resultant || s.weld()) && has_erosion_card(deck_, part.mid))
      return error(part.card, "MID",
                   fmt::format("*MAT_ADD_EROSION is not supported in the beams of part {}, {}", part.id,
                               s.weld() ? "which are welds" : "whose section has no points"),
                   s.weld() ? "*MAT_SPOTWELD has limits of its own" : "ELFORM 1 and 3 have points");
    out.law = law->second.first;
    if (s.weld()) {
      const auto& cards = deck_.all<MatSpotweld>();
      const MatSpotweld& card = *std::find_if(cards.begin(), cards.end(),
                                              [&](const MatSpotweld& one) { return one.mid == part.mid; });
      out.weld = weld_strength(card);
      const bool bends = card.mss > 0 || card.mtt > 0, shears = card.nrs > 0 || card.nrt > 0;
      if (bends && !shears)
        deck_.warning(diagnostics_, card, card.mss > 0 ? "MSS" : "MTT",
                      "moments are those in the middle of the weld: one that is sheared between sheets that "
                      "do not turn has them at its ends alone, and does not fail",
                      "give NRS and NRT");
    }
    if (out.kind == BeamKind::integrated)
      out.points = rule_of(s) ? points_of_rule(s) : section_points(static_cast<int>(s.rule), s.tube());
    if (out.kind == BeamKind::truss) out.points = {SectionPoint()};
    for (const ModelBeam& beam : model_.beams)
      if (beam.part == out.part) add(beam, s, out);
    return true;
  }

 private:
  bool error(const Entry& card, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
    return false;
  }

  /// Beams without a stress need an area, and no directions.
  bool read_null(std::size_t index, const SectionBeam& s, BeamPart& out) {
    const ModelPart& part = model_.parts[index];
    if (s.used() == 6)
      return error(
          part.card, "MID",
          fmt::format("*MAT_NULL is not supported in the discrete beams or cables of part {}", part.id),
          "*MAT_066 to _068, or *MAT_CABLE_DISCRETE_BEAM; ELFORM 1 or 3 with *MAT_NULL weigh alone");
    if (!check_section(s)) return false;
    out.kind = BeamKind::truss, out.null = true;
    out.part = static_cast<Index>(index), out.nsm = s.nsm, out.law = mat_null_of(deck_, part.mid)->coat();
    for (const ModelBeam& beam : model_.beams) {
      if (beam.part != out.part) continue;
      BeamMeasures m;
      if (s.used() == 1) {
        const auto whole = measures_of(beam, s, BeamKind::integrated);
        if (!whole) continue;
        m = *whole;
      } else if (m.A = beam.measures[0] > 0 ? beam.measures[0] : area_of(s); !(m.A > 0)) {
        error(s, "A", fmt::format("beam {} has no area", beam.id),
              "measures are in the second line of *SECTION_BEAM, or in *ELEMENT_BEAM_THICKNESS");
        continue;
      }
      out.beams.push_back(&beam), out.measures.push_back(m), out.axes.push_back(Matrix::Identity());
    }
    return true;
  }

  bool check_section(const SectionBeam& s) {
    if (!checked_.insert(&s).second) return refused_.count(&s) == 0;
    bool good = true;
    const auto refuse = [&](const char* field, std::string message, const char* hint) {
      good = error(s, field, std::move(message), hint);
      refused_.insert(&s);
    };
    if (s.used() == 0)
      refuse("ELFORM", fmt::format("'{}' is not supported", s.elform),
             "supported: 1 (Hughes-Liu), 2 (Belytschko-Schwer), 3 (truss), 6 (cable), 9 (weld); 4 and 5 "
             "become 1, 13 "
             "becomes 2");
    else if (s.elform > 3 && !s.weld())
      deck_.warning(diagnostics_, s, "ELFORM",
                    fmt::format("{} is not supported: {} is used instead", s.elform, s.used()),
                    "the same formulation by its own number says the same without this warning");
    if (!s.stype.empty() && s.used() > 0) {
      if (!check_standard(s)) good = false, refused_.insert(&s);
      return good;
    }
    if (s.used() != 1 && s.rule < 0)
      deck_.warning(diagnostics_, s, "QR/IRID", fmt::format("has no effect with ELFORM {}", s.elform),
                    "a rule of *INTEGRATION_BEAM is for ELFORM 1");
    if (s.used() == 1 && s.rule < 0) {
      if (!check_rule(s)) good = false, refused_.insert(&s);
      return good;
    }
    if (s.used() == 1 && !(s.rule >= 1 && s.rule <= 5 && s.rule == std::floor(s.rule)))
      refuse(
          "QR/IRID", fmt::format("'{:g}' is not supported", s.rule),
          "1 to 5: one point, 2 x 2, 3 x 3 of Gauss, 3 x 3 of Lobatto, 4 x 4 of Gauss; minus the IRID of an "
          "*INTEGRATION_BEAM");
    if (s.used() == 1 && s.cst != 0 && s.cst != 1)
      refuse("CST", fmt::format("'{:g}' is not supported", s.cst),
             "0 for a rectangle, 1 for a tube; 2 goes with a rule of *INTEGRATION_BEAM");
    return good;
  }

  /// SECTION_01 ... in the second line: a rule of *INTEGRATION_BEAM with that ICST.
  bool check_standard(const SectionBeam& s) {
    constexpr std::string_view word = "SECTION_";
    std::string type = s.stype;
    for (char& c : type) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    IntegrationBeam rule;
    if (type.compare(0, word.size(), word) != 0 || type.size() > word.size() + 2)
      return error(s, "STYPE", fmt::format("'{}' is no standard section", s.stype),
                   "SECTION_01 to SECTION_11");
    for (const char c : type.substr(word.size())) rule.icst = 10 * rule.icst + (c - '0');
    rule.d1 = s.d1, rule.d2 = s.d2, rule.d3 = s.d3, rule.d4 = s.d4, rule.k = 1;
    std::string why;
    const StandardSection section = standard_section(rule.icst, rule.dimensions(), rule.k, why);
    if (section.cells.empty())
      return error(s, rule.icst < 1 || rule.icst == 10 || rule.icst > 11 ? "STYPE" : "D1", std::move(why),
                   "or give the area and second moments, with ELFORM 2");
    const StandardSection::Moments m = section.moments();
    constexpr Real round_off = 1e-9;
    if (s.used() == 2 && std::abs(m.st) > round_off * (m.ss + m.tt))
      return error(s, "STYPE", fmt::format("the axes s and t of {} are not its principal axes", s.stype),
                   "ELFORM 1 takes it");
    const IntegrationBeam* kept = &own_rules_.emplace(&s, rule).first->second;
    standard_[kept] = section;
    return true;
  }
  /// Null: the section has points of its own.
  const IntegrationBeam* rule_of(const SectionBeam& s) const {
    if (const auto own = own_rules_.find(&s); own != own_rules_.end()) return &own->second;
    return s.rule < 0 ? rules_.at(static_cast<Id>(-s.rule)) : nullptr;
  }
  Real area_of(const SectionBeam& s) const {
    return s.stype.empty() ? s.a : standard_.at(rule_of(s)).moments().area;
  }

  /// The rule that a section names.
  bool check_rule(const SectionBeam& s) {
    const auto found = rules_.find(static_cast<Id>(-s.rule));
    if (found == rules_.end() || s.rule != std::floor(s.rule))
      return error(s, "QR/IRID", fmt::format("rule {:g} does not exist", -s.rule),
                   "define it with *INTEGRATION_BEAM");
    const IntegrationBeam& rule = *found->second;
    if (s.tube() || (s.cst != 0 && s.cst != 2))
      return error(s, s.weld() || s.elform == 5 ? "QR/IRID" : "CST",
                   "a tube has points of its own, beside a rule of *INTEGRATION_BEAM",
                   "use ELFORM 1 and CST 2, or 0");
    if (rule.icst > 0 && (rule.nip > 0 || rule.ra > 0))
      return error(rule, "NIP", "points and RA are given with the standard section ICST", "give one of them");
    if (rule.icst > 0) return read_standard(rule);
    if (rule.nip == 0 || static_cast<int>(rule.s.size()) != rule.nip)
      return error(rule, "NIP", fmt::format("{} points are given, not {}", rule.s.size(), rule.nip),
                   "give each point a card, or ICST a standard section");
    if (!(rule.ra > 0))
      return error(rule, "RA", "the section has no area", "give its area over that of TS1 x TT1");
    Real sum = 0;
    for (std::size_t k = 0; k < rule.s.size(); ++k) {
      if (!(std::abs(rule.s[k]) <= 1 && std::abs(rule.t[k]) <= 1))
        return error(
            rule, "S",
            fmt::format("point {} lies outside of the section: {:g}, {:g}", k + 1, rule.s[k], rule.t[k]),
            "S and T are from -1 to 1");
      if (rule.pid[k] != 0)
        return error(rule, "PID", fmt::format("point {} has a material of its own", k + 1),
                     "materials that differ by point are not supported: leave PID 0");
      sum += rule.wf[k];
    }
    constexpr Real close = 1e-3;  // weights are written with few digits
    if (std::abs(sum - 1) < close) return true;
    return error(rule, "WF", fmt::format("the weights sum up to {:g}, not 1", sum),
                 "each is the share of the area");
  }
  bool read_standard(const IntegrationBeam& rule) {
    constexpr int finest = 20;
    if (rule.k < 0 || rule.k > finest)
      return error(rule, "K", fmt::format("'{}' is not supported", rule.k), fmt::format("0 to {}", finest));
    std::string why;
    const auto section = standard_section(rule.icst, rule.dimensions(), rule.k, why);
    if (section.cells.empty())
      return error(rule, rule.icst > 9 && rule.icst != 11 ? "ICST" : "D1", std::move(why),
                   "or give the points of the section by NIP, S, T and WF");
    standard_[&rule] = section;
    return true;
  }
  /// In shares of half the widths, and of the area.
  std::vector<SectionPoint> points_of_rule(const SectionBeam& s) const {
    const IntegrationBeam& rule = *rule_of(s);
    std::vector<SectionPoint> out;
    if (rule.icst == 0) {
      Real sum = 0;
      for (const Real wf : rule.wf) sum += wf;
      for (std::size_t k = 0; k < rule.s.size(); ++k) out.push_back({rule.s[k], rule.t[k], rule.wf[k] / sum});
      return out;
    }
    const StandardSection& section = standard_.at(&rule);
    Real area = 0;
    for (const SectionCell& cell : section.cells) area += cell.area;
    for (const SectionCell& cell : section.cells)
      out.push_back({2 * cell.s / section.width_s, 2 * cell.t / section.width_t, cell.area / area});
    return out;
  }
  /// Of a section whose points are known; `ts`, `tt`: widths of the beam, of which a standard section has its
  /// own.
  BeamMeasures measures_of_rule(const SectionBeam& s, Real ts, Real tt) const {
    const IntegrationBeam& rule = *rule_of(s);
    BeamMeasures m;
    m.A = rule.ra * ts * tt, m.half_s = ts / 2, m.half_t = tt / 2;
    if (rule.icst > 0) {
      const StandardSection& section = standard_.at(&rule);
      m.A = 0, m.half_s = section.width_s / 2, m.half_t = section.width_t / 2;
      for (const SectionCell& cell : section.cells) m.A += cell.area;
    }
    Real of_s = 0, of_t = 0, of_st = 0;
    for (const SectionPoint& point : points_of_rule(s)) {
      const Real at_s = point.s * m.half_s, at_t = point.t * m.half_t, area = point.share * m.A;
      m.Iss += area * at_t * at_t, m.Itt += area * at_s * at_s;
      of_s += area * at_s, of_t += area * at_t, of_st += area * at_s * at_t;
    }
    constexpr Real round_off = 1e-9;
    m.coupled = std::abs(of_s) > round_off * m.A * m.half_s || std::abs(of_t) > round_off * m.A * m.half_t ||
                std::abs(of_st) > round_off * m.A * m.half_s * m.half_t;
    return m;
  }

  /// The measures of one beam; of end 1 and 2 the mean.
  std::optional<BeamMeasures> measures_of(const ModelBeam& beam, const SectionBeam& s, BeamKind kind) {
    const auto own = [&](std::size_t k, Real of_section) {
      return beam.measures[k] > 0 ? beam.measures[k] : of_section;
    };
    if (beam.measures[4] < 0)
      error(beam.card, "PARM5", fmt::format("expected a number >= 0, got '{:g}'", beam.measures[4]),
            "only cables (ELFORM 6) have an offset there");
    BeamMeasures m;
    if (kind == BeamKind::truss) {
      m.A = own(0, area_of(s));
    } else if (kind == BeamKind::resultant && !s.stype.empty()) {
      const StandardSection& section = standard_.at(rule_of(s));
      const StandardSection::Moments of = section.moments();
      m.A = own(0, of.area), m.Iss = own(1, of.ss), m.Itt = own(2, of.tt), m.J = own(3, section.torsion);
      m.shear_area = own(4, section.shear);
    } else if (kind == BeamKind::resultant) {
      m.A = own(0, s.a), m.Iss = own(1, s.iss), m.Itt = own(2, s.itt), m.J = own(3, s.j);
      m.shear_area = own(4, s.sa);
      if (m.Itt == 0) m.Itt = m.Iss;
      if (m.J == 0) m.J = m.Iss + m.Itt;
    } else {
      const Real ts1 = own(0, s.ts1), ts2 = own(1, s.ts2), tt1 = own(2, s.tt1), tt2 = own(3, s.tt2);
      const Real ts = 0.5 * (ts1 + (ts2 > 0 ? ts2 : ts1)), tt = 0.5 * (tt1 + (tt2 > 0 ? tt2 : tt1));
      if (const IntegrationBeam* rule = rule_of(s)) {
        m = measures_of_rule(s, ts, tt);
        if (rule->icst > 0 && beam.measures[0] > 0)
          deck_.warning(diagnostics_, beam.card, "PARM1",
                        "widths of *ELEMENT_BEAM_THICKNESS have no effect on a standard section (ICST)",
                        "give D1 to D4 of *INTEGRATION_BEAM");
      } else if (s.tube()) {
        m.A = pi / 4 * (ts * ts - tt * tt);
        m.half_s = m.half_t = std::sqrt((ts * ts + tt * tt) / 8);
        m.Iss = m.Itt = m.A * m.half_s * m.half_s / 2;
      } else {
        m.A = ts * tt, m.half_s = ts / 2, m.half_t = tt / 2;
        m.Iss = m.A * tt * tt / 12, m.Itt = m.A * ts * ts / 12;
      }
      m.J = m.Iss + m.Itt, m.shear_area = s.shrf * m.A;
    }
    if (kind == BeamKind::truss && beam.measures[2] != 0)
      error(beam.card, "PARM3", "a stress at the start of trusses is not supported",
            "leave the field blank or 0");
    const auto idle = [&](const char* field, Real value) {
      if (value > 0)
        deck_.warning(diagnostics_, beam.card, field,
                      fmt::format("'{:g}' has no effect with ELFORM {}", value, s.used()), "leave it blank");
    };
    if (kind == BeamKind::truss) idle("PARM2", beam.measures[1]), idle("PARM4", beam.measures[3]);
    if (kind != BeamKind::resultant) idle("PARM5", beam.measures[4]);
    const bool good = m.A > 0 && (kind == BeamKind::truss || (m.Iss > 0 && m.Itt > 0));
    if (good) return m;
    error(s,
          kind == BeamKind::integrated ? "TS1"
          : m.A > 0                    ? "ISS"
                                       : "A",
          fmt::format("beam {} has no area, or no second moment of it", beam.id),
          "measures are in the second line of *SECTION_BEAM, or in *ELEMENT_BEAM_THICKNESS");
    return std::nullopt;
  }

  /// RT1 to RR2; nothing, and an error, where they are not supported.
  std::optional<BeamReleases> releases_of(const ModelBeam& beam, bool resultant) {
    constexpr std::array fields{"RT1", "RR1", "RT2", "RR2"};
    for (std::size_t k = 0; k < fields.size(); ++k) {
      const int code = beam.released[k];
      if (code == 0) continue;
      const bool slides_across = k % 2 == 0 && code != 1;
      if (resultant && !slides_across && !beam.released_globally) continue;
      error(beam.card, fields[k],
            !resultant ? fmt::format("the ends of beam {} cannot be released", beam.id)
            : slides_across
                ? fmt::format("'{}' is not supported: beam {} would slide across its line", code, beam.id)
                : fmt::format("beam {} is released along or about global axes (LOCAL 1)", beam.id),
            !resultant      ? "only beams with ELFORM 2 or 13 have releases"
            : slides_across ? "1, along r, is supported"
                            : "give LOCAL 2, the axes of the beam");
      return std::nullopt;
    }
    BeamReleases out;
    out.pull = beam.released[0] != 0 || beam.released[2] != 0;
    out.turns = {axes_of_code(beam.released[1]), axes_of_code(beam.released[3])};
    return out;
  }

  void add(const ModelBeam& beam, const SectionBeam& s, BeamPart& out) {
    const auto m = measures_of(beam, s, out.kind);
    const auto releases = releases_of(beam, out.kind == BeamKind::resultant);
    if (!m || !releases) return;
    const auto x = [&](Index n) { return model_.nodes[static_cast<std::size_t>(n)].x; };
    const Vec between = x(beam.node[1]) - x(beam.node[0]), r = between.normalized();
    if (!(between.norm() > 0)) {
      error(beam.card, "N2", fmt::format("beam {} has no length", beam.id), "");
      return;
    }
    Vec s_axis = beam.direction.norm() > 0 ? beam.direction
                 : beam.third >= 0         ? Vec(x(beam.third) - x(beam.node[0]))
                                           : Vec(Vec::Zero());
    const Real asked = s_axis.norm();
    s_axis -= s_axis.dot(r) * r;
    constexpr Real sliver = 1e-6, same = 1e-9;
    if (!(s_axis.norm() > sliver * asked)) {
      if (out.kind != BeamKind::truss &&
          (m->coupled || std::abs(m->Iss - m->Itt) > same * m->Iss || releases->tell_axes())) {
        error(beam.card, "N3", fmt::format("beam {} has no direction of its axis s", beam.id),
              "give it a third node off the line from N1 to N2, or a direction by _ORIENTATION");
        return;
      }
      int least = 0;  // any direction will do
      r.cwiseAbs().minCoeff(&least);
      s_axis = Vec::Unit(least) - r[least] * r;
    }
    Matrix axes;
    axes.col(0) = r, axes.col(1) = s_axis.normalized(), axes.col(2) = r.cross(Vec(axes.col(1)));
    if (releases->any()) out.releases.resize(out.beams.size());
    if (releases->any() || !out.releases.empty()) out.releases.push_back(*releases);
    out.beams.push_back(&beam), out.measures.push_back(*m), out.axes.push_back(axes);
  }

  const Deck& deck_;
  const Model& model_;
  Diagnostics& diagnostics_;
  bool whole_ = true;  ///< the cards of materials
  std::map<Id, const SectionBeam*> sections_;
  std::map<Id, const IntegrationBeam*> rules_;
  std::map<const SectionBeam*, IntegrationBeam> own_rules_;  // of standard sections in *SECTION_BEAM
  std::map<const IntegrationBeam*, StandardSection> standard_;
  std::map<Id, std::pair<std::shared_ptr<StrengthLaw>, std::string>> laws_;
  std::set<const SectionBeam*> checked_, refused_;
};

}  // namespace

std::vector<BeamPart> find_beam_parts(const Deck& deck, const Model& model, Diagnostics& diagnostics) {
  std::vector<BeamPart> out(model.parts.size());
  if (model.beams.empty()) return out;
  BeamReader reader(deck, model, diagnostics);
  for (std::size_t k = 0; k < model.parts.size(); ++k)
    if (model.parts[k].has_beam && !reader.read(k, out[k])) out[k] = {};
  read_preloads(deck, model, out, diagnostics);
  return out;
}

}  // namespace courant
