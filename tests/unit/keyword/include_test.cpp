// Where included files are looked for, and what is refused.
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "decks_in_memory.hpp"
#include "model/cards.hpp"
#include "read_and_check.hpp"

namespace courant {

namespace {

const std::string node = "*NODE\n1, 2.0, 3.0, 4.0\n";

std::string including(const std::string& lines) {
  return "*KEYWORD\n" + lines + "*END\n";
}

/// A deck that includes one file with a node: read without a word, and from where.
void expect_found(DecksInMemory decks, const std::string& main, const std::string& file) {
  Diagnostics diagnostics;
  const Deck deck = decks.read(main, diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  ASSERT_EQ(deck.files.size(), 2u);
  EXPECT_EQ(deck.files[1].name, file);
  ASSERT_EQ(deck.all<NodeCard>().size(), 1u);
  EXPECT_EQ(deck.all<NodeCard>()[0].x, 2);
}

std::string messages_of(DecksInMemory decks, const std::string& main) {
  Diagnostics diagnostics;
  decks.read(main, diagnostics);
  return diagnostics.text();
}

}  // namespace

TEST(Include, IsLookedForBesideTheIncludingFileFirst) {
  expect_found({{{"sub/main.k", including("*INCLUDE\nmesh.k\n")},
                 {"sub/mesh.k", node},
                 {"mesh.k", "*NODE\n1, 7.0\n"}}},
               "sub/main.k", "sub/mesh.k");
}

TEST(Include, IsLookedForInTheWorkingDirectoryThen) {
  expect_found({{{"sub/main.k", including("*INCLUDE_PATH\nlib\n*INCLUDE\nmesh.k\n")},
                 {"mesh.k", node},
                 {"lib/mesh.k", "*NODE\n1, 7.0\n"}}},
               "sub/main.k", "mesh.k");
}

TEST(Include, IsLookedForInTheFoldersOfIncludePathInTheirOrder) {
  expect_found(
      {{{"sub/main.k", including("*INCLUDE_PATH\nfirst\nsecond\n*INCLUDE_PATH\nthird\n*INCLUDE\nmesh.k\n")},
        {"second/mesh.k", node},
        {"third/mesh.k", "*NODE\n1, 7.0\n"}}},
      "sub/main.k", "second/mesh.k");
}

TEST(Include, PathsHoldForFilesFurtherDownOnly) {
  EXPECT_EQ(
      messages_of({{{"main.k", including("*INCLUDE\nmesh.k\n*INCLUDE_PATH\nlib\n")}, {"lib/mesh.k", node}}},
                  "main.k"),
      "main.k:3:1: error: *INCLUDE: cannot read 'mesh.k'\n  hint: looked for mesh.k\n");
}

TEST(Include, PathsMayBeRelativeToTheDeck) {
  expect_found(
      {{{"sub/main.k", including("*INCLUDE_PATH\nlib\n*INCLUDE\nmesh.k\n")}, {"sub/lib/mesh.k", node}}},
      "sub/main.k", "sub/lib/mesh.k");
}

TEST(Include, PathRelativeCountsFromTheDeckAlsoInAnIncludedFile) {
  DecksInMemory decks{{{"case/main.k", including("*INCLUDE\nparts/all.k\n")},
                       {"case/parts/all.k", "*INCLUDE_PATH_RELATIVE\nlib\n*INCLUDE\nmesh.k\n"},
                       {"case/lib/mesh.k", node}}};
  Diagnostics diagnostics;
  const Deck deck = decks.read("case/main.k", diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  ASSERT_EQ(deck.files.size(), 3u);
  EXPECT_EQ(deck.files[2].name, "case/lib/mesh.k");
}

TEST(Include, TakesAbsoluteNames) {
  expect_found({{{"sub/main.k", including("*INCLUDE\n/data/mesh.k\n")}, {"/data/mesh.k", node}}},
               "sub/main.k", "/data/mesh.k");
}

TEST(Include, TakesNamesOverSeveralLines) {
  expect_found({{{"main.k", including("*INCLUDE\na folder/with +\n$ a comment\n_a +\n_long name.k\n")},
                 {"a folder/with_a_long name.k", node}}},
               "main.k", "a folder/with_a_long name.k");
}

TEST(Include, TakesNamesBeyondColumn80) {
  const std::string name = std::string(120, 'x') + ".k";
  expect_found({{{"main.k", including("*INCLUDE\n" + name + "\n")}, {name, node}}}, "main.k", name);
}

TEST(Include, TakesQuotes) {
  expect_found({{{"main.k", including("*INCLUDE\n  \"my mesh.k\"  \n")}, {"my mesh.k", node}}}, "main.k",
               "my mesh.k");
  expect_found({{{"main.k", including("*INCLUDE\n'my mesh.k'\n")}, {"my mesh.k", node}}}, "main.k",
               "my mesh.k");
}

TEST(Include, TakesTheBackslashesOfWindows) {
  expect_found({{{"main.k", including("*INCLUDE\n..\\parts\\mesh.k\n")}, {"../parts/mesh.k", node}}},
               "main.k", "../parts/mesh.k");
  expect_found(
      {{{"main.k", including("*INCLUDE_PATH\nmy\\lib\n*INCLUDE\nmesh.k\n")}, {"my/lib/mesh.k", node}}},
      "main.k", "my/lib/mesh.k");
  // a file that is really called so comes first
  expect_found({{{"main.k", including("*INCLUDE\nparts\\mesh.k\n")},
                 {"parts\\mesh.k", node},
                 {"parts/mesh.k", "*NODE\n1, 7.0\n"}}},
               "main.k", "parts\\mesh.k");
}

TEST(Include, TakesSeveralNamesBelowOneKeyword) {
  DecksInMemory decks{
      {{"main.k", including("*include\na.k\n$\n\nb.k\n")}, {"a.k", node}, {"b.k", "*NODE\n2, 1.0\n"}}};
  Diagnostics diagnostics;
  const Deck deck = decks.read("main.k", diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  EXPECT_EQ(deck.files.size(), 3u);
  EXPECT_EQ(deck.files[2].line, 6);
}

TEST(Include, TellsWhereAMissingFileWasLookedFor) {
  EXPECT_EQ(messages_of({{{"sub/main.k", including("*INCLUDE_PATH\nlib\n/usr/lib\n*INCLUDE\nx\\mesh.k\n")}}},
                        "sub/main.k"),
            "sub/main.k:6:1: error: *INCLUDE: cannot read 'x\\mesh.k'\n"
            "  hint: looked for sub/x\\mesh.k, x\\mesh.k, lib/x\\mesh.k, sub/lib/x\\mesh.k, "
            "/usr/lib/x\\mesh.k, sub/x/mesh.k, "
            "x/mesh.k, lib/x/mesh.k, sub/lib/x/mesh.k, /usr/lib/x/mesh.k\n");
}

TEST(Include, RefusesAFolder) {
  const WorkingDirectory there(std::filesystem::temp_directory_path().string());
  const std::string name = "courant_include_folder_" + std::to_string(::getpid()) + ".k";
  std::ofstream(name) << including("*INCLUDE\n.\n");
  const Checked checked = read_and_check(name);
  std::filesystem::remove(name);
  EXPECT_NE(checked.diagnostics.text().find("*INCLUDE: cannot read '.'"), std::string::npos);
}

TEST(Include, NamesTheChainOfFiles) {
  EXPECT_EQ(messages_of({{{"main.k", including("*INCLUDE\na.k\n")},
                          {"a.k", "*KEYWORD\n*INCLUDE\nb.k\n"},
                          {"b.k", "$\n*INCLUDE_TRANSFORM\nc.k\n"},
                          {"c.k", "*NODE\n1, x\n"}}},
                        "main.k"),
            "c.k:2:4: error: *NODE field 2 (X, x coordinate [L]): expected a number, got 'x'\n"
            "  included from b.k:3, from a.k:3, from main.k:3\n");
}

TEST(Include, IsRefusedBeyondAHundredFilesDeep) {
  DecksInMemory decks;
  for (int k = 0; k < 150; ++k)
    decks.files[std::to_string(k) + ".k"] = "*INCLUDE\n" + std::to_string(k + 1) + ".k\n";
  const std::string text = messages_of(decks, "0.k");
  EXPECT_EQ(text.rfind("99.k:2:1: error: *INCLUDE: files include each other more than 100 deep\n  included "
                       "from 98.k:2, from",
                       0),
            0u)
      << text;
  decks.files["99.k"] = "*END\n";
  EXPECT_EQ(messages_of(decks, "0.k"), "0.k:2: warning: *END is missing: is the deck complete?\n");
}

TEST(Include, IsRefusedWhereTheNumberOfFilesExplodes) {
  DecksInMemory decks;
  for (int k = 0; k < 20; ++k) {  // 2^20 files
    const std::string next = std::to_string(k + 1) + ".k\n";
    decks.files[std::to_string(k) + ".k"] = "*INCLUDE\n" + next + next;
  }
  decks.files["20.k"] = "$\n";
  Diagnostics diagnostics;
  const Deck deck = decks.read("0.k", diagnostics);
  EXPECT_EQ(deck.files.size(), 10000u);
  EXPECT_EQ(diagnostics.errors(), 1);
  EXPECT_NE(diagnostics.text().find("the deck has more than 10000 files"), std::string::npos);
}

TEST(Include, FindsCyclesThroughLinks) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("courant_include_links_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  {
    const WorkingDirectory there(folder.string());
    std::ofstream("main.k") << including("*INCLUDE\na.k\n");
    std::ofstream("a.k") << "*INCLUDE\nb.k\n";
    fs::create_symlink("a.k", "b.k");
    EXPECT_EQ(read_and_check("main.k").diagnostics.text(),
              "a.k:2:1: error: *INCLUDE: 'b.k' includes itself\n  included from main.k:3\n");
    fs::remove("b.k");
    fs::create_symlink("main.k", "b.k");
    EXPECT_EQ(read_and_check("main.k").diagnostics.text(),
              "a.k:2:1: error: *INCLUDE: 'b.k' includes itself\n  included from main.k:3\n");
  }
  fs::remove_all(folder);
}

TEST(Include, MayReadOneFileTwiceWithOtherIds) {
  DecksInMemory decks{
      {{"main.k", including("*INCLUDE\nmesh.k\n*INCLUDE_TRANSFORM\nmesh.k\n100\n")}, {"mesh.k", node}}};
  Diagnostics diagnostics;
  const Deck deck = decks.read("main.k", diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  ASSERT_EQ(deck.all<NodeCard>().size(), 2u);
  EXPECT_EQ(deck.all<NodeCard>()[0].nid, 1);
  EXPECT_EQ(deck.all<NodeCard>()[1].nid, 101);
  EXPECT_EQ(deck.keywords.at("NODE").entries, 2u);
  EXPECT_EQ(deck.keywords.at("INCLUDE_TRANSFORM").blocks, 1);
}

TEST(Include, OtherKindsAreRefusedByName) {
  for (const char* kind :
       {"INCLUDE_NASTRAN", "INCLUDE_BINARY", "INCLUDE_TRANSFORM_BINARY", "INCLUDE_STAMPED_PART"}) {
    const std::string text =
        messages_of({{{"main.k", including("*" + std::string(kind) + "\nmesh.k\n")}}}, "main.k");
    EXPECT_EQ(text.rfind("main.k:2:1: error: *" + std::string(kind), 0), 0u) << text;
  }
}

}  // namespace courant
