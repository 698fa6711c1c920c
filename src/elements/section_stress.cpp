// *INITIAL_STRESS_SECTION: normal stress of solids that a cross section cuts, by a curve until its end; as
// that of bolts that are tightened.
#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "elements/beam/axial_preload.hpp"
#include "elements/held_stress.hpp"
#include "elements/histories/secforc.hpp"
#include "elements/initial_cards.hpp"
#include "elements/kept_stress.hpp"
#include "elements/solid/solids.hpp"
#include "extension/builders.hpp"
#include "keyword/registry.hpp"
#include "model/definitions/named_curve.hpp"

namespace courant {

namespace {

using S = InitialStressSection;
const RegisterKeyword<S> initial_stress_section{initial_stress_section_table()};

/// What a card gives the solids of a group.
struct StressOfSection {
  Curve curve{};
  Real until = 0;              ///< [T]
  Vec normal = Vec::UnitZ();   ///< unit
  bool without_shear = false;  ///< on the section
  std::vector<Index> solids{};
};

class SectionStress : public HeldStress {
 public:
  explicit SectionStress(const ElementGroup& group) : of_solid_(static_cast<std::size_t>(group.size()), -1) {}

  void add(StressOfSection section) {
    for (const Index e : section.solids)
      of_solid_[static_cast<std::size_t>(e)] = static_cast<Index>(all_.size());
    all_.push_back(std::move(section));
  }
  void start(Real t) override {
    time_ = t;
    now_.clear();
    for (const StressOfSection& section : all_) now_.push_back(t <= section.until ? section.curve(t) : 0);
  }
  void hold(int, Index begin, const PointBlock& points) const override {
    for (Index i = 0; i < points.count; ++i) {
      const Index k = of_solid_[static_cast<std::size_t>(begin + i)];
      if (k < 0 || time_ > all_[static_cast<std::size_t>(k)].until) continue;
      set(static_cast<std::size_t>(k), [&](std::size_t c) -> Real& { return points.stress[c][i]; });
    }
  }

 private:
  template <class At>
  void set(std::size_t k, const At& at) const {
    const StressOfSection& section = all_[k];
    const Vec n = section.normal;
    const Vec traction(at(0) * n[0] + at(3) * n[1] + at(5) * n[2], at(3) * n[0] + at(1) * n[1] + at(4) * n[2],
                       at(5) * n[0] + at(4) * n[1] + at(2) * n[2]);
    const Real normal = traction.dot(n);
    const Vec shear = section.without_shear ? Vec(traction - normal * n) : Vec(Vec::Zero());
    constexpr int first[] = {0, 1, 2, 0, 1, 2}, second[] = {0, 1, 2, 1, 2, 0};
    for (std::size_t c = 0; c < 6; ++c)
      at(c) += (now_[k] - normal) * n[first[c]] * n[second[c]] - shear[first[c]] * n[second[c]] -
               n[first[c]] * shear[second[c]];
  }

  std::vector<Index> of_solid_;  ///< into all_, -1: none
  std::vector<StressOfSection> all_;
  std::vector<Real> now_;  ///< of each [M/LT2]
  Real time_ = 0;
};

class SectionStressReader {
 public:
  SectionStressReader(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                      const std::vector<SolidPart>& solids)
      : deck_(deck), model_(model), world_(world), diagnostics_(diagnostics), solids_(solids) {
    Diagnostics reported_with_secforc;
    sections_ = read_cross_sections(deck, model, world, reported_with_secforc);
  }
  void add(const S& card) {
    StressOfSection section{.without_shear = card.izshear == 0};
    const Curve* const curve = curve_named(deck_, model_, card, "LCID", card.lcid, diagnostics_);
    const auto parts = model_.part_sets.find(card.psid);
    if (parts == model_.part_sets.end())
      error(card, "PSID", fmt::format("part set {} does not exist", card.psid), "define it with *SET_PART");
    const CrossSection* const cut = find(card);
    if (!curve || !cut || parts == model_.part_sets.end() || !read_normal(card, *cut, section.normal)) return;
    if (curve->silent) return;
    section.curve = *curve, section.until = end_of_preload(*curve);
    std::map<const ElementGroup*, std::vector<Index>> found;
    for (const ReportedElement& one : cut->elements())
      if (one.kind == ElementKind::solid &&
          std::binary_search(parts->second.begin(), parts->second.end(), one.part()))
        found[&one.reporter->reported()].push_back(one.e);
    if (found.empty())
      return error(card, "CSID",
                   fmt::format("cross section {} cuts no solid of part set {}", card.csid, card.psid),
                   "the stress acts on the solids that it cuts");
    for (const auto& [group, members] : found) {
      if (!check(card, *group, members, section)) return;
      section.solids = members;
      stress_of(*group).add(section);
    }
  }

