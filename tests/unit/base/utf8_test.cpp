#include "base/utf8.hpp"

#include <gtest/gtest.h>

namespace courant {
namespace {

TEST(Utf8, NothingActsOnATerminal) {
  EXPECT_EQ(without_controls("\x1b[31mred\a\x7f\ttwo\nlines"), "?[31mred???two\nlines");
  EXPECT_EQ(without_controls("a\xc2\x9b"
                             "31m"),
            "a?31m")
      << "CSI as UTF-8";
  EXPECT_EQ(without_controls("a\x9b"
                             "31m"),
            "a?31m")
      << "CSI as a byte";
  EXPECT_EQ(without_controls("gr\xc3\xb6\xc3\x9f"
                             "e \xe2\x82\x9b \xf0\x9f\x92\x9b"),
            "gr\xc3\xb6\xc3\x9f"
            "e \xe2\x82\x9b \xf0\x9f\x92\x9b")
      << "bytes that go on with a character";
  EXPECT_EQ(without_controls("\xc3\x1b"
                             "\x9b"),
            "\xc3??")
      << "one that was begun and left";
}

TEST(Utf8, IsCutBetweenCharacters) {
  EXPECT_EQ(cut_utf8("abc", 3), "abc");
  EXPECT_EQ(cut_utf8("ab\xc3\xb6", 3), "ab");
  EXPECT_EQ(cut_utf8("ab\xc3\xb6"
                     "d",
                     4),
            "ab\xc3\xb6");
}

}  // namespace
}  // namespace courant
