// *CONTACT_INTERIOR: hexahedra of foam keep a thickness. Equations: docs/theory_contact.md.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "extension/builders.hpp"
#include "extension/part_values.hpp"
#include "keyword/common_rules.hpp"
#include "keyword/deck.hpp"
#include "keyword/registry.hpp"
#include "model/model.hpp"
#include "model/sets/set_cards.hpp"
#include "parallel/counting_sort.hpp"
#include "parallel/parallel.hpp"
#include "state/shared_fields.hpp"
#include "state/world.hpp"

namespace courant {

namespace {

struct InteriorContactCard : Entry {
  Id psid = 0;
};

const RegisterKeyword<InteriorContactCard> contact_interior{
    {.names = {"CONTACT_INTERIOR"},
     .purpose = "keeps hexahedra of parts, as of foams, from being pressed flat or turned inside out",
     .cards = {
         {.fields = {{"PSID", &InteriorContactCard::psid, "-",
                      "part set; its DA1 scales the stiffness (1), DA2 is the share of the thickness at "
                      "which it begins (0.1), DA3 a modulus instead of the bulk modulus",
                      rules::required_id_of(IdSpace::part_set)}}}}}};

/// What the set of parts says.
struct InteriorLaw {
  Real scale = 1, begins = 0.1, modulus = 0;
};

constexpr std::size_t corners = 8;
/// Corners at the two ends of the edges along each of the three directions of a hexahedron.
constexpr std::array<std::array<std::array<int, 4>, 2>, 3> ends{
    {{{{0, 3, 4, 7}, {1, 2, 5, 6}}}, {{{0, 1, 4, 5}, {3, 2, 7, 6}}}, {{{0, 1, 2, 3}, {4, 5, 6, 7}}}}};

/// Mean edges of a hexahedron. [L]
std::array<Vec, 3> edges_of(const std::array<Vec, corners>& x) {
  std::array<Vec, 3> out;
  for (std::size_t d = 0; d < 3; ++d) {
    out[d] = Vec::Zero();
    for (std::size_t k = 0; k < 4; ++k)
      out[d] +=
          0.25 * (x[static_cast<std::size_t>(ends[d][1][k])] - x[static_cast<std::size_t>(ends[d][0][k])]);
  }
  return out;
}

/// The thickness h_d = e_d.n with n = e_a x e_b/|e_a x e_b| of each direction, and what it changes with each
/// of the three mean edges. [L], [-]
struct Thickness {
  Real h = 0;
  std::array<Vec, 3> change{};
};
Thickness thickness_along(const std::array<Vec, 3>& e, std::size_t d) {
  const std::size_t a = (d + 1) % 3, b = (d + 2) % 3;
  const Vec across = e[a].cross(e[b]);
  const Real area = across.norm();
  const Vec n = across / area;
  Thickness out;
  out.h = e[d].dot(n);
  out.change[d] = n;
  out.change[a] = (e[b].cross(e[d]) - out.h * e[b].cross(n)) / area;
  out.change[b] = (e[d].cross(e[a]) - out.h * n.cross(e[a])) / area;
  return out;
}

/// Energy of a hexahedron of which one thickness is the share s < F of that of the start:
/// M F^2 V (s/F - 1 - ln(s/F)), so that the pressure M F (F/s - 1) grows without bound. As forces follow from
/// an energy that a motion without strain does not change, they keep momentum and angular momentum.
class InteriorContact : public Force, public TimeLimit, public EnergyTerm {
 public:
  InteriorContact(const ElementGroup& group, const InteriorLaw& law, Real modulus, World& world)
      : group_(group), law_(law), modulus_(modulus), eroded_(shared_fields::eroded.find(group.fields)) {
    const auto count = static_cast<std::size_t>(group.size());
    start_.resize(count), force_.resize(count), energy_.resize(count, 0), omega2_.resize(count, 0);
    active_.resize(count, 0);
    for (Index e = 0; e < group.size(); ++e) {
      const std::array<Vec, 3> edges = edges_of(corners_of(world.nodes.x, e));
      for (std::size_t d = 0; d < 3; ++d)
        start_[static_cast<std::size_t>(e)][d] = thickness_along(edges, d).h;
    }
    std::vector<Index> node;
    for (Index e = 0; e < group.size(); ++e)
      for (int c = 0; c < static_cast<int>(corners); ++c) node.push_back(group.node.data(c)[e]);
    counting_sort(node, world.nodes.size(), first_, corner_);
  }
  std::string name() const override { return "interior contact of " + group_.fields.name(); }
  const FieldSet& over(const World& world) const override { return world.nodes.fields; }
  void declare(const World& world, Accesses& a) const override {
    a.in_start().reads(world.nodes.x, Reach::others).reads(world.nodes.v, Reach::others);
    a.in_start()
        .reads(group_.node, Reach::others)
        .reads(group_.V0, Reach::others)
        .reads(group_.mass, Reach::others);
    if (eroded_) a.reads(*eroded_, Reach::others);
    a.in_block().updates(world.nodes.f);
  }
  void start(World& world, const Clock&) override {
    for_each(group_.size(), [&](Index e) { press(world, e); });
    any_ = std::find(active_.begin(), active_.end(), 1) != active_.end();
  }
  void block(World& world, const Clock&, Index begin, Index end) override {
    if (!any_) return;
    for (Index n = begin; n < end; ++n)
      for (Index k = first_[static_cast<std::size_t>(n)]; k < first_[static_cast<std::size_t>(n) + 1]; ++k) {
        const auto at = static_cast<std::size_t>(corner_[static_cast<std::size_t>(k)]);
        if (active_[at / corners] != 0) world.nodes.f.add(n, force_[at / corners][at % corners]);
      }
  }
  /// 2/omega of the stiffest pressed element, of its own mass; and no thickness halves in a step.
  Limit limit(const World&, const Clock&) override {
    Real most = 0;
    Index at = -1;
    for (Index e = 0; e < group_.size(); ++e)
      if (omega2_[static_cast<std::size_t>(e)] > most) most = omega2_[static_cast<std::size_t>(e)], at = e;
    if (at < 0) return {std::numeric_limits<Real>::infinity(), ""};
    return {2 / std::sqrt(most), fmt::format("interior contact of solid {}", group_.id[at])};
  }
  void record(World&, const Clock&, EnergyLedger&) override {}
  void sample(const World&, const Clock&, EnergyLedger& ledger) const override {
    for (std::size_t e = 0; e < energy_.size(); ++e)
      if (active_[e] != 0) ledger.contact += energy_[e];
  }

