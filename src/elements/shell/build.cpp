#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "elements/shell/cards_shell.hpp"
#include "elements/shell/hourglass_shell.hpp"
#include "elements/shell/laminate_shear.hpp"
#include "elements/shell/layers.hpp"
#include "elements/shell/shell_element_cards.hpp"
#include "elements/shell/shells.hpp"
#include "elements/shell_faces/section_shell.hpp"
#include "laws/fluid/mat_null.hpp"
#include "model/cards.hpp"
#include "model/conditions/condition_cards.hpp"

namespace courant {

namespace {

constexpr int belytschko_tsay = 2, flat_triangle = 4, membrane = 5, full_membrane = 9, fully_integrated = 16;

/// Formulations that differ in details from one that stands for them with a warning.
struct Similar {
  const char* name;
  int used;
};
const std::map<int, Similar> similar = {
    {-16, {"2 x 2 points of higher accuracy", fully_integrated}},
    {1, {"Hughes-Liu", belytschko_tsay}},
    {3, {"triangle of Bazeley, Cheung, Irons and Zienkiewicz", flat_triangle}},
    {6, {"selectively reduced Hughes-Liu", belytschko_tsay}},
    {7, {"selectively reduced Hughes-Liu", belytschko_tsay}},
    {10, {"Belytschko-Wong-Chiang", belytschko_tsay}},
    {11, {"fast Hughes-Liu", belytschko_tsay}},
    {17, {"discrete Kirchhoff triangle", flat_triangle}},
    {18, {"linear discrete Kirchhoff", fully_integrated}}};
constexpr const char* formulations =
    "supported values: 2 (Belytschko-Tsay), 16 (2 x 2 points), 4 for triangles, 5 and 9 (membranes); 1, 6, "
    "7, 10 and "
    "11 become 2, 3 and 17 become 4, -16 and 18 become 16";

class ShellReader {
 public:
  ShellReader(const Deck& deck, const Model& model, Diagnostics& diagnostics)
      : deck_(deck),
        model_(model),
        diagnostics_(diagnostics),
        control_(deck.last<ControlShell>()),
        hourglass_(deck),
        sections_(deck, model),
        layers_(deck, model, diagnostics) {
    if (control_) check_control(*control_);
  }

  /// False: what the part is made of is not there, or not right.
  bool read(const ModelPart& part, ShellPart& out) {
    const SectionShell* const section = sections_.of(part);
    if (!section) return false;  // which the segments report
    const SectionShell& s = *section;
    if (checked_.insert(&s).second) check_section(s, part);
    SectionShell points = s;
    if (is_membrane(s)) points.nip = 1, points.irid = 0;
    const bool whole = layers_.read(part, points, control_ && control_->intgrd == 1, out);
    set_options(part, s, whole, out);
    return whole;
  }
  /// The same of shells with layers of their own.
  bool read(const ModelPart& part, Index layup, ShellPart& out) {
    const SectionShell* const section = sections_.of(part);
    if (!section) return false;
    if (checked_.insert(section).second) check_section(*section, part);
    const bool whole = layers_.read(part, model_.layups[static_cast<std::size_t>(layup)], out);
    set_options(part, *section, whole, out);
    out.layup = layup;
    return whole;
  }
  /// That of the part, so that nobody misses it besides; null: shells cannot have it.
  std::shared_ptr<StrengthLaw> law_of(const ModelPart& part) const { return layers_.law_of(part.mid); }

