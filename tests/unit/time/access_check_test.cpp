// What a pass declares is all that it touches, and each declaration is needed: in builds that check
// (COURANT_CHECK_ACCESSES).
#include "time/access_check.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <iostream>
#include <set>

#include <fmt/format.h>

#include "app/run/simulation.hpp"
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

/// A few steps with outputs: enough for every pass that a deck asks for.
void take_steps(Simulation& s) {
  for (int k = 0; k < 3; ++k)
    s.step([&s](World&, const Clock&, const std::string&) { s.show_wall_forces(); });
}

/// Pass and resource.
using Declaration = std::pair<std::string, std::string>;

std::set<Declaration> declarations(const World& world) {
  std::set<Declaration> out;
  const Schedule schedule = make_schedule(world);
  for (const auto* stages : {&schedule.forces, &schedule.motion})
    for (const StagePlan& stage : *stages)
      for (const StagePlan::Entry& entry : stage.entries)
        for (const Access& a : entry.accesses.all()) out.emplace(entry.pass->name(), a.what->name());
  return out;
}

/// What becomes of the first steps: nothing, a run that cannot go on, or a fault of a pass.
enum class Outcome { good, run_error, fault };

Outcome steps_of(Simulation& s) {
  try {
    take_steps(s);
  } catch (const std::logic_error&) {
    return Outcome::fault;
  } catch (const RunError&) {
    return Outcome::run_error;
  }
  return Outcome::good;
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

namespace {

/// The same for all passes of a kind, of which a deck may have several that differ by a number.
Declaration kind_of(const Declaration& d) {
  const auto without_numbers = [](std::string text) {
    std::erase_if(text, [](unsigned char c) { return std::isdigit(c) != 0; });
    return text;
  };
  return {without_numbers(d.first), without_numbers(d.second)};
}

}  // namespace

// Each declaration is left out in the decks that have it, until one notices.
TEST(AccessCheck, AMissingDeclarationIsNoticed) {
  if (!checks_accesses) GTEST_SKIP() << "this build does not check";
  std::set<Declaration> tried, noticed;
  for (const AcceptedDeck& deck : decks_that_run()) {
    auto whole = deck.build();
    const std::set<Declaration> here = declarations(whole->world());
    const Outcome expected = steps_of(*whole);
    for (const Declaration& d : here) {
      tried.insert(kind_of(d));
      if (noticed.contains(kind_of(d))) continue;
      leave_out_declaration(d.first, d.second);
      auto broken = deck.build();
      leave_out_declaration("", "");
      if (steps_of(*broken) != expected) noticed.insert(kind_of(d));
    }
  }
  std::string missed;
  for (const auto& [pass, resource] : tried)
    if (!noticed.contains({pass, resource})) missed += fmt::format("  {} of '{}'\n", resource, pass);
  RecordProperty("declarations", int(tried.size()));
  RecordProperty("noticed", int(noticed.size()));
  EXPECT_GE(double(noticed.size()), 0.95 * double(tried.size())) << missed;
  std::cout << noticed.size() << " of " << tried.size() << " missing declarations are noticed\n" << missed;
}
