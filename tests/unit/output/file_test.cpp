// What results are written over, and what not.
#include "output/file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

#include "../temporary_folder.hpp"
#include "output/output_schedule.hpp"
#include "output/result_names.hpp"

namespace courant {
namespace {

namespace fs = std::filesystem;

class WrittenFile : public test::TemporaryFolder {
 protected:
  void put(const fs::path& name) const { std::ofstream(folder_ / name) << "mine"; }
  std::string text(const fs::path& name) const {
    std::ifstream stream(folder_ / name);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  template <class Write>
  static std::string fault(Write write) {
    try {
      write();
    } catch (const OutputError& error) {
      return error.reason();
    }
    return "";
  }
};

TEST_F(WrittenFile, DevicesStayWhatTheyAre) {
  write_named_file("/dev/null", "text");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_EQ(fault([] { write_file("/dev/null", "text"); }), "it is no file") << "no name of a result";
  fs::create_symlink("/dev/null", folder_ / "link");
  write_named_file(folder_ / "link", "text");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
}

TEST_F(WrittenFile, PipesAreWrittenToAndNotWaitedFor) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(fault([&] { write_named_file(pipe, "text"); }), "it is a pipe without a reader");
  EXPECT_EQ(fault([&] { write_file(pipe, "text"); }), "it is no file");
  EXPECT_EQ(fault([&] { TextFile file(pipe); }), "it is a pipe without a reader");
  EXPECT_EQ(fault([&] { open_for_writing(pipe, Opening::as_it_is); }), "it is no file");
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  write_named_file(pipe, "text");
  char read[8] = {};
  EXPECT_EQ(::read(reader, read, sizeof read), 4);
  EXPECT_EQ(std::string(read), "text");
  EXPECT_EQ(fault([&] { TextFile file(pipe); }), "it is no file");
  ::close(reader);
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST_F(WrittenFile, LinksAreNeitherFollowedNorReplaced) {
  put("mine");
  fs::create_symlink("mine", folder_ / "link");
  for (const auto& write : std::vector<std::function<void()>>{
           [&] { write_file(folder_ / "link", "text"); }, [&] { write_named_file(folder_ / "link", "text"); },
           [&] { TextFile file(folder_ / "link"); }, [&] { TextFile file(folder_ / "link", true); },
           [&] { open_for_writing(folder_ / "link", Opening::as_it_is); }})
    EXPECT_NE(fault(write).find("it is a link"), std::string::npos);
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(text("mine"), "mine");
}

TEST_F(WrittenFile, WhatIsBesideANamedFileStays) {
  put("deck.k.tmp"), put("deck.k.part"), put("deck.k." + std::to_string(::getpid()) + ".tmp");
  write_named_file(folder_ / "deck.k", "text");
  EXPECT_EQ(text("deck.k"), "text");
  int count = 0;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    if (entry.path().filename() == "deck.k") continue;
    EXPECT_EQ(text(entry.path().filename()), "mine") << entry.path();
    ++count;
  }
  EXPECT_EQ(count, 3);
}

TEST_F(WrittenFile, ARunWritesNoFileThatIsNotListed) {
  for (const char* name : {"relax", "messag", "glstat", "fields/solids_0001.vtu", "restart/runrsf01.h5"})
    EXPECT_EQ(result_path("dir", name), fs::path("dir") / name);
  for (const char* name : {"new_file", "fields/other.vtu", "restart/runrsf", "other/messag"})
    EXPECT_THROW(result_path("dir", name), std::logic_error) << name;
}

TEST(OutputSchedule, EndsForIntervalsBelowRoundOff) {
  for (const Real interval : {1e-17, 1e-30, 1e-300, 5e-324}) {
    OutputSchedule schedule(interval);
    for (Real t = 0; t < 1; t += 0.125) {
      EXPECT_TRUE(schedule.take(t, 0.125) || interval < 1e-307) << interval;
      EXPECT_GE(schedule.next(), (t + 0.125) * (1 - 1e-9));
    }
    schedule.skip_to(0.5);
    EXPECT_GE(schedule.next(), 0.5 * (1 - 1e-9));
  }
}

}  // namespace
}  // namespace courant
