#include "model/sets/id_index.hpp"

#include <gtest/gtest.h>

#include <limits>

using namespace courant;

namespace {

void expect_finds_its_own(const std::vector<Id>& ids, Id lowest, Id highest) {
  IdIndex index(lowest, highest, ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) EXPECT_EQ(index.insert(ids[i], static_cast<Index>(i)), -1);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    EXPECT_EQ(index.find(ids[i]), static_cast<Index>(i));
    EXPECT_EQ(index.insert(ids[i], 99), static_cast<Index>(i)) << "the first one counts";
  }
  for (const Id other : {lowest - 1, highest + 1, lowest + 1, Id(0), Id(-7)})
    EXPECT_EQ(index.find(other), -1);
}

}  // namespace

TEST(IdIndex, FindsIdsWithoutGaps) {
  expect_finds_its_own({12, 10, 14, 13}, 10, 14);
}

TEST(IdIndex, FindsIdsFarApart) {
  expect_finds_its_own({5, 99999999, 1000}, 5, 99999999);
  expect_finds_its_own({-9000000000000000000, 9000000000000000000}, -9000000000000000000,
                       9000000000000000000);
}

TEST(IdIndex, IsEmptyAtFirst) {
  EXPECT_EQ(IdIndex().find(1), -1);
  EXPECT_EQ(IdIndex().find(0), -1);
}