 private:
  const CrossSection* find(const S& card) {
    for (const CrossSection& one : sections_->sections)
      if (one.id == card.csid) return &one;
    error(card, "CSID", fmt::format("cross section {} does not exist", card.csid),
          "define it with *DATABASE_CROSS_SECTION_PLANE_ID or _SET_ID");
    return nullptr;
  }
  bool read_normal(const S& card, const CrossSection& cut, Vec& normal) {
    normal = cut.normal;
    if (card.vid != 0) {
      const auto vector = model_.vectors.find(card.vid);
      if (vector == model_.vectors.end()) {
        error(card, "VID", fmt::format("vector {} does not exist", card.vid),
              "define it with *DEFINE_VECTOR");
        return false;
      }
      normal = vector->second.head - vector->second.tail;
    }
    if (normal.norm() > 0) {
      normal.normalize();
      return true;
    }
    error(card, "VID", fmt::format("cross section {} has no normal", card.csid),
          "a section of *DATABASE_CROSS_SECTION_SET needs VID");
    return false;
  }
  /// Whether the material keeps such a stress.
  bool check(const S& card, const ElementGroup& group, const std::vector<Index>& members,
             const StressOfSection& section) {
    const SolidPart& part = solids_[static_cast<std::size_t>(group.part)];
    const auto refuse = [&](const char* field, std::string message, const char* hint) {
      error(card, field, std::move(message), hint);
      return false;
    };
    const Id id = group.id[members.front()];
    for (const Index e : members)
      if (!taken_.insert(group.id[e]).second)
        return refuse("CSID", fmt::format("solid {} is in the section of another card, too", group.id[e]),
                      "one card for each section");
    if (part.pressure)
      return refuse(
          "PSID",
          fmt::format("the stress of solid {} has a pressure that follows from an equation of state", id),
          "use a material that gives all of the stress");
    Real most = 0;
    for (const Real s : section.curve.ordinate) most = std::abs(s) > std::abs(most) ? s : most;
    const Vec n = section.normal;
    const Stress stress = {most * n[0] * n[0], most * n[1] * n[1], most * n[2] * n[2],
                           most * n[0] * n[1], most * n[1] * n[2], most * n[2] * n[0]};
    std::size_t count = 0;
    for (const HistoryVariable& h : part.law->history()) count += static_cast<std::size_t>(h.components);
    std::vector<Real> numbers(count, 0);
    std::vector<Real*> history;
    for (Real& h : numbers) history.push_back(&h);
    switch (keeps_stress(stress, history, [&](const PointBlock& points) { part.law->update(points); })) {
      case Keeps::all:
        return true;
      case Keeps::up_to_yield:
        return refuse(
            "LCID",
            fmt::format("a stress of {:.4g} is beyond what the material of solid {} yields at", most, id),
            "lower the curve: stress is force over area, in units of the deck");
      case Keeps::nothing:
        break;
    }
    return refuse(
        "PSID",
        fmt::format("the stress of solid {} follows from its deformation alone, and cannot be given", id),
        "elastic and plastic materials can have one");
  }
  SectionStress& stress_of(const ElementGroup& group) {
    std::shared_ptr<SectionStress>& stress = stresses_[&group];
    if (stress) return *stress;
    stress = std::make_shared<SectionStress>(group);
    for (HoldsStress* forces : world_.passes.all<HoldsStress>())
      if (&forces->of_group() == &group) forces->hold_by(stress);
    return *stress;
  }
  void error(const S& card, const char* field, std::string message, std::string hint) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
  }

  const Deck& deck_;
  const Model& model_;
  World& world_;
  Diagnostics& diagnostics_;
  const std::vector<SolidPart>& solids_;
  std::shared_ptr<CrossSections> sections_;
  std::set<Id> taken_;
  std::map<const ElementGroup*, std::shared_ptr<SectionStress>> stresses_;
};

void set_section_stresses(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                          const std::vector<SolidPart>& solids) {
  const auto& cards = deck.all<S>();
  if (cards.empty()) return;
  SectionStressReader reader(deck, model, world, diagnostics, solids);
  for (const S& card : cards) reader.add(card);
}
const RegisterBuilder section_stresses(BuildPhase::conditions, "stress of sections", set_section_stresses);

}  // namespace

}  // namespace courant
