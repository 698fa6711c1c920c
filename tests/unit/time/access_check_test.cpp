// What a pass declares is all that it touches, and each declaration is needed: in builds that check
// (COURANT_CHECK_ACCESSES).
#include "time/access_check.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <set>

#include <fmt/format.h>

#include "app/simulation.hpp"
#include "base/run_error.hpp"

using namespace courant;

namespace {

struct AcceptedDeck {
  std::filesystem::path file;
  std::unique_ptr<Simulation> build() const {
    Diagnostics diagnostics;
    return Simulation::build(file.string(), {}, diagnostics);
  }
};

std::vector<AcceptedDeck> decks_that_run() {
  std::vector<AcceptedDeck> out;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(SOURCE_DIR) + "/tests/decks/accept"))
    if (entry.path().extension() == ".k")
      if (const AcceptedDeck deck{entry.path()}; deck.build()) out.push_back(deck);
  std::sort(out.begin(), out.end(),
            [](const AcceptedDeck& a, const AcceptedDeck& b) { return a.file < b.file; });
  return out;
}

/// A few steps: enough for every pass that a deck asks for.
void take_steps(Simulation& s) {
  for (int k = 0; k < 3; ++k) s.step([](World&, const Clock&, const std::string&) {});
}

}  // namespace

TEST(AccessCheck, PassesOfAllDecksTouchWhatTheyDeclare) {
  if (!checks_accesses) GTEST_SKIP() << "this build does not check";
  for (const AcceptedDeck& deck : decks_that_run()) {
    auto s = deck.build();
    try {
      take_steps(*s);
    } catch (const RunError&) {  // a deck that has nothing to compute at the start
    } catch (const std::logic_error& error) {
      ADD_FAILURE() << deck.file.filename() << ": " << error.what();
    }
  }
}

TEST(AccessCheck, AMissingDeclarationIsNoticed) {
  if (!checks_accesses) GTEST_SKIP() << "this build does not check";
  std::set<std::pair<std::string, std::string>> tried;
  int noticed = 0;
  std::string missed;
  for (const AcceptedDeck& deck : decks_that_run()) {
    auto s = deck.build();
    std::vector<std::pair<std::string, std::string>> here;
    const Schedule schedule = make_schedule(s->world());
    for (const auto* stages : {&schedule.forces, &schedule.motion})
      for (const StagePlan& stage : *stages)
        for (const StagePlan::Entry& entry : stage.entries)
          for (const Access& a : entry.accesses.all())
            if (tried.emplace(entry.pass->name(), a.what->name()).second)
              here.emplace_back(entry.pass->name(), a.what->name());
    for (const auto& [pass, resource] : here) {
      leave_out_declaration(pass, resource);
      auto broken = deck.build();
      leave_out_declaration("", "");
      bool seen = false;
      try {
        take_steps(*broken);
      } catch (const std::logic_error&) {
        seen = true;
      } catch (const RunError&) {
        seen = true;
      }
      noticed += seen;
      if (!seen) missed += fmt::format("  {} of '{}' ({})\n", resource, pass, deck.file.filename().string());
    }
  }
  RecordProperty("declarations", int(tried.size()));
  RecordProperty("noticed", noticed);
  // Of the rest a third is no field, a third what contact and mirrors do where these decks touch nothing at
  // the start, and a third is read for messages of faults alone.
  EXPECT_GE(noticed, 0.84 * double(tried.size())) << missed;
  std::cout << noticed << " of " << tried.size() << " missing declarations are noticed\n" << missed;
}