 private:
  void set_options(const ModelPart& part, const SectionShell& s, bool whole, ShellPart& out) {
    out.marea = s.marea, out.nloc = s.nloc, out.full = used(s) == fully_integrated;
    out.contact_plane = control_ ? control_->cntco : 0;
    out.rotary_scale = control_ ? control_->rotascl : 1;
    out.warp_warning = control_ ? control_->wrpang : out.warp_warning;
    ShellControl& c = out.control;
    if (whole) set_moduli(out, c);
    c.shear_factor = is_membrane(s) ? 0 : s.shrf;
    if (whole && c.shear_factor > 0 && layered(part, out)) c.shear_factor = shear_of_layers(part, out);
    if (control_) set_control(part, *control_, out);
    c.warps = control_ && control_->bwc == 1 && !out.full;
    if (const auto* accuracy = deck_.last<ControlAccuracy>()) c.invariant_axes = accuracy->invariant_shells();
    if (const auto* step = deck_.last<ControlTimestepCard>()) c.length_rule = step->isdo;
    hourglass_.read(part, out.full, c, diagnostics_);
  }
  /// LAMSHT counts: layers of their own, and laminated theory of thin shells.
  bool layered(const ModelPart& part, const ShellPart& shells) const {
    constexpr int of_thick_shells = 4;
    if (!control_ || control_->lamsht == 0 || control_->lamsht == of_thick_shells || shells.zeta.size() < 2)
      return false;
    const auto index = static_cast<Index>(&part - model_.parts.data());
    return !shells.laws.empty() || !part.plies.empty() ||
           std::any_of(model_.layups.begin(), model_.layups.end(),
                       [&](const ModelLayup& layup) { return layup.part == index; });
  }
  Real shear_of_layers(const ModelPart& part, const ShellPart& shells) {
    const LaminateShear shear = laminate_shear(shells);
    constexpr Real alike = 0.05;
    if (std::abs(shear.along - shear.across) > alike * shear.both)
      deck_.warning(
          diagnostics_, *control_, "LAMSHT",
          fmt::format("the laminate of part {} shears by factors of {:.3f} along the first direction of "
                      "its layers and {:.3f} across: {:.3f} is taken for both",
                      part.id, shear.along, shear.across, shear.both));
    return shear.both;
  }
  void set_control(const ModelPart& part, const ControlShell& card, ShellPart& out) {
    constexpr int of_flow = 4, thick_alone = 2;
    const bool named =
        card.psstupd == 0 || (in_set(part, card, "PSSTUPD", card.psstupd) == (card.psstupd > 0));
    out.control.thins = named && card.istupd != 0 && card.istupd != thick_alone;
    out.thins_by_flow = card.istupd == of_flow;
    const int asked = out.full ? card.nfail4 : card.nfail1;
    if (card.psnfail == 0 || in_set(part, card, "PSNFAIL", card.psnfail))
      out.distorted = static_cast<DistortedShells>(asked);
  }
  /// Whether a part set, or one with a minus sign, holds the part.
  bool in_set(const ModelPart& part, const ControlShell& card, const char* field, Id id) {
    const auto set = model_.part_sets.find(std::abs(id));
    if (set == model_.part_sets.end()) {
      if (missing_.insert(field).second)
        error(card, field, fmt::format("part set {} does not exist", std::abs(id)),
              "define it with *SET_PART");
      return false;
    }
    const auto index = static_cast<Index>(&part - model_.parts.data());
    return std::find(set->second.begin(), set->second.end(), index) != set->second.end();
  }
  /// Of layers the stiffest: by it the step is bounded.
  static void set_moduli(const ShellPart& part, ShellControl& c) {
    const ElasticConstants of_law = elastic_constants(*part.law);
    c.E = of_law.E, c.G = part.law->shear_modulus(), c.plate_modulus = c.E / (1 - of_law.nu * of_law.nu);
    if (part.laws.empty() && !part.has_axes()) return;
    c.plate_modulus = c.G = 0;
    for (std::size_t k = 0; k < part.zeta.size(); ++k) {
      c.plate_modulus = std::max(c.plate_modulus, part.law_of(k).plane_modulus());
      c.G = std::max(c.G, part.law_of(k).shear_modulus());
    }
    c.E = c.plate_modulus;
  }

  void error(const Entry& card, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
  }

  void check_section(const SectionShell& s, const ModelPart& part) {
    const int elform = formulation(s);
    const char* from = s.elform == 0 && control_ ? " (THEORY of *CONTROL_SHELL)" : "";
    const auto like = similar.find(elform);
    if (like != similar.end())
      deck_.warning(
          diagnostics_, s, "ELFORM",
          fmt::format("{} ({}) is not there for shells that deform, as those of part {}: {} is used "
                      "instead",
                      elform, like->second.name, part.id, like->second.used),
          fmt::format("{} says the same without this warning", like->second.used == belytschko_tsay
                                                                   ? "2 (Belytschko-Tsay)"
                                                                   : std::to_string(like->second.used)));
    else if (!is_membrane(s) && elform != belytschko_tsay && elform != flat_triangle &&
             elform != fully_integrated && !s.of_plane_solids() && !s.user_defined())
      error(s, "ELFORM",
            fmt::format("'{}'{} is not supported for shells that deform, as those of part {}", elform, from,
                        part.id),
            formulations);
    if (is_membrane(s)) check_membrane(s, part);
    const bool has_quads =
        std::any_of(model_.shells.begin(), model_.shells.end(), [&](const ModelShell& shell) {
          return model_.parts[static_cast<std::size_t>(shell.part)].id == part.id &&
                 shell.node[2] != shell.node[3];
        });
    if (used(s) == flat_triangle && has_quads)
      deck_.warning(diagnostics_, s, "ELFORM",
                    fmt::format("4 is for triangles: 2 is used for the quadrilaterals of part {}", part.id));
    if (s.idof == 3)
      error(s, "IDOF", "'3' is not supported: contact does not squeeze shells", "leave it blank");
    if (!(s.shrf > 0))
      error(s, "SHRF", fmt::format("expected a number > 0, got '{:g}'", s.shrf), "5/6 is usual");
  }

