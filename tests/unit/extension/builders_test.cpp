#include "extension/builders.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "extension/additions.hpp"
#include "extension/part_values.hpp"

namespace courant {
namespace {

struct Wheels {
  int count = 0;
};
struct Cars {
  int count = 0;
};

WorldBuilder named(BuildPhase phase, std::string name, std::vector<std::type_index> fills,
                   std::vector<std::type_index> reads) {
  return {phase, std::move(name), false, std::move(fills), std::move(reads), {}};
}

std::vector<std::string> names(const std::vector<WorldBuilder>& all) {
  std::vector<std::string> out;
  for (const WorldBuilder* builder : in_order(all)) out.push_back(builder->name);
  return out;
}

TEST(Builders, RunByPhaseThenByWhatTheyReadThenByName) {
  const std::vector<WorldBuilder> all{named(BuildPhase::nodes, "a late one", {}, {}),
                                      named(BuildPhase::parts, "b reads", {}, {typeid(Wheels)}),
                                      named(BuildPhase::parts, "y fills", {typeid(Wheels)}, {}),
                                      named(BuildPhase::parts, "z fills, too", {typeid(Wheels)}, {}),
                                      named(BuildPhase::parts, "c", {}, {typeid(Cars)})};
  const std::vector<std::string> expected{"c", "y fills", "z fills, too", "b reads", "a late one"};
  EXPECT_EQ(names(all), expected);
  std::vector<WorldBuilder> shuffled = all;
  std::sort(shuffled.begin(), shuffled.end(),
            [](const WorldBuilder& a, const WorldBuilder& b) { return a.name > b.name; });
  EXPECT_EQ(names(shuffled), expected) << "files register in any order";
}

TEST(Builders, ThatWaitForEachOtherAreNamed) {
  const std::vector<WorldBuilder> all{named(BuildPhase::parts, "hen", {typeid(Wheels)}, {typeid(Cars)}),
                                      named(BuildPhase::parts, "egg", {typeid(Cars)}, {typeid(Wheels)})};
  try {
    in_order(all);
    FAIL();
  } catch (const std::logic_error& e) {
    EXPECT_STREQ(e.what(), "builders wait for each other: egg, hen");
  }
  const std::vector<WorldBuilder> apart{named(BuildPhase::parts, "hen", {typeid(Wheels)}, {typeid(Cars)}),
                                        named(BuildPhase::nodes, "egg", {typeid(Cars)}, {typeid(Wheels)})};
  EXPECT_EQ(names(apart), (std::vector<std::string>{"hen", "egg"}))
      << "an earlier phase waits for none later";
}

/// Takes what a test registers out again.
class Registered : public testing::Test {
 protected:
  ~Registered() override { world_builders().resize(before_, WorldBuilder{BuildPhase::model, ""}); }
  const std::size_t before_ = world_builders().size();
};

void fill(Wheels& wheels) {
  wheels.count = 4;
}
void read(const Wheels& wheels, Cars& cars) {
  cars.count = wheels.count / 4;
}

TEST_F(Registered, FunctionsSayWhatTheyFillAndReadByTheirParameters) {
  const RegisterBuilder late(BuildPhase::model, "a", read, Errors::go_on);
  const RegisterBuilder early(BuildPhase::model, "b", fill);
  const WorldBuilder &a = world_builders()[before_], &b = world_builders()[before_ + 1];
  EXPECT_TRUE(a.goes_on);
  EXPECT_FALSE(b.goes_on);
  EXPECT_EQ(a.reads, std::vector<std::type_index>{typeid(Wheels)});
  EXPECT_EQ(a.fills, std::vector<std::type_index>{typeid(Cars)});
  Assembly assembly;
  b.run(assembly), a.run(assembly);
  EXPECT_EQ(assembly.get<Cars>().count, 1);
  EXPECT_TRUE(assembly.get<LeftOut>().notes.empty()) << "nothing filled it";
}

TEST_F(Registered, AdditionsBringTheirNodes) {
  const RegisterAddition one(
      "an addition", [](const Deck&, const Model&, World&, Diagnostics&) {},
      [](const Deck&, const Model&) {
        return std::vector<Index>{3, 5};
      });
  ASSERT_EQ(world_builders().size(), before_ + 2);
  Deck deck;
  Model model;
  Assembly assembly;
  assembly.lend(deck), assembly.lend(model);
  world_builders()[before_].run(assembly);
  EXPECT_EQ(assembly.get<MoreNodes>().nodes, (std::vector<Index>{3, 5}));
  EXPECT_TRUE(assembly.get<Movers>().any);
}

TEST(BuildersOfTheLibrary, DoNotWaitForEachOther) {
  EXPECT_EQ(in_order(world_builders()).size(), world_builders().size());
}

}  // namespace
}  // namespace courant
