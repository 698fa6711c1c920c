#include "state/field.hpp"

#include <gtest/gtest.h>

using namespace courant;

namespace {

constexpr Index many = 3 * block_size + 17;  // several blocks and a part of one

}  // namespace

TEST(Field, NewEntitiesAreZeroAndOldOnesStay) {
  FieldSet set("test");
  Field<Real>& a = set.add<Real>({.name = "a", .dimension = "-", .components = 3});
  set.resize(2);
  a.set(0, {1, 2, 3});
  a.set(1, {4, 5, 6});
  set.resize(many);
  Field<Index>& late = set.add<Index>({.name = "late", .dimension = "-"});
  EXPECT_EQ(a.vec(0), Vec(1, 2, 3));
  EXPECT_EQ(a.vec(1), Vec(4, 5, 6));
  for (Index i = 2; i < many; ++i) {
    ASSERT_EQ(a.vec(i), Vec(0, 0, 0)) << i;
    ASSERT_EQ(late[i], 0) << i;
  }
  a.fill(7);
  set.resize(5);
  set.resize(many);
  EXPECT_EQ(a.vec(4), Vec(7, 7, 7));
  EXPECT_EQ(a.vec(many - 1), Vec(0, 0, 0));
}

class Permutation : public testing::TestWithParam<Index> {};
INSTANTIATE_TEST_SUITE_P(AllAndSome, Permutation, testing::Values(many, many - 9));

TEST_P(Permutation, SortsFieldsOfAllTypesAndKeepsWhatStandsBehind) {
  FieldSet set("test");
  Field<Real>& x = set.add<Real>({.name = "x", .dimension = "L", .components = 3});
  Field<Real>& m = set.add<Real>({.name = "m", .dimension = "M"});
  Field<Id>& id = set.add<Id>({.name = "id", .dimension = "-"});
  Field<Index>& part = set.add<Index>({.name = "part", .dimension = "-"});
  set.resize(many);
  for (Index i = 0; i < many; ++i)
    x.set(i, {1.0 * i, 2.0 * i, 3.0 * i}), m[i] = 4.0 * i, id[i] = 5 * i, part[i] = 6 * i;
  const Index sorted = GetParam();
  std::vector<Index> old_of_new(sorted);
  for (Index i = 0; i < sorted; ++i) old_of_new[i] = sorted - 1 - i;
  for (const int times : {1, 2}) {
    set.permute(old_of_new);
    for (Index i = 0; i < many; ++i) {
      const Index old = i >= sorted || times == 2 ? i : sorted - 1 - i;
      ASSERT_EQ(x.vec(i), Vec(1.0 * old, 2.0 * old, 3.0 * old));
      ASSERT_EQ(m[i], 4.0 * old);
      ASSERT_EQ(id[i], 5 * old);
      ASSERT_EQ(part[i], 6 * old);
    }
  }
}

TEST(FieldSet, CountsItsBytes) {
  FieldSet set("test");
  EXPECT_EQ(set.bytes_per_entity(), 0u);
  set.add<Real>({.name = "x", .dimension = "L", .components = 3});
  set.add<Id>({.name = "id", .dimension = "-"});
  set.add<Index>({.name = "part", .dimension = "-"});
  const std::size_t for_sorting = 8 + 8 + 4;  // of each type
  EXPECT_EQ(set.bytes_per_entity(), 24 + 8 + 4 + for_sorting);
}
