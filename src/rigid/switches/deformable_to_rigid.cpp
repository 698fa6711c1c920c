// *DEFORMABLE_TO_RIGID: parts that are rigid from the start, whatever their material.
#include "rigid/switches/deformable_to_rigid.hpp"
#include "rigid/bodies/rigid_cards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "keyword/registry.hpp"
#include "rigid/switches/switch_cards.hpp"

namespace courant {

namespace {

using Switch = DeformableToRigid;
const RegisterKeyword<Switch> deformable_to_rigid{deformable_to_rigid_table()};

const Switch* switch_of(const Deck& deck, Id pid) {
  for (const Switch& one : deck.all<Switch>())
    if (one.pid == pid) return &one;
  return nullptr;
}

/// RO, E and PR of a material by the names of the fields of its card.
std::optional<MatRigid> constants_of(const Deck& deck, Id mid) {
  const auto& registry = keyword_registry();
  std::optional<MatRigid> out;
  for (std::size_t k = 0; k < registry.size() && !out; ++k) {
    const KeywordSpec& spec = *registry[k];
    if (spec.id_space != IdSpace::material) continue;
    spec.for_each(deck, static_cast<std::int32_t>(k), [&](const Entry& entry) {
      if (spec.id_of(entry) != mid) return;
      Real ro = 0, E = 0, pr = -1;
      for (std::size_t c = 0; c < spec.cards.size(); ++c)
        for (std::size_t f = 0; f < spec.cards[c].fields.size(); ++f) {
          const std::string_view name = spec.cards[c].fields[f].name;
          Real* const to = name == "RO" ? &ro : name == "E" ? &E : name == "PR" ? &pr : nullptr;
          if (to) *to = spec.number_of(entry, c, f);
        }
      if (!(ro > 0 && E > 0 && pr >= 0)) return;
      MatRigid& m = out.emplace();
      static_cast<Entry&>(m) = entry;
      m.mid = mid, m.ro = ro, m.E = E, m.pr = pr;
    });
  }
  return out;
}

bool is_layered(const Model& model, const ModelPart& part) {
  return !part.plies.empty() ||
         std::any_of(model.layups.begin(), model.layups.end(), [&](const ModelLayup& layup) {
           return model.parts[static_cast<std::size_t>(layup.part)].id == part.id;
         });
}

}  // namespace

std::optional<MatRigid> switched_material(const Deck& deck, const Model& model, Index part) {
  const ModelPart& p = model.parts[static_cast<std::size_t>(part)];
  if (p.has_sph || is_layered(model, p) || !switch_of(deck, p.id) || is_released(deck, model, part))
    return std::nullopt;
  return constants_of(deck, p.mid);
}

namespace {

bool is_released(const Deck& deck, const Model& model, const Switch& card) {
  const auto part = model.part_of_id.find(card.pid);
  return part != model.part_of_id.end() && is_released(deck, model, part->second);
}

}  // namespace

std::vector<SwitchedLead> switched_leads(const Deck& deck, const Model& model) {
  std::vector<SwitchedLead> out;
  for (const Switch& card : deck.all<Switch>())
    if (card.lrb != 0 && !is_released(deck, model, card)) out.push_back({card.lrb, card.pid, card});
  return out;
}

std::vector<SwitchedLead> released_later(const Deck& deck, const Model& model) {
  std::vector<SwitchedLead> out;
  for (const Switch& card : deck.all<Switch>())
    if (is_released(deck, model, card)) out.push_back({card.lrb, card.pid, card});
  return out;
}

const Entry* switched_alone(const Deck& deck, Id part) {
  const Switch* const card = switch_of(deck, part);
  return card && card->lrb == 0 ? card : nullptr;
}

void check_switched_parts(const Deck& deck, const Model& model, Diagnostics& diagnostics) {
  for (const Switch& card : deck.all<Switch>()) {
    const auto error = [&](const char* field, std::string message, const char* hint) {
      deck.error(diagnostics, card, field, std::move(message), hint);
    };
    if (!card.ptype.empty() && card.ptype != "PART")
      error("PTYPE", fmt::format("'{}' is not supported", card.ptype), "name each part: PART");
    const auto found = model.part_of_id.find(card.pid);
    if (found == model.part_of_id.end()) {
      error("PID", fmt::format("part {} does not exist", card.pid), "define it with *PART");
      continue;
    }
    const ModelPart& part = model.parts[static_cast<std::size_t>(found->second)];
    if (part.has_sph)
      error("PID", fmt::format("part {} has particles, which are no rigid body", card.pid),
            "name a part of elements");
    else if (is_layered(model, part))
      error("PID", fmt::format("part {} is a layered composite, which cannot become rigid", card.pid),
            "leave the switch out");
    else if (!part.rigid && !is_released(deck, model, card))
      error("PID",
            fmt::format("material {} of part {} has no RO, E and PR for a rigid body", part.mid, card.pid),
            "use an elastic or plastic material, or *MAT_RIGID");
  }
}

}  // namespace courant
