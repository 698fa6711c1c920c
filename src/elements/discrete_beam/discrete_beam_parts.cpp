#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "base/rotation.hpp"
#include "elements/beam/section_beam.hpp"
#include "elements/discrete_beam/discrete_beams.hpp"

namespace courant {

namespace {

/// The least turn that brings r onto a line. Not for lines against r.
Matrix turned_onto(const Vec& line, const Matrix& axes) {
  return Eigen::Quaterniond::FromTwoVectors(axes.col(0), line).toRotationMatrix() * axes;
}

class DiscreteBeamReader {
 public:
  DiscreteBeamReader(const Deck& deck, const Model& model, Diagnostics& diagnostics)
      : deck_(deck),
        model_(model),
        diagnostics_(diagnostics),
        laws_(find_discrete_beam_laws(deck, model, diagnostics)) {}

  void read(std::size_t index, std::vector<DiscreteBeamPart>& out) {
    const ModelPart& part = model_.parts[index];
    const auto law = laws_.find(part.mid);
    const auto& sections = deck_.all<SectionBeam>();
    const auto section = std::find_if(sections.begin(), sections.end(),
                                      [&](const SectionBeam& s) { return s.secid == part.secid; });
    if (law == laws_.end() || section == sections.end() || section->used() != 6 || part.rigid) return;
    DiscreteBeamPart beams{.part = static_cast<Index>(index), .law = law->second, .triad = {}};
    if (!read_triad(*section, beams.triad)) return;
    if (checked_.insert(section->secid).second) warn_of_section(*section);
    for (const ModelBeam& beam : model_.beams)
      if (beam.part == beams.part) add(beam, *section, beams);
    out.push_back(std::move(beams));
  }

 private:
  bool error(const Entry& card, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
    return false;
  }

  bool read_triad(const SectionBeam& s, DiscreteTriad& out) {
    const int scoor = static_cast<int>(s.scoor);
    if (scoor != s.scoor || std::abs(scoor) > 3)
      return error(s, "SCOOR", fmt::format("'{:g}' is not supported", s.scoor), "supported: -3 to 3");
    out.node = scoor, out.line = std::abs(scoor) == 2, out.lever = std::abs(scoor) > 1;
    const std::array held{s.rrcon, s.srcon, s.trcon};
    for (std::size_t k = 0; k < 3; ++k) {
      if (held[k] != 0 && held[k] != 1)
        return error(s, std::array{"RRCON", "SRCON", "TRCON"}[k],
                     fmt::format("'{:g}' is not supported", held[k]), "0 or 1");
      out.held[k] = held[k] == 1;
    }
    return true;
  }

  void warn_of_section(const SectionBeam& s) {
    const auto idle = [&](const char* field, bool given) {
      if (given) deck_.warning(diagnostics_, s, field, "has no effect on discrete beams", "leave it blank");
    };
    idle("QR/IRID", s.rule < 0), idle("CST", s.cst == 2), idle("NSM", s.nsm != 0);
    idle("OFFSET", s.offset != 0);
  }

  void add(const ModelBeam& beam, const SectionBeam& s, DiscreteBeamPart& out) {
    for (std::size_t k = 0; k < beam.released.size(); ++k)
      if (beam.released[k] != 0) {
        error(beam.card, std::array{"RT1", "RR1", "RT2", "RR2"}[k],
              fmt::format("the ends of discrete beam {} cannot be released", beam.id),
              "leave the stiffness of what is free out of its material");
        return;
      }
    const auto own = [&](std::size_t k, Real of_section) {
      return beam.measures[k] != 0 ? beam.measures[k] : of_section;
    };
    const Real volume = own(0, s.vol), inertia = own(1, s.iner);
    if (!(volume > 0)) {
      error(s, "VOL", fmt::format("discrete beam {} has no volume: no mass", beam.id),
            "VOL times RO is its mass");
      return;
    }
    const auto& springs = out.law->springs;
    const bool turns = out.triad.lever || std::any_of(springs.begin() + 3, springs.end(),
                                                      [](const BeamSpring& one) { return one.acts(); });
    if (turns && !(inertia > 0)) {
      error(s, "INER", fmt::format("discrete beam {} turns its ends, which have no inertia of it", beam.id),
            out.triad.lever ? "give INER above 0, or SCOOR -1, 0 or 1 and no springs about axes"
                            : "give INER above 0");
      return;
    }
    const auto axes = axes_of(beam, s, static_cast<Id>(own(2, static_cast<Real>(s.cid))), out.triad);
    if (!axes) return;
    out.beams.push_back(&beam), out.volume.push_back(volume), out.inertia.push_back(inertia);
    out.axes.push_back(*axes);
  }