  /// One layer in the middle and no shear across: nothing bends.
  bool is_membrane(const SectionShell& s) const {
    return formulation(s) == membrane || formulation(s) == full_membrane;
  }
  void check_membrane(const SectionShell& s, const ModelPart& part) {
    if (formulation(s) == full_membrane)
      deck_.warning(diagnostics_, s, "ELFORM",
                    fmt::format("9 (membranes of 2 x 2 points) is not there for shells that deform, as those "
                                "of part {}: 5, of one point with hourglass control, is used instead",
                                part.id),
                    "5 says the same without this warning");
    if (s.irid != 0)
      error(s, "QR/IRID", fmt::format("'{}' is not supported: membranes have one layer", s.irid),
            "leave it blank");
    if (s.nloc != 0 || has_layers_or_offsets(part))
      error(s, "ELFORM",
            fmt::format("{} is not supported for the layers or offsets of part {}: membranes do not bend",
                        formulation(s), part.id),
            "2 bends");
  }
  bool has_layers_or_offsets(const ModelPart& part) const {
    const auto index = static_cast<Index>(&part - model_.parts.data());
    return !part.plies.empty() ||
           std::any_of(model_.layups.begin(), model_.layups.end(),
                       [&](const ModelLayup& layup) { return layup.part == index; }) ||
           std::any_of(model_.shell_offset.begin(), model_.shell_offset.end(), [&](const auto& one) {
             return one.second != 0 && model_.shells[static_cast<std::size_t>(one.first)].part == index;
           });
  }

  /// What stands for it.
  int used(const SectionShell& s) const {
    const auto like = similar.find(formulation(s));
    return like == similar.end() ? formulation(s) : like->second.used;
  }
  /// ELFORM, or THEORY where the section names none.
  int formulation(const SectionShell& s) const {
    if (s.elform != 0) return s.elform;
    return control_ ? control_->theory : belytschko_tsay;
  }

  void check_control(const ControlShell& c) {
    const auto refuse = [&](const char* field, bool wrong, Real value, const char* what) {
      if (wrong)
        deck_.refuse(diagnostics_, c, field, fmt::format("'{:g}' is not supported: {}", value, what),
                     "leave the field blank");
    };
    if (c.esort == 2)
      deck_.warning(diagnostics_, c, "ESORT",
                    "2 asks for discrete Kirchhoff triangles (17): 4 is used instead",
                    "1 says the same without this warning");
    refuse("ESORT", c.esort < 0 || c.esort > 2, c.esort, "triangles are of formulation 4 (0 and 1)");
    refuse("ISTUPD", c.istupd < 0 || c.istupd > 4, c.istupd,
           "the thickness stays (0), or follows all of the strain (1) or its plastic part (4)");
    refuse("BWC", c.bwc != 1 && c.bwc != 2, c.bwc, "shells of ELFORM 2 include their warp (1) or do not (2)");
    refuse("MITER", c.miter != 1 && c.miter != 2, c.miter, "plane stress is iterated to convergence (1, 2)");
    refuse("ROTASCL", !(c.rotascl > 0), c.rotascl, "rotary inertia must be above 0");
    refuse("INTGRD", c.intgrd != 0 && c.intgrd != 1, c.intgrd, "points are of Gauss (0) or Lobatto (1)");
    refuse("SIDT4TU", c.sidt4tu != 0, c.sidt4tu, "ISTUPD holds for all parts");
    refuse("W-MODE", c.wmode != 0, c.wmode, "no shell is deleted");
    refuse("STRETCH", c.stretch != 0, c.stretch, "no shell is deleted");
    refuse("ICRQ", c.icrq != 0, c.icrq, "each shell has one thickness");
    for (const auto& [field, value] : {std::pair("NFAIL1", c.nfail1), std::pair("NFAIL4", c.nfail4)})
      refuse(field, value < 0 || value > 2, value, "distorted shells stay (0), go (1) or end the run (2)");
    refuse("DRCPSID", c.drcpsid != 0, static_cast<Real>(c.drcpsid), "rotations about the normal are free");
  }

