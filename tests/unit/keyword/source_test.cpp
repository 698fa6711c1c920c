// From the bytes of a file to lines: line ends, encodings, files that are none.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "keyword/deck.hpp"
#include "keyword/source.hpp"

namespace courant {

namespace {

using SourceLines = std::vector<std::string_view>;

class SourceFile : public testing::Test {
 protected:
  const std::string path_ =
      (std::filesystem::temp_directory_path() / ("courant_source_test_" + std::to_string(::getpid())))
          .string();
  ~SourceFile() override { std::filesystem::remove(path_); }
  std::string said_of(const std::string& path) const {
    Diagnostics diagnostics;
    read_deck(path, {}, diagnostics);
    return diagnostics.text();
  }
};

TEST(Source, EndsLinesWithAnyOfTheThreeKinds) {
  const SourceLines expected = {"*A", "1", "", "2"};
  for (const char* text : {"*A\n1\n\n2\n", "*A\r\n1\r\n\r\n2\r\n", "*A\r1\r\r2\r", "*A\r\n1\n\n2"})
    EXPECT_EQ(make_source(text)->lines, expected) << text;
}

TEST(Source, TakesSeveralReturnsBeforeALineFeedForOneLineEnd) {
  EXPECT_EQ(make_source("*A\r\r\n1\r\r\n")->lines, (SourceLines{"*A", "1"}));
}

TEST(Source, DropsTheEndOfFileCharacterOfMsDos) {
  EXPECT_EQ(make_source("*A\r\n*END\r\n\x1A")->lines, (SourceLines{"*A", "*END"}));
}

TEST(Source, ExpandsTabsFromTheBeginOfEachLine) {
  EXPECT_EQ(make_source("*A\r\tx\r12\ty")->lines, (SourceLines{"*A", "        x", "12      y"}));
}

TEST(Source, CountsColumnsInBytes) {
  const auto source = make_source("\xC3\xA4\tx");  // a letter of two bytes
  EXPECT_EQ(source->lines[0].find('x'), 8u);
}

TEST(Source, KnowsWhereKeywordsStand) {
  const auto source = make_source("$\n*A\n *B\n*\n\n*C");
  EXPECT_EQ(source->keyword_lines, (std::vector<std::size_t>{1, 3, 5}));
  EXPECT_EQ(source->next_keyword(0), 1u);
  EXPECT_EQ(source->next_keyword(1), 1u);
  EXPECT_EQ(source->next_keyword(2), 3u);
  EXPECT_EQ(source->next_keyword(6), source->lines.size());
}

TEST(Source, KnowsWhetherItsLastLineEnds) {
  EXPECT_FALSE(make_source("*A\n")->ends_within_line);
  EXPECT_FALSE(make_source("*A\r")->ends_within_line);
  EXPECT_FALSE(make_source("")->ends_within_line);
  EXPECT_TRUE(make_source("*A\n1")->ends_within_line);
}

TEST(Source, RefusesWhatIsNoText) {
  const auto fault = [](std::string text) {
    const auto source = make_source(std::move(text));
    EXPECT_TRUE(source->lines.empty());
    return source->faults.empty() ? SourceFault{} : source->faults[0];
  };
  EXPECT_EQ(fault(std::string("*A\n1\0\n", 6)).message, "the file holds a NUL byte");
  EXPECT_EQ(fault(std::string("*A\n1\0\n", 6)).line, 2);
  EXPECT_EQ(fault(std::string("*A\n1\0\n", 6)).column, 2);
  EXPECT_EQ(fault(std::string("*A\n123\0\0\n", 9)).message, "the file holds 2 NUL bytes, the first here");
  EXPECT_EQ(fault(std::string("*\0A\0\n\0", 6)).message, "the file is UTF-16 text");
  EXPECT_EQ(fault(std::string("\0*\0A\0\n", 6)).message, "the file is UTF-16 text");
  EXPECT_EQ(fault("\xFF\xFE").message, "the file is UTF-16 text");
}

TEST_F(SourceFile, IsRefusedIfItMayNeverEnd) {
  EXPECT_EQ(load_source(std::filesystem::temp_directory_path().string()), nullptr);
  EXPECT_EQ(load_source("/dev/zero"), nullptr);
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  EXPECT_EQ(load_source(path_), nullptr);
  EXPECT_NE(said_of("/dev/zero").find("/dev/zero: error: cannot read the deck"), std::string::npos);
}

TEST_F(SourceFile, OfManyGigabytesThatIsNoTextIsKnownByItsBeginning) {
  std::ofstream(path_) << "*KEYWORD\n";
  std::filesystem::resize_file(path_, std::uintmax_t(1) << 40);  // a hole: takes no space
  EXPECT_NE(said_of(path_).find(":2:1: error: the file holds"), std::string::npos);
}

TEST_F(SourceFile, IsReadBeyondItsBeginning) {
  std::string text = "*KEYWORD\n$" + std::string(200000, 'x') + "\n*END\n";
  std::ofstream(path_) << text;
  const auto source = load_source(path_);
  ASSERT_NE(source, nullptr);
  EXPECT_EQ(source->text, text);
  EXPECT_EQ(source->lines.size(), 3u);
}

}  // namespace

}  // namespace courant