  /// CID; else r on the line between the ends and s towards the third node or direction; else global.
  std::optional<Matrix> axes_of(const ModelBeam& beam, const SectionBeam& s, Id cid,
                                const DiscreteTriad& triad) {
    const auto x = [&](Index n) { return model_.nodes[static_cast<std::size_t>(n)].x; };
    const Vec line = x(beam.node[1]) - x(beam.node[0]);
    const Vec towards = beam.direction.norm() > 0 ? beam.direction
                        : beam.third >= 0         ? Vec(x(beam.third) - x(beam.node[0]))
                                                  : Vec(Vec::Zero());
    if (triad.line && !(line.norm() > 0)) {
      error(s, "SCOOR", fmt::format("discrete beam {} has no length, and so no line for its axis r", beam.id),
            "give SCOOR -3 to -1, 0, 1 or 3");
      return std::nullopt;
    }
    if (line.norm() > 0 && !triad.lever)
      deck_.warning(diagnostics_, beam.card, "N2",
                    fmt::format("discrete beam {} is {:g} long, and its shear forces do not turn its ends: "
                                "moments do not balance",
                                beam.id, line.norm()),
                    "SCOOR -3, -2, 2 or 3 is for beams with a length");
    if (cid != 0) return axes_of_system(beam, s, cid, triad, line);
    if (!(towards.norm() > 0) || !(line.norm() > 0)) {
      if (towards.norm() > 0)
        deck_.warning(
            diagnostics_, beam.card, "N3",
            fmt::format("has no effect on beam {}, which has no length: its axes are global", beam.id),
            "give it a CID");
      const Matrix global = Matrix::Identity();
      return triad.line ? turned_onto(line, global) : global;
    }
    const auto axes = axes_from(line, towards);
    if (axes) return axes;
    error(beam.card, "N3", fmt::format("beam {} has no direction of its axis s", beam.id),
          "give it a third node off the line from N1 to N2, or a CID");
    return std::nullopt;
  }

  std::optional<Matrix> axes_of_system(const ModelBeam& beam, const SectionBeam& s, Id cid,
                                       const DiscreteTriad& triad, const Vec& line) {
    const auto system = model_.coordinate_systems.find(cid);
    const bool own = beam.measures[2] != 0;
    const Entry& card = own ? beam.card : static_cast<const Entry&>(s);
    const char* const field = own ? "PARM3" : "CID";
    if (system == model_.coordinate_systems.end())
      error(card, field, fmt::format("coordinate system {} does not exist", cid),
            "define it with *DEFINE_COORDINATE_SYSTEM");
    else if (system->second.moves)
      error(card, field, fmt::format("system {} turns with its nodes", cid),
            "SCOOR states with which end the axes rotate: give a fixed system");
    else
      return triad.line ? turned_onto(line, system->second.axes) : system->second.axes;
    return std::nullopt;
  }

  const Deck& deck_;
  const Model& model_;
  Diagnostics& diagnostics_;
  DiscreteBeamLaws laws_;
  std::set<Id> checked_;
};

}  // namespace

std::vector<DiscreteBeamPart> find_discrete_beam_parts(const Deck& deck, const Model& model,
                                                       Diagnostics& diagnostics) {
  std::vector<DiscreteBeamPart> out;
  DiscreteBeamReader reader(deck, model, diagnostics);
  for (std::size_t k = 0; k < model.parts.size(); ++k)
    if (model.parts[k].has_beam) reader.read(k, out);
  return out;
}

}  // namespace courant
