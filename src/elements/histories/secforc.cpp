// *DATABASE_SECFORC: forces through cross sections over time.
#include "elements/histories/secforc.hpp"

#include <fmt/format.h>
#include <fmt/printf.h>

#include <algorithm>
#include <set>
#include <unordered_map>

#include "elements/histories/cards_cross_section.hpp"
#include "extension/additions.hpp"

namespace courant {

namespace {

/// Makes the cross sections of a deck.
class SectionReader {
 public:
  SectionReader(const Deck& deck, const Model& model, const World& world, Diagnostics& diagnostics)
      : deck_(deck),
        model_(model),
        world_(world),
        diagnostics_(diagnostics),
        choice_(deck, model, world, diagnostics) {}

  std::shared_ptr<CrossSections> read() {
    for (const CrossSectionPlaneCard& card : deck_.all<CrossSectionPlaneCard>()) read(card);
    for (const CrossSectionSetCard& card : deck_.all<CrossSectionSetCard>()) read(card);
    number();
    return std::move(out_);
  }

 private:
  void read(const CrossSectionPlaneCard& card) {
    CuttingPlane plane{.origin = {card.xct, card.yct, card.zct},
                       .radius = card.radius,
                       .length_l = card.lenl,
                       .length_m = card.lenm};
    const Vec normal = Vec(card.xch, card.ych, card.zch) - plane.origin;
    if (!(normal.norm() > 0)) return error(card, "XCH", "head and tail of the normal are the same point");
    plane.normal = normal.normalized();
    if (card.radius == 0 && (card.lenl > 0 || card.lenm > 0)) {
      Vec edge = Vec(card.xhev, card.yhev, card.zhev) - plane.origin;
      const Real length = edge.norm();
      edge -= edge.dot(plane.normal) * plane.normal;
      if (!(edge.norm() > 1e-6 * length))
        return error(card, "XHEV",
                     "the edge vector, from the tail of the normal to here, does not lie in the plane",
                     "LENL and LENM count along it and across it");
      plane.edge = edge.normalized();
    }
    std::vector<ReportedElement> elements;
    if (card.psid == 0) {
      elements = choice_.all();
    } else {
      const auto parts = model_.part_sets.find(card.psid);
      if (parts == model_.part_sets.end())
        return error(card, "PSID", fmt::format("part set {} does not exist", card.psid),
                     "define it with *SET_PART_LIST");
      for (const ReportedElement& one : choice_.all())
        if (std::binary_search(parts->second.begin(), parts->second.end(), one.part()))
          elements.push_back(one);
    }
    add(card, CrossSection(elements, plane, world_), "PSID",
        "the plane cuts no element that deforms: the section holds 0");
  }

  void read(const CrossSectionSetCard& card) {
    const auto set = model_.node_sets.find(card.nsid);
    if (set == model_.node_sets.end())
      return error(card, "NSID", fmt::format("node set {} does not exist", card.nsid),
                   "define it with *SET_NODE_LIST");
    if (place_of_.empty())
      for (Index n = 0; n < world_.nodes.size(); ++n) place_of_.emplace(world_.nodes.id[n], n);
    std::vector<Index> nodes;
    for (const Index n : set->second)
      if (const auto at = place_of_.find(model_.nodes[static_cast<std::size_t>(n)].id); at != place_of_.end())
        nodes.push_back(at->second);
    std::sort(nodes.begin(), nodes.end());
    std::vector<ReportedElement> elements;
    const auto take = [&](const char* field, ElementKind kind, Id id) {
      if (id == 0) return;
      const auto members = choice_.set(card, field, kind, id, "secforc");
      elements.insert(elements.end(), members.begin(), members.end());
    };
    take("HSID", ElementKind::solid, card.hsid);
    take("BSID", ElementKind::beam, card.bsid);
    take("SSID", ElementKind::shell, card.ssid);
    add(card, CrossSection(elements, nodes, world_), "NSID",
        "no element of the sets that deforms has a node of this set: the section holds 0");
  }

  void add(const CrossSectionCard& card, CrossSection section, const char* field, const char* if_empty) {
    section.id = card.id, section.title = card.title;
    if (card.system != 0 && !take_axes(card, section)) return;
    if (section.empty()) deck_.warning(diagnostics_, card, field, if_empty);
    out_->sections.push_back(std::move(section));
    cards_.push_back(&card);
  }

  bool take_axes(const CrossSectionCard& card, CrossSection& section) {
    if (card.itype != 2) {
      error(
          card, "ID",
          fmt::format("axes of {} are not supported", card.itype == 0 ? "a rigid body" : "an accelerometer"),
          "leave ID blank for global axes, or give a coordinate system and ITYPE 2");
      return false;
    }
    const auto system = model_.coordinate_systems.find(card.system);
    if (system == model_.coordinate_systems.end()) {
      error(card, "ID", fmt::format("coordinate system {} does not exist", card.system),
            "define it with *DEFINE_COORDINATE_SYSTEM");
      return false;
    }
    if (system->second.moves) {
      error(card, "ID",
            fmt::format("coordinate system {} turns with nodes, which is not supported here", card.system),
            "leave FLAG blank, so that it stays as it is at the start");
      return false;
    }
    section.system = card.system, section.axes = system->second.axes;
    return true;
  }

