#include "model/transforms/included_entries.hpp"

#include <fmt/format.h>
#include <map>
#include <utility>
#include <vector>

#include "keyword/read/include_card.hpp"
#include "keyword/registry.hpp"
#include "model/cards.hpp"
#include "model/transforms/transformation.hpp"

namespace courant {

namespace {

void check_references(const Deck& deck, Diagnostics& diagnostics) {
  const auto check = [&](const Entry& entry, const char* field, Id id) {
    if (id != 0 && !find_transformation(deck, id))
      deck.error(diagnostics, entry, field, fmt::format("transformation {} does not exist", id),
                 "define it with *DEFINE_TRANSFORMATION");
  };
  for (const auto& card : deck.all<IncludeTransformCard>()) check(card, "TRANID", card.tranid);
  for (const auto& card : deck.all<NodeTransformCard>()) check(card, "TRSID", card.trsid);
}

/// Tells the first entry of each keyword in each file that cannot be moved, and how many are like it.
class Refusals {
 public:
  Refusals(const Deck& deck, Diagnostics& diagnostics) : deck_(deck), diagnostics_(diagnostics) {}
  void add(const Entry& entry, const std::string& reason) {
    auto& [first, count] = found_[{entry.file, entry.keyword}];
    if (++count > 1) return;
    first = entry;
    deck_.error(diagnostics_, entry, "", reason,
                "undo the motion of the file here, or give the entry in a file that is not moved");
  }
  void finish() {
    for (const auto& [key, found] : found_)
      if (found.second > 1)
        diagnostics_.note(deck_.where(found.first),
                          fmt::format("{} more {} of this file cannot be moved", found.second - 1,
                                      deck_.keyword(found.first)));
  }

 private:
  const Deck& deck_;
  Diagnostics& diagnostics_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::pair<Entry, int>> found_;
};

/// Gravity has one direction, whatever is done to the file that names it.
void warn_of_loads(const Deck& deck, const std::vector<Affine>& motions, Diagnostics& diagnostics) {
  const auto warn = [&](const Entry& card, const Vec& axis) {
    const Vec turned = motions[static_cast<std::size_t>(card.file)].linear() * axis;
    if (!turned.normalized().isApprox(axis))
      deck.warning(diagnostics, card, "",
                   "the load stays along the global axis, although its file is turned by a transformation");
  };
  for (const LoadBodyCard& card : deck.all<LoadBodyCard>())
    if (card.cid == 0) warn(card, Vec::Unit(card.name));
  for (const LoadGravityPartCard& card : deck.all<LoadGravityPartCard>()) warn(card, Vec::Unit(card.dof - 1));
}

}  // namespace

void move_included_entries(Deck& deck, Diagnostics& diagnostics) {
  evaluate_transformations(deck, diagnostics);
  check_references(deck, diagnostics);
  convert_curves(deck, diagnostics);
  std::vector<Affine> motions;
  bool any = false;
  for (const DeckFile& file : deck.files) {
    motions.push_back(motion_of_file(deck, file));
    any = any || !file.conversion.transformations.empty();
  }
  if (!any || !diagnostics.ok()) return;
  const auto motion_of = [&](const Entry& entry) -> const Affine* {
    const auto file = static_cast<std::size_t>(entry.file);
    return deck.files[file].conversion.transformations.empty() ? nullptr : &motions[file];
  };
  Refusals refusals(deck, diagnostics);
  const auto refuse = [&](const Entry& entry, const std::string& reason) { refusals.add(entry, reason); };
  const auto& registry = keyword_registry();
  for (std::size_t k = 0; k < registry.size(); ++k)
    registry[k]->move(deck, static_cast<std::int32_t>(k), motion_of, refuse);
  refusals.finish();
  warn_of_loads(deck, motions, diagnostics);
}

}  // namespace courant
