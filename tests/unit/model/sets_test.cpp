// Members of every kind of set, told in every form.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "keyword/registry.hpp"
#include "model/sets/set_cards.hpp"
#include "small_deck.hpp"

namespace courant {

namespace {

using Ids = std::vector<Id>;

struct Case {
  const char* name;
  const char* keywords;
  Ids expected{};
};

template <class Entity>
Ids ids_of(const std::vector<Entity>& entities, const std::vector<Index>& members) {
  Ids out;
  for (const Index m : members) out.push_back(entities[static_cast<std::size_t>(m)].id);
  return out;
}

const auto name_of_set_case = [](const auto& test) { return std::string(test.param.name); };

class NodeSet : public testing::TestWithParam<Case> {};

TEST_P(NodeSet, HasItsMembers) {  // the set of interest is number 1
  const SmallModel m = small_model(GetParam().keywords);
  EXPECT_EQ(m.messages, "");
  ASSERT_EQ(m.model.node_sets.count(1), 1u);
  EXPECT_EQ(ids_of(m.model.nodes, m.model.node_sets.at(1)), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(
    Forms, NodeSet,
    testing::Values(
        Case{"List", "*SET_NODE_LIST\n1\n3,1,3\n2\n", {1, 2, 3}},
        Case{"ListWithoutTheWord", "*SET_NODE\n1\n3\n", {3}},
        Case{"ListTitle", "*SET_NODE_LIST_TITLE\nsome nodes\n1\n3\n", {3}},
        Case{"AttributesHaveNoEffect", "*SET_NODE_LIST\n1,0.5,1.,2.,3.,MECH,2\n3\n", {3}},
        Case{"Generate", "*SET_NODE_LIST_GENERATE\n1\n2,4,8,10\n", {2, 3, 4, 8, 9}},
        Case{"GenerateWithPairsLeftOut", "*SET_NODE_LIST_GENERATE\n1\n2,4,0,0,,,8,10\n", {2, 3, 4, 8, 9}},
        Case{"GenerateWithoutTheWord", "*SET_NODE_GENERATE\n1\n12,100000000000\n", {12}},
        Case{"Increment", "*SET_NODE_LIST_GENERATE_INCREMENT\n1\n1,9,4\n11,12\n", {1, 5, 9, 11, 12}},
        Case{"IncrementOverManyIds", "*SET_NODE_GENERATE_INCREMENT\n1\n2,900000000000,3\n", {2, 5, 8, 11}},
        Case{"Column", "*SET_NODE_COLUMN\n1\n4,.5,.5,.5,.5\n2\n", {2, 4}},
        Case{"Add", "*SET_NODE_ADD\n1\n2,3\n*SET_NODE\n2\n5,6\n*SET_NODE\n3\n6,7\n", {5, 6, 7}},
        Case{"AddOfAdd", "*SET_NODE_ADD\n1\n2\n*SET_NODE_ADD\n2\n3\n*SET_NODE\n3\n7\n", {7}},
        Case{"Intersect", "*SET_NODE_INTERSECT\n1\n2,3\n*SET_NODE\n2\n5,6,8\n*SET_NODE\n3\n6,7,8\n", {6, 8}},
        Case{"AddAdvanced",
             "*SET_NODE_ADD_ADVANCED\n1\n2,1,2,2,2,5\n*SET_NODE\n2\n12\n*SET_SHELL\n2\n4\n"
             "*SET_SEGMENT\n2\n1,2,5,4\n",
             {1, 2, 4, 5, 6, 9, 12}},
        Case{"Collect", "*SET_NODE_LIST\n1\n3\n*SET_NODE_COLUMN_COLLECT\n1\n5\n", {3, 5}},
        Case{"CollectTitle", "*SET_NODE_COLLECT_TITLE\na\n1\n3\n*SET_NODE_TITLE_COLLECT\nb\n1\n5\n", {3, 5}},
        Case{"GeneralAll", "*SET_NODE_GENERAL\n1\nALL\n", {1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 12}},
        Case{"GeneralNode", "*SET_NODE_GENERAL\n1\nNODE,5,6\n", {5, 6}},
        Case{"GeneralLowerCase", "*SET_NODE_GENERAL\n1\nnode,5,6\ndnode,5\n", {6}},
        Case{"GeneralFixedFormat", "*SET_NODE_GENERAL\n         1\nNODE               5         6\n", {5, 6}},
        Case{"GeneralPart", "*SET_NODE_GENERAL\n1\nPART,1,3\n", {4, 5, 6, 7, 8, 9, 11, 12}},
        Case{"GeneralTakesOut", "*SET_NODE_GENERAL\n1\nALL\nDPART,1,2\nDNODE,7\n", {8, 9}},
        Case{"GeneralInTheOrderOfTheRows", "*SET_NODE_GENERAL\n1\nDNODE,5\nNODE,5,6\nDNODE,6\n", {5}},
        Case{"GeneralBox", "*SET_NODE_GENERAL\n1\nBOX,4\n*DEFINE_BOX\n4,0.,1.,0.,1.,0.,0.\n", {1, 2, 4, 5}},
        Case{"GeneralDbox",
             "*SET_NODE_GENERAL\n1\nPART,2\nDBOX,4\n*DEFINE_BOX\n4,0.,1.,0.,1.,0.,0.\n",
             {3, 6}},
        Case{"GeneralSetShell", "*SET_NODE_GENERAL\n1\nSET_SHELL,2\n*SET_SHELL\n2\n4\n", {5, 6, 9}},
        Case{
            "GeneralDsetShell", "*SET_NODE_GENERAL\n1\nPART,3\nDSET_SHELL,2\n*SET_SHELL\n2\n4\n", {4, 7, 8}}),
    name_of_set_case);

class PartSet : public testing::TestWithParam<Case> {};

TEST_P(PartSet, HasItsMembers) {
  const SmallModel m = small_model(GetParam().keywords);
  EXPECT_EQ(m.messages, "");
  ASSERT_EQ(m.model.part_sets.count(1), 1u);
  EXPECT_EQ(ids_of(m.model.parts, m.model.part_sets.at(1)), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(
    Forms, PartSet,
    testing::Values(Case{"List", "*SET_PART_LIST\n1\n3,1\n", {1, 3}}, Case{"Short", "*SET_PART\n1\n2\n", {2}},
                    Case{"Generate", "*SET_PART_LIST_GENERATE\n1\n2,99\n", {2, 3}},
                    Case{"Increment", "*SET_PART_LIST_GENERATE_INCREMENT\n1\n1,3,2\n", {1, 3}},
                    Case{"Column", "*SET_PART_COLUMN\n1\n2,.1\n", {2}},
                    Case{"Add", "*SET_PART_ADD\n1\n2,3\n*SET_PART\n2\n1\n*SET_PART\n3\n3\n", {1, 3}},
                    Case{"GeneralAll", "*SET_PART_GENERAL\n1\nALL\nDPART,2\n", {1, 3}},
                    Case{"GeneralSet",
                         "*SET_PART_GENERAL\n1\nPART,1\nSET,2\nDSET,3\n*SET_PART\n2\n2,3\n*SET_PART\n3\n1\n",
                         {2, 3}}),
    name_of_set_case);

class ShellSet : public testing::TestWithParam<Case> {};

TEST_P(ShellSet, HasItsMembers) {
  const SmallModel m = small_model(GetParam().keywords);
  EXPECT_EQ(m.messages, "");
  ASSERT_EQ(m.model.shell_sets.count(1), 1u);
  EXPECT_EQ(ids_of(m.model.shells, m.model.shell_sets.at(1)), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(
    Forms, ShellSet,
    testing::Values(
        Case{"List", "*SET_SHELL_LIST\n1\n4,2\n", {2, 4}},
        Case{"Generate", "*SET_SHELL_LIST_GENERATE\n1\n2,3\n", {2, 3}},
        Case{"Increment", "*SET_SHELL_GENERATE_INCREMENT\n1\n1,4,3\n", {1, 4}},
        Case{"Column", "*SET_SHELL_COLUMN\n1\n4\n", {4}},
        Case{"Add", "*SET_SHELL_ADD\n1\n2\n*SET_SHELL\n2\n3\n", {3}},
        Case{"Intersect", "*SET_SHELL_INTERSECT\n1\n2,3\n*SET_SHELL\n2\n1,3\n*SET_SHELL\n3\n3,4\n", {3}},
        Case{"GeneralElem", "*SET_SHELL_GENERAL\n1\nELEM,1,2\nDELEM,1\n", {2}},
        Case{"GeneralPart", "*SET_SHELL_GENERAL\n1\nALL\nDPART,2\n", {3, 4}},
        Case{"GeneralBoxHoldsAllNodes",
             "*SET_SHELL_GENERAL\n1\nBOX,4\n*DEFINE_BOX\n4,0.,2.,0.,1.5,0.,0.\n",
             {1, 2}},
        Case{"GeneralSet", "*SET_SHELL_GENERAL\n1\nALL\nDSET,2\n*SET_SHELL\n2\n3,4\n", {1, 2}}),
    name_of_set_case);

struct SegmentCase {
  const char* name;
  const char* keywords;
  std::vector<std::array<Id, 4>> expected{};
};

class SegmentSet : public testing::TestWithParam<SegmentCase> {};

TEST_P(SegmentSet, HasItsMembers) {
  const SmallModel m = small_model(GetParam().keywords);
  EXPECT_EQ(m.messages, "");
  ASSERT_EQ(m.model.segment_sets.count(1), 1u);
  std::vector<std::array<Id, 4>> found;
  for (const Index s : m.model.segment_sets.at(1)) {
    const Ids corners = ids_of(m.model.nodes, {m.model.segments[static_cast<std::size_t>(s)].node.begin(),
                                               m.model.segments[static_cast<std::size_t>(s)].node.end()});
    found.push_back({corners[0], corners[1], corners[2], corners[3]});
  }
  EXPECT_EQ(found, GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(
    Forms, SegmentSet,
    testing::Values(
        SegmentCase{"Quad", "*SET_SEGMENT\n1\n1,2,5,4,.1,.2\n", {{1, 2, 5, 4}}},
        SegmentCase{"Triangles", "*SET_SEGMENT\n1\n1,2,5,5\n2,3,6\n", {{1, 2, 5, 5}, {2, 3, 6, 6}}},
        SegmentCase{"Line", "*SET_SEGMENT\n1\n1,2\n", {{1, 2, 2, 2}}},
        SegmentCase{"TheSameTwice", "*SET_SEGMENT\n1\n1,2,5,4\n5,4,1,2\n", {{1, 2, 5, 4}}},
        SegmentCase{"TheOtherSideUp", "*SET_SEGMENT\n1\n1,2,5,4\n4,5,2,1\n", {{1, 2, 5, 4}, {4, 5, 2, 1}}},
        SegmentCase{"Add", "*SET_SEGMENT_ADD\n1\n2\n*SET_SEGMENT\n2\n1,2,5,4\n", {{1, 2, 5, 4}}},
        SegmentCase{"GeneralAll",
                    "*SET_SEGMENT_GENERAL\n1\nALL\n",
                    {{1, 2, 5, 4}, {2, 3, 6, 5}, {4, 5, 8, 7}, {5, 6, 9, 9}}},
        SegmentCase{"GeneralPartAsTheShellsAreTurned",
                    "*SET_SEGMENT_GENERAL\n1\nPART,3,0,0,.5,.5,.5,.5\n",
                    {{4, 5, 8, 7}, {5, 6, 9, 9}}},
        SegmentCase{"GeneralBox",
                    "*SET_SEGMENT_GENERAL\n1\nBOX_SHELL,4\n*DEFINE_BOX\n4,0.,1.,0.,1.,0.,0.\n",
                    {{1, 2, 5, 4}}},
        SegmentCase{"GeneralSeg", "*SET_SEGMENT_GENERAL\n1\nSEG,1,2,5,4\n", {{1, 2, 5, 4}}},
        SegmentCase{"GeneralDsegWhicheverSideIsUp",
                    "*SET_SEGMENT_GENERAL\n1\nPART,2\nDSEG,4,5,2,1\n",
                    {{2, 3, 6, 5}}},
        SegmentCase{
            "GeneralSetShell", "*SET_SEGMENT_GENERAL\n1\nSET_SHELL,2\n*SET_SHELL\n2\n4\n", {{5, 6, 9, 9}}},
        SegmentCase{"GeneralDset",
                    "*SET_SEGMENT_GENERAL\n1\nPART,2\nDSET,2\n*SET_SEGMENT\n2\n1,2,5,4\n",
                    {{2, 3, 6, 5}}}),
    name_of_set_case);

struct SetFault {
  const char* name;
  const char* keywords;
  const char* message;
};

class FaultySet : public testing::TestWithParam<SetFault> {};

TEST_P(FaultySet, IsRefused) {
  const SmallModel m = small_model(GetParam().keywords);
  EXPECT_NE(m.messages.find(GetParam().message), std::string::npos) << m.messages;
}

INSTANTIATE_TEST_SUITE_P(
    Reasons, FaultySet,
    testing::Values(
        SetFault{"NodeMissing", "*SET_NODE_COLUMN\n1\n5\n10\n",
                 "(NID, node id [-]): node 10 has no coordinates"},
        SetFault{"ShellMissing", "*SET_SHELL\n1\n5\n*DATABASE_HISTORY_SHELL_SET\n1\n",
                 "shell 5 does not exist\n  hint: define it with *ELEMENT_SHELL"},
        SetFault{"SolidMissing", "*SET_SOLID\n1\n5\n*DATABASE_HISTORY_SOLID_SET\n1\n",
                 "solid 5 does not exist\n  hint: define it with *ELEMENT_SOLID"},
        SetFault{"SetMissing", "*SET_NODE_ADD\n1\n2\n",
                 "node set 2 does not exist\n  hint: define it with *SET_NODE_LIST"},
        SetFault{"Itself", "*SET_NODE_ADD\n1\n1\n",
                 "a set cannot be made of itself: node set 1 needs node set 1\n"},
        SetFault{"Cycle",
                 "*SET_NODE_ADD\n1\n2\n*SET_NODE_INTERSECT\n2\n3\n*SET_NODE_GENERAL\n3\nSET_SHELL,4\n"
                 "*SET_SHELL_ADD\n4\n5\n*SET_SHELL_ADD\n5\n4\n",
                 "a set cannot be made of itself: shell set 4 needs shell set 5 needs shell set 4\n"},
        SetFault{"NothingShared", "*SET_NODE_INTERSECT\n1\n2,3\n*SET_NODE\n2\n5\n*SET_NODE\n3\n6\n",
                 "the set is empty\n  hint: its sets share no node"},
        SetFault{"NothingLeft", "*SET_PART_GENERAL\n1\nPART,1\nDPART,1\n",
                 "the set is empty\n  hint: its rows leave no part"},
        SetFault{"NoRows", "*SET_SHELL_GENERAL\n1\n",
                 "the set is empty\n  hint: give a row such as ALL or PART"},
        SetFault{"NoSets", "*SET_SHELL_INTERSECT\n1\n",
                 "the set is empty\n  hint: list its sets below the first card"},
        SetFault{
            "RowUnknown", "*SET_NODE_GENERAL\n1\nVOL,3\n",
            "'VOL' is not supported\n  hint: supported: ALL, NODE, PART, BOX, SET_SHELL, SET_SOLID; with D "
            "in front"},
        SetFault{"RowDall", "*SET_NODE_GENERAL\n1\nDALL\n", "'DALL' is not supported"},
        SetFault{"RowOfHalfANode", "*SET_SEGMENT_GENERAL\n1\nSEG,1,2,3,4.6\n",
                 "expected a node id, got '4.6'"},
        SetFault{"RowWithoutId", "*SET_NODE_GENERAL\n1\nPART\n", "PART has no id behind it"},
        SetFault{"RowPartMissing", "*SET_SHELL_GENERAL\n1\nPART,9\n", "part 9 does not exist"},
        SetFault{"RowBoxMissing", "*SET_SHELL_GENERAL\n1\nDBOX,9\n",
                 "box 9 does not exist\n  hint: define it with *DEFINE_BOX"},
        SetFault{"RangeBackwards", "*SET_SHELL_GENERATE\n1\n4,2\n", "the range 4 to 2 runs backwards"},
        SetFault{"RangeWithoutEnd", "*SET_PART_LIST_GENERATE\n1\n4\n", "the range from 4 has no last id"},
        SetFault{"RangeWithoutEndInTheMiddle", "*SET_NODE_LIST_GENERATE\n1\n5,,12,0\n",
                 "the range from 5 has no last id"},
        SetFault{"RangeWithoutEndOnItsCard", "*SET_NODE_LIST_GENERATE\n1\n2,4,8\n10,12\n",
                 "the range from 8 has no last id"},
        SetFault{"RangeWithoutBegin", "*SET_NODE_LIST_GENERATE\n1\n0,4\n", "the range to 4 has no first id"},
        SetFault{"RangeEmpty", "*SET_SHELL_GENERATE_INCREMENT\n1\n5,90,5\n",
                 "there is no shell with an id from 5 to 90 in steps of 5"},
        SetFault{"SegmentOfOneNode", "*SET_SEGMENT\n1\n3,3,3,3\n",
                 "the segment of nodes 3 3 3 3 has less than two corners"},
        SetFault{"SegmentNodeMissing", "*SET_SEGMENT\n1\n1,2,10,4\n", "node 10 has no coordinates"},
        SetFault{"AdvancedWithoutKind", "*SET_NODE_ADD_ADVANCED\n1\n2\n*SET_NODE\n2\n5\n",
                 "set 2 has no kind beside it"},
        SetFault{"AdvancedBeams", "*SET_NODE_ADD_ADVANCED\n1\n2,3\n",
                 "'3' is not supported\n  hint: supported values: 0, 1, 2, 4, 5"},
        SetFault{"Twice", "*SET_SEGMENT\n1\n1,2\n*SET_SEGMENT_ADD\n1\n1\n",
                 "segment set 1 is defined twice, first as *SET_SEGMENT at deck.k"},
        SetFault{"FacesOfSolids",
                 "*ELEMENT_SOLID\n1,1\n1,2,4,5,6,7,8,9,11,12\n*SET_SEGMENT_GENERAL\n1\nPART,1\n",
                 "segments on the faces of solids with nodes on edges are not supported"}),
    name_of_set_case);

/// Corners of segments by node id, from the lowest.
std::set<Ids> segments_of(const SmallModel& m, Id set) {
  std::set<Ids> out;
  for (const Index s : m.model.segment_sets.at(set)) {
    Ids ids;
    for (const Index n : m.model.segments[static_cast<std::size_t>(s)].node)
      ids.push_back(m.model.nodes[static_cast<std::size_t>(n)].id);
    if (ids[2] == ids[3]) ids.pop_back();
    std::rotate(ids.begin(), std::min_element(ids.begin(), ids.end()), ids.end());
    out.insert(ids);
  }
  return out;
}

// Two tetrahedra that share a face: six exposed ones, outward; those with all nodes in a box.
TEST(Sets, OfExposedFacesOfSolids) {
  const SmallModel m = small_model(
      "*NODE\n51,0,0,0\n52,1,0,0\n53,0,1,0\n54,0,0,1\n55,0,0,-1\n"
      "*ELEMENT_SOLID\n11,1,51,52,53,54,54,54,54,54\n12,1,51,53,52,55,55,55,55,55\n"
      "*DEFINE_BOX\n7,-0.1,1.1,-0.1,1.1,-0.1,1.1\n"
      "*SET_SEGMENT_GENERAL\n1\nPART,1\nDBOX,7\n*SET_SEGMENT_GENERAL\n2\nBOX,7\n*SET_SEGMENT_GENERAL\n3\n"
      "BOX_SHELL,7\n*SET_SEGMENT_GENERAL\n4\nALL\n");
  const std::set<Ids> above{{51, 52, 54}, {52, 53, 54}, {51, 54, 53}},
      below{{51, 53, 55}, {52, 55, 53}, {51, 55, 52}};
  const std::set<Ids> in_box = segments_of(m, 2), part = segments_of(m, 1);
  EXPECT_TRUE(std::includes(in_box.begin(), in_box.end(), above.begin(), above.end()));
  EXPECT_TRUE(std::includes(part.begin(), part.end(), below.begin(), below.end()));
  for (const Ids& face : above) EXPECT_FALSE(part.contains(face));
  for (const Ids& face : below) EXPECT_FALSE(in_box.contains(face));
  const std::set<Ids> all = segments_of(m, 4);
  for (const auto& faces : {above, below})
    for (const Ids& face : faces) EXPECT_TRUE(all.contains(face));
  EXPECT_FALSE(all.contains({51, 52, 53}) || all.contains({51, 53, 52}));
}

TEST(Sets, OfSolids) {
  const SmallModel m = small_model(
      "*ELEMENT_SOLID\n1,1,1,2,5,4,11,11,11,11\n       2       1\n       2       3       6       5      12\n"
      "*SET_SOLID\n1\n2\n*SET_SOLID_GENERATE\n2\n1,9\n*SET_SOLID_GENERAL\n3\nALL\nDELEM,2\n"
      "*SET_NODE_GENERAL\n4\nSET_SOLID,1\n");
  EXPECT_NE(m.messages.find("solid element 2 is of five to seven nodes, which is not supported"),
            std::string::npos);
  EXPECT_EQ(ids_of(m.model.solids, m.model.solid_sets.at(1)), Ids{2});
  EXPECT_EQ(ids_of(m.model.solids, m.model.solid_sets.at(2)), (Ids{1, 2}));
  EXPECT_EQ(ids_of(m.model.solids, m.model.solid_sets.at(3)), Ids{1});
  EXPECT_EQ(ids_of(m.model.nodes, m.model.node_sets.at(4)), (Ids{2, 3, 5, 6, 12}));
}

/// Two cubes of part 7 side by side along x, one of part 8 on top of the first, which share nodes.
std::string row_of_cubes(const std::string& set) {
  std::string out = "*NODE\n";
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 3; ++i) out += fmt::format("{},{}.0,{}.0,{}.0\n", 101 + i + 3 * j + 6 * k, i, j, k);
  return out +
         "*PART\ncubes\n7\n*PART\nmore\n8\n*ELEMENT_SOLID\n1,7,101,102,105,104,107,108,111,110\n2,7,102,103,"
         "106,105,108,109,112,111\n"
         "3,8,107,108,111,110,113,114,117,116\n*SET_SEGMENT_GENERAL\n9\n" +
         set;
}
/// Corners of the segments of set 9, and the outward area that they enclose: 0 where they are closed.
std::pair<std::size_t, Vec> faces_of_cubes(const std::string& set) {
  const SmallModel m = small_model(row_of_cubes(set));
  EXPECT_EQ(m.messages, "");
  Vec area = Vec::Zero();
  const auto& members = m.model.segment_sets.at(9);
  for (const Index s : members) {
    const auto& n = m.model.segments[static_cast<std::size_t>(s)].node;
    const auto x = [&](std::size_t c) { return m.model.nodes[static_cast<std::size_t>(n[c])].x; };
    area += 0.5 * Vec(x(2) - x(0)).cross(Vec(x(3) - x(1)));
  }
  return {members.size(), area};
}

TEST(Sets, FacesOfSolidsPointOutwards) {
  const auto expect = [](const std::string& set, std::size_t count, const Vec& area) {
    const auto [found, sum] = faces_of_cubes(set);
    EXPECT_EQ(found, count) << set;
    EXPECT_LT((sum - area).norm(), 1e-12) << set << sum.transpose();
  };
  expect("PART,7\n", 10, Vec::Zero());
  expect("PART,7,8\n", 16, Vec::Zero());  // each part has the face between them
  expect("BOX,5\n*DEFINE_BOX\n5,-1.,9.,-1.,9.,1.9,9.\n", 1, Vec(0, 0, 1));
  expect("BOX_SOLID,5\n*DEFINE_BOX\n5,-1.,9.,-1.,9.,-.1,.1\n", 2, Vec(0, 0, -2));
  expect("BOX_SOLID,5\n*DEFINE_BOX\n5,1.9,9.,-1.,9.,-.1,9.\n", 1, Vec(1, 0, 0));
  expect("SET_SOLID,5\n*SET_SOLID\n5\n2\n", 6, Vec::Zero());
  const SmallModel all = small_model(row_of_cubes("ALL\n"));
  EXPECT_EQ(all.model.segment_sets.at(9).size(), 16 + all.model.shells.size());
  expect("PART,8\nDBOX,5\n*DEFINE_BOX\n5,-1.,9.,-1.,9.,1.9,9.\n", 5, Vec(0, 0, -1));
}

/// One entry of a keyword with a single row below the set id, shifted as *INCLUDE_TRANSFORM does it.
template <class Card>
Card shifted_row(const std::string& name, const std::string& word, const std::vector<Real>& numbers) {
  Conversion conversion;
  conversion.offsets.node = 100, conversion.offsets.part = 200, conversion.offsets.set = 300;
  Deck deck;
  const KeywordMatch match = KeywordIndex().match(name);
  const KeywordSpec& spec = *keyword_registry()[static_cast<std::size_t>(match.keyword)];
  const auto sink = spec.sink(deck);
  sink->begin({});
  sink->set_integer(0, 0, 1);
  std::size_t field = 0;
  if (!word.empty()) sink->set_text(1, field++, word);
  for (const Real number : numbers) {
    if (spec.cards[1].fields[field].type == FieldType::reals)
      sink->set_real(1, field++, number);
    else
      sink->set_integer(1, field++, static_cast<Id>(number));
  }
  EXPECT_EQ(sink->convert(conversion), "");
  sink->commit();
  return deck.all<Card>().at(0);
}

TEST(Sets, ShiftIdsByTheWordOfTheRow) {
  using NodeGeneral = SetCardOf<SetKind::node, SetForm::general>;
  const auto part = shifted_row<NodeGeneral>("SET_NODE_GENERAL", "dpart", {3, 4});
  EXPECT_EQ(part.sid, 301);
  EXPECT_EQ(part.ids, Ids{203});
  EXPECT_EQ(part.e2, Ids{204});
  EXPECT_EQ(shifted_row<NodeGeneral>("SET_NODE_GENERAL", "SET_SHELL", {3}).ids, Ids{303});
  using SegmentGeneral = SetCardOf<SetKind::segment, SetForm::general>;
  EXPECT_EQ(shifted_row<SegmentGeneral>("SET_SEGMENT_GENERAL", "SEG", {1, 2, 3, 4}).r4,
            std::vector<Real>{104});
  const auto attribute = shifted_row<SegmentGeneral>("SET_SEGMENT_GENERAL", "PART", {1, 0, 0, 0.5});
  EXPECT_EQ(attribute.ids, Ids{201});
  EXPECT_EQ(attribute.r4, std::vector<Real>{0.5});
  using Advanced = SetCardOf<SetKind::node, SetForm::advanced>;
  EXPECT_EQ(shifted_row<Advanced>("SET_NODE_ADD_ADVANCED", "", {7, 2}).ids, Ids{307});
}

TEST(Sets, MakeNoSecondErrorOfAFault) {
  const SmallModel m = small_model("*SET_NODE_ADD\n1\n2\n*SET_NODE_ADD\n2\n3\n*SET_NODE\n3\n10\n");
  EXPECT_EQ(m.messages.find("empty"), std::string::npos) << m.messages;
  EXPECT_EQ(m.messages.find("error"), m.messages.rfind("error")) << m.messages;
}

}  // namespace

}  // namespace courant