  /// Those without an id get the position that they have among all.
  void number() {
    std::vector<std::size_t> order(cards_.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    std::stable_sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) {
      return std::pair(cards_[a]->file, cards_[a]->line) < std::pair(cards_[b]->file, cards_[b]->line);
    });
    std::vector<CrossSection> sorted;
    std::set<Id> known;
    for (const std::size_t k : order) {
      CrossSection& section = out_->sections[k];
      if (section.id == 0) section.id = static_cast<Id>(sorted.size()) + 1;
      if (!known.insert(section.id).second)
        error(*cards_[k], cards_[k]->id == 0 ? "ID" : "CSID",
              fmt::format("there are two cross sections {}", section.id),
              "give each an id of its own by _ID");
      sorted.push_back(std::move(section));
    }
    out_->sections = std::move(sorted);
  }

  void error(const Entry& card, const char* field, std::string message, std::string hint = {}) {
    deck_.error(diagnostics_, card, field, std::move(message), std::move(hint));
  }

  const Deck& deck_;
  const Model& model_;
  const World& world_;
  Diagnostics& diagnostics_;
  ElementChoice choice_;
  std::unordered_map<Id, Index> place_of_;
  std::shared_ptr<CrossSections> out_ = std::make_shared<CrossSections>();
  std::vector<const CrossSectionCard*> cards_;  ///< of the sections
};

void build_sections(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics) {
  const bool any = has_cross_sections(deck);
  if (any) world.passes.add(read_cross_sections(deck, model, world, diagnostics));
  const auto* card = deck.last<DatabaseSecforc>();
  if (card && card->dt > 0 && !any)
    deck.warning(diagnostics, *card, "DT", "there is no cross section: secforc holds no values",
                 "define one with *DATABASE_CROSS_SECTION_PLANE or _SET");
}
const RegisterAddition cross_sections{"cross sections", build_sections};

std::string secforc_state(const World& world, const Clock& clock) {
  std::string out;
  const auto four = [&out](const Vec& v, Real last) {
    out += fmt::sprintf("%15.4E%12.4E%12.4E%12.4E\n", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0, last);  // no -0
  };
  for (const auto* all : world.passes.all<const CrossSections>())
    for (const CrossSection& section : all->sections) {
      const SectionForce f = section.force(world);
      out += fmt::sprintf("%12d%15.5E", section.id, clock.t);
      four(f.force, f.force.norm());
      out += section.system != 0 ? fmt::sprintf("cs ID =%8d            ", section.system)
                                 : std::string("global system              ");
      four(f.moment, f.moment.norm());
      out += std::string(27, ' ');
      four(f.centroid, f.area);
      out += "\n";
    }
  return out;
}

void secforc_numbers(const World& world, const Clock&, HistoryNumbers& to) {
  using S = std::pair<const CrossSection*, SectionForce>;
  std::vector<S> all;
  for (const auto* sections : world.passes.all<const CrossSections>())
    for (const CrossSection& section : sections->sections) all.emplace_back(&section, section.force(world));
  const auto none = [](const S&) { return 0; };
  HistoryRows(
      to, "", all, [](const S& s) { return s.first->id; }, "sections")
      .title([](const S& s) { return s.first->title; })
      .fixed("rigidbody", none)
      .fixed("accelerometer", none)
      .fixed("coordinate_system", [](const S& s) { return s.first->system; })
      .vector(
          "{}_force", [](const S& s) { return s.second.force; }, "ML/T2")
      .real("total_force", [](const S& s) { return s.second.force.norm(); })
      .vector(
          "{}_moment", [](const S& s) { return s.second.moment; }, "ML2/T2")
      .real("total_moment", [](const S& s) { return s.second.moment.norm(); })
      .vector(
          "{}_centroid", [](const S& s) { return s.second.centroid; }, "L")
      .real(
          "area", [](const S& s) { return s.second.area; }, "L2");
}

const RegisterAsciiHistory secforc{
    {.name = "secforc",
     .interval = interval_in<DatabaseSecforc>,
     .text = secforc_state,
     .legend =
         [](const World& world) {
           std::vector<std::pair<Id, std::string>> out;
           for (const auto* all : world.passes.all<const CrossSections>())
             for (const CrossSection& section : all->sections)
               if (!section.title.empty()) out.emplace_back(section.id, section.title);
           return out;
         },
     .columns = "\n\n line#1  section#     time        x-force     y-force     z-force    magnitude\n"
                " line#2  resultant  moments       x-moment    y-moment    z-moment   magnitude\n"
                " line#3  centroids                x           y           z            area  \n",
     .numbers = secforc_numbers,
     .binary = binary_in<DatabaseSecforc>}};

}  // namespace

std::shared_ptr<CrossSections> read_cross_sections(const Deck& deck, const Model& model, const World& world,
                                                   Diagnostics& diagnostics) {
  return SectionReader(deck, model, world, diagnostics).read();
}

bool has_cross_sections(const Deck& deck) {
  return !deck.all<CrossSectionPlaneCard>().empty() || !deck.all<CrossSectionSetCard>().empty();
}

}  // namespace courant