  const Deck& deck_;
  const Model& model_;
  Diagnostics& diagnostics_;
  const ControlShell* control_;
  ShellHourglassReader hourglass_;
  ShellSections sections_;
  LayerReader layers_;
  std::set<const SectionShell*> checked_;  ///< several parts may name one
  std::set<std::string> missing_;          ///< sets that do not exist, by field
};

ElasticConstants constants_of(Real K, Real G) {
  if (K == 0 && G == 0) return {};  // of *MAT_NULL without YM
  return {9 * K * G / (3 * K + G), (3 * K - 2 * G) / (6 * K + 2 * G)};
}

}  // namespace

ElasticConstants elastic_constants(const StrengthLaw& law) {
  return constants_of(law.bulk_modulus(), law.shear_modulus());
}

ElasticConstants elastic_constants(const ShellPart& part) {
  if (part.laws.empty()) return elastic_constants(*part.law);
  Real K = 0, G = 0;
  for (std::size_t k = 0; k < part.laws.size(); ++k)
    K += part.share[k] * part.laws[k]->bulk_modulus(), G += part.share[k] * part.laws[k]->shear_modulus();
  return constants_of(K, G);
}

namespace {

/// Shells without a stress: one layer whose law is never asked.
ShellPart null_part(const MatNull& m) {
  ShellPart out;
  out.law = m.coat(), out.null = true;
  out.zeta = {0}, out.share = {1};
  return out;
}

/// `by_part`: some shells have the layers that stand with the part; else the first of the others stand for
/// it, too.
ShellPart read_part(ShellReader& reader, const Model& model, std::size_t k, bool by_part) {
  const ModelPart& part = model.parts[k];
  std::vector<ShellPart> layups;
  bool whole = true;
  const std::vector<Index> group_of = layups_of_groups(model);
  for (std::size_t own = 0; own < group_of.size(); ++own)
    if (model.layups[own].part == static_cast<Index>(k) && group_of[own] == static_cast<Index>(own))
      whole = reader.read(part, static_cast<Index>(own), layups.emplace_back()) && whole;
  ShellPart out;
  if (whole && by_part)
    whole = reader.read(part, out);
  else if (whole)
    out = layups.front();
  if (!whole) {
    out = {};
    out.law = reader.law_of(part);
    return out;
  }
  out.layups = std::move(layups), out.layup = -1;
  return out;
}

}  // namespace

namespace {

bool has_strength_card(const Deck& deck, Id mid) {
  const std::string name = deck.first_name_of(IdSpace::material, mid);
  return std::any_of(strength_registry().begin(), strength_registry().end(),
                     [&](const StrengthEntry& kind) { return kind.keyword == name; });
}

}  // namespace

std::vector<ShellPart> find_shell_parts(const Deck& deck, const Model& model, Diagnostics& diagnostics) {
  std::vector<ShellPart> out(model.parts.size());
  std::vector<std::size_t> deforming;
  bool solids = false;
  for (std::size_t k = 0; k < model.parts.size(); ++k) {
    const ModelPart& part = model.parts[k];
    solids = solids || (part.has_solid && !part.rigid);
    if (!part.has_shell || part.has_sph || part.rigid) continue;
    if (part.null)
      out[k] = null_part(*mat_null_of(deck, part.mid));
    else
      deforming.push_back(k);
  }
  if (deforming.empty()) return out;
  const int errors = diagnostics.errors();
  if (!solids)  // which check them, too
    for (const StrengthEntry& kind : strength_registry()) kind.check(deck, model, diagnostics);
  if (diagnostics.errors() > errors) {  // a law is made from valid cards
    for (const std::size_t k : deforming) out[k].faulty = has_strength_card(deck, model.parts[k].mid);
    return out;
  }
  ShellReader reader(deck, model, diagnostics);
  const std::vector<bool> by_part = parts_with_own_layers(model);
  for (const std::size_t k : deforming) out[k] = read_part(reader, model, k, by_part[k]);
  return out;
}

}  // namespace courant
