// Sets, curves and boxes.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "model/model_builder.hpp"
#include "model/sets/sets.hpp"

namespace courant {

void ModelBuilder::build_sets() {
  const auto report = [this](Severity severity, const Entry& entry, std::string_view field,
                             Deck::Repeat repeat, std::string message, std::string hint) {
    if (severity == Severity::error && ++errors_ > max_errors) return;
    diagnostics_.add({severity, deck_.where(entry, field, repeat),
                      deck_.describe(entry, field) + ": " + message, std::move(hint)});
  };
  SetResolver(deck_, model_, node_of_id_, report).resolve_all();
}

void ModelBuilder::build_curves() {
  for (const DefineCurveCard& card : deck_.all<DefineCurveCard>()) {
    Curve& curve = model_.curves[card.lcid];
    curve.id = card.lcid;
    if (card.a.empty())
      error(card, "A1", "the curve has no points", "give one point per line: abscissa, ordinate");
    for (std::size_t i = 0; i < std::min(card.a.size(), card.o.size()); ++i) {
      curve.abscissa.push_back(card.sfa * (card.a[i] + card.offa));
      curve.ordinate.push_back(card.sfo * (card.o[i] + card.offo));
    }
    const auto finite = [](Real v) { return std::isfinite(v); };
    if (!std::all_of(curve.abscissa.begin(), curve.abscissa.end(), finite) ||
        !std::all_of(curve.ordinate.begin(), curve.ordinate.end(), finite))
      error(card, "A1", fmt::format("SFA, SFO, OFFA and OFFO make numbers of curve {} infinite", card.lcid),
            "the numbers are too large");
    if (card.sfa < 0) {
      std::reverse(curve.abscissa.begin(), curve.abscissa.end());
      std::reverse(curve.ordinate.begin(), curve.ordinate.end());
    }
    for (std::size_t i = 1; i < curve.abscissa.size(); ++i) {
      if (curve.abscissa[i] >= curve.abscissa[i - 1]) continue;
      error(card, "A1",
            fmt::format("the abscissas of curve {} decrease from point {} to point {}", card.lcid, i, i + 1),
            "points with the same abscissa are a jump; otherwise it must increase");
      break;
    }
  }
}

void ModelBuilder::build_boxes() {
  for (const DefineBoxCard& card : deck_.all<DefineBoxCard>()) {
    const Box box{
        .id = card.boxid, .low = {card.xmn, card.ymn, card.zmn}, .high = {card.xmx, card.ymx, card.zmx}};
    const char* high[] = {"XMX", "YMX", "ZMX"};
    for (int k = 0; k < 3; ++k)
      if (box.high[k] < box.low[k])
        error(
            card, high[k],
            fmt::format("expected a number not below the lowest, {:g}, got '{:g}'", box.low[k], box.high[k]));
    model_.boxes.emplace(card.boxid, box);
  }
}

}  // namespace courant
