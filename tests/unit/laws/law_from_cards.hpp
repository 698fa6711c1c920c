#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>

#include "laws/strength/strength.hpp"
#include "model/build_model.hpp"

namespace courant::test {

/// The law that right cards, with the curves behind them, make.
inline std::shared_ptr<StrengthLaw> law_from_cards(const std::string& keyword, const std::string& cards) {
  ReadOptions options;
  options.open = [&](const std::string&) {
    return std::optional<std::string>("*KEYWORD\n*" + keyword + "\n" + cards + "*END\n");
  };
  Diagnostics diagnostics;
  const Deck deck = read_deck("m.k", options, diagnostics);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.text();
  Diagnostics of_no_whole_model;
  const Model model = build_model(deck, of_no_whole_model);
  for (const StrengthEntry& kind : strength_registry())
    if (kind.keyword == keyword) return kind.all(deck, model).at(0).second;
  return nullptr;
}

}  // namespace courant::test