 private:
  std::array<Vec, corners> corners_of(const Field<Real>& of, Index e) const {
    std::array<Vec, corners> out;
    for (std::size_t c = 0; c < corners; ++c) out[c] = of.vec(group_.node.data(static_cast<int>(c))[e]);
    return out;
  }
  void press(const World& world, Index e) {
    const auto k = static_cast<std::size_t>(e);
    active_[k] = 0, energy_[k] = omega2_[k] = 0;
    if (eroded_ && (*eroded_)[e] != 0) return;
    const std::array<Vec, 3> edges = edges_of(corners_of(world.nodes.x, e)),
                             closing = edges_of(corners_of(world.nodes.v, e));
    const Real F = law_.begins, M = law_.scale * modulus_, V = group_.V0[e];
    for (std::size_t d = 0; d < 3; ++d) {
      const Thickness t = thickness_along(edges, d);
      const Real H = start_[k][d], s = std::max(t.h / H, least);
      Real rate = 0;  // of the thickness [L/T]
      for (std::size_t j = 0; j < 3; ++j) rate += t.change[j].dot(closing[j]);
      const Real halves = 4 * std::max(-rate, Real(0)) / std::max(t.h, least * H);
      omega2_[k] = std::max(omega2_[k], halves * halves);
      if (!(s < F)) continue;
      if (active_[k] == 0) force_[k].fill(Vec::Zero());
      active_[k] = 1;
      energy_[k] += M * F * F * V * (s / F - 1 - std::log(s / F));
      omega2_[k] += 4 * M * F * F * V / (s * s * H * H * group_.mass[e]);
      const Real push = M * F * (F / s - 1) * V / H;  // along a growing thickness [ML/T2]
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t end = 0; end < 2; ++end)
          for (const int c : ends[j][end])
            force_[k][static_cast<std::size_t>(c)] += (end == 1 ? 0.25 : -0.25) * push * t.change[j];
    }
  }

  /// Of the thickness at the start: what is flatter is pushed as this. [-]
  static constexpr Real least = 1e-4;
  const ElementGroup& group_;
  InteriorLaw law_;
  Real modulus_;                                 ///< [M/LT2]
  const Field<Index>* eroded_;                   ///< null: none fails
  std::vector<std::array<Real, 3>> start_;       ///< thickness at the start [L]
  std::vector<std::array<Vec, corners>> force_;  ///< of active elements [ML/T2]
  std::vector<Real> energy_, omega2_;            ///< [ML2/T2], [1/T2]
  std::vector<char> active_;                     ///< by element
  std::vector<Index> first_, corner_;            ///< of each node the first of corner_: 8 e + c
  bool any_ = false;
};

void add_interior_contacts(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                           const BulkModuli& bulk_moduli) {
  std::vector<char> taken(model.parts.size(), 0);
  for (const InteriorContactCard& card : deck.all<InteriorContactCard>()) {
    const auto set = model.part_sets.find(card.psid);
    if (set == model.part_sets.end()) {
      deck.error(diagnostics, card, "PSID", fmt::format("part set {} does not exist", card.psid),
                 "define it with *SET_PART_LIST");
      continue;
    }
    InteriorLaw law;
    for (const auto& one : deck.all<SetCardOf<SetKind::part, SetForm::list>>()) {
      if (one.sid != card.psid) continue;
      if (one.da1 > 0) law.scale = one.da1;
      if (one.da2 > 0) law.begins = one.da2;
      law.modulus = one.da3;
    }
    if (!(law.begins < 1)) {
      deck.error(diagnostics, card, "PSID",
                 fmt::format("DA2 of part set {} is {:g}: contact would begin before anything is pressed",
                             card.psid, law.begins),
                 "0.1 is usual");
      continue;
    }
    for (const Index p : set->second) {
      const ModelPart& part = model.parts[static_cast<std::size_t>(p)];
      if (std::exchange(taken[static_cast<std::size_t>(p)], 1) != 0) continue;
      bool any = false;
      for (const auto& group : world.groups) {
        if (group->part != p || group->segment || group->corners() != 8 || group->repeats_nodes) continue;
        any = true;
        world.passes.add(std::make_shared<InteriorContact>(
            *group, law, law.modulus > 0 ? law.modulus : bulk_moduli(p), world));
      }
      if (!any)
        deck.warning(diagnostics, card, "PSID",
                     fmt::format("part {} has no hexahedra that deform: nothing of it is held", part.id),
                     "name parts of solids of eight nodes");
    }
  }
}

const RegisterBuilder interior_contacts(BuildPhase::faces, "interior contacts", add_interior_contacts,
                                        Errors::go_on);

}  // namespace

}  // namespace courant
