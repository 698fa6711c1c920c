#include "extension/additions.hpp"

#include <gtest/gtest.h>

namespace courant {
namespace {

TEST(Additions, AreTakenInAsTheyAreDefined) {
  const std::size_t before = additions().size();
  const RegisterAddition one(
      "nobody", [](const Deck&, const Model&, World&, Diagnostics&) {},
      [](const Deck&, const Model&) {
        return std::vector<Index>{3, 5};
      });
  ASSERT_EQ(additions().size(), before + 1);
  EXPECT_EQ(additions().back().name, "nobody");
  EXPECT_EQ(added_nodes(Deck{}, Model{}), (std::vector<Index>{3, 5}));
  additions().pop_back();
}

}  // namespace
}  // namespace courant
