// Sets, curves and boxes.
#include <fmt/format.h>
#include <algorithm>

#include "model/model_builder.hpp"

namespace courant {

namespace {

void remove_repeats(std::vector<Index>& members) {
  std::sort(members.begin(), members.end());
  members.erase(std::unique(members.begin(), members.end()), members.end());
}

}  // namespace

void ModelBuilder::build_node_sets() {
  const auto open = [&](const SetCard& card, std::string_view field) {
    if (card.ids.empty()) error(card, field, "the set is empty", "list its nodes below the first card");
    return &model_.node_sets[card.sid];
  };
  for (const SetNodeCard& card : deck_.all<SetNodeCard>()) {
    std::vector<Index>* members = open(card, "NID");
    for (const Id id : card.ids)
      if (const Index n = node(card, "NID", id); n >= 0) members->push_back(n);
    remove_repeats(*members);
  }
  for (const SetNodeGenerateCard& card : deck_.all<SetNodeGenerateCard>())
    add_generated(card, *open(card, "BNBEG"));
}

void ModelBuilder::add_generated(const SetNodeGenerateCard& card, std::vector<Index>& members) {
  if (card.ids.size() % 2 != 0) {
    error(card, "BNBEG", "the last range has a first id, but no last id");
    return;
  }
  std::vector<bool> is_member(model_.nodes.size(), false);  // ranges may overlap: nodes must not add up
  bool found = false;
  const auto add = [&](Index n) {
    found = true;
    if (!is_member[static_cast<std::size_t>(n)]) members.push_back(n);
    is_member[static_cast<std::size_t>(n)] = true;
  };
  for (std::size_t r = 0; r < card.ids.size(); r += 2) {
    const Id begin = card.ids[r], end = card.ids[r + 1];
    if (end < begin) {
      error(card, "BNBEG", fmt::format("the range {} to {} runs backwards", begin, end));
      return;
    }
    found = false;
    // whichever is shorter: the range of ids or the list of nodes
    if (end - begin < static_cast<Id>(model_.nodes.size())) {
      for (Id id = begin; id <= end; ++id)
        if (const Index n = node_of_id_.find(id); n >= 0) add(n);
    } else {
      for (std::size_t n = 0; n < model_.nodes.size(); ++n)
        if (model_.nodes[n].id >= begin && model_.nodes[n].id <= end) add(static_cast<Index>(n));
    }
    if (!found) error(card, "BNBEG", fmt::format("there is no node with an id from {} to {}", begin, end));
  }
  remove_repeats(members);
}

void ModelBuilder::build_part_sets() {
  for (const SetPartCard& card : deck_.all<SetPartCard>()) {
    if (card.ids.empty()) error(card, "PID", "the set is empty", "list its parts below the first card");
    std::vector<Index>& members = model_.part_sets[card.sid];
    for (const Id id : card.ids)
      if (const Index p = part(card, "PID", id); p >= 0) members.push_back(p);
    remove_repeats(members);
  }
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
    if (card.sfa < 0) {
      std::reverse(curve.abscissa.begin(), curve.abscissa.end());
      std::reverse(curve.ordinate.begin(), curve.ordinate.end());
    }
    for (std::size_t i = 1; i < curve.abscissa.size(); ++i) {
      if (curve.abscissa[i] > curve.abscissa[i - 1]) continue;
      error(card, "A1",
            fmt::format("the abscissas of curve {} do not increase from point {} to point {}", card.lcid, i,
                        i + 1));
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
