// What a run may find in its folder.
#include "app/run/result_folder.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "../temporary_folder.hpp"
#include "app/run/relaxation.hpp"
#include "output/file.hpp"

namespace courant {
namespace {

namespace fs = std::filesystem;

class ResultFolder : public test::TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    fs::create_directories(folder_ / "fields");
  }
  void put(const fs::path& name) const { std::ofstream(folder_ / name) << "something\n"; }
  std::string fault(const std::vector<fs::path>& inputs = {}) const {
    try {
      check_result_folder(folder_, inputs);
    } catch (const OutputError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(ResultFolder, KnowsItsFilesByTheirNames) {
  for (const char* ours :
       {"messag", "glstat", "summary.yaml", "summary.yaml.tmp", "history.h5", "fields.pvd", "relax",
        "fields/particles_0012.vtp", "fields/shells_12345.vtu", "fields/failed.vtp", "restart/runrsf.h5"})
    EXPECT_TRUE(is_result_name(ours)) << ours;
  for (const char* other :
       {"deck.k", "summary.yml", "particles_0012.vtp", "fields/particles_.vtp", "fields/particles_12a.vtp",
        "fields/shells_0001.vtp", "fields/notes.txt", "other/messag"})
    EXPECT_FALSE(is_result_name(other)) << other;
}

TEST_F(ResultFolder, LosesTheFilesOfAnEarlierRunAndNoOthers) {
  for (const char* name : {"messag", "history.h5", "fields.pvd", "summary.yaml", "fields/particles_0003.vtp",
                           "fields/solids_0003.vtu", "fields/failed_solids.vtu"})
    put(name);
  for (const char* name : {"deck.k", "notes.txt", "fields/notes.txt", "fields/particles_of_mine.vtp"})
    put(name);
  remove_results(folder_);
  std::vector<std::string> left;
  for (const auto& entry : fs::recursive_directory_iterator(folder_))
    if (entry.is_regular_file()) left.push_back(fs::relative(entry.path(), folder_).string());
  std::sort(left.begin(), left.end());
  EXPECT_EQ(left, (std::vector<std::string>{"deck.k", "fields/notes.txt", "fields/particles_of_mine.vtp",
                                            "notes.txt"}));
}

TEST_F(ResultFolder, LosesTheFileOfARelaxationAndNoOtherOfThatName) {
  put("relax");
  remove_results(folder_);
  EXPECT_TRUE(fs::exists(folder_ / "relax"));
  std::ofstream(folder_ / "relax") << relaxation_head << "0 0 0\n";
  remove_results(folder_);
  EXPECT_FALSE(fs::exists(folder_ / "relax"));
}

TEST_F(ResultFolder, IsRefusedWhereAResultWouldGoOverAnInputOrThroughALink) {
  put("glstat"), put("deck.k");
  EXPECT_EQ(fault({folder_ / "deck.k"}), "");
  EXPECT_NE(fault({folder_ / "deck.k", folder_ / "glstat"}).find("it is the input"), std::string::npos);
  fs::create_symlink("deck.k", folder_ / "messag");
  EXPECT_NE(fault().find("messag': it is a link"), std::string::npos) << fault();
  fs::remove(folder_ / "messag");
  fs::create_symlink("deck.k", folder_ / "other");  // no result has this name
  EXPECT_EQ(fault(), "");
  ASSERT_EQ(::mkfifo((folder_ / "fields/particles_0000.vtp.tmp").c_str(), 0600), 0);
  EXPECT_NE(fault().find("it is no file"), std::string::npos) << fault();
  fs::remove_all(folder_ / "fields");
  fs::create_directory_symlink(".", folder_ / "fields");
  EXPECT_NE(fault().find("fields': it is a link"), std::string::npos) << fault();
}

TEST_F(ResultFolder, NothingIsWrittenThroughALink) {
  put("precious");
  fs::create_symlink("precious", folder_ / "glstat");
  EXPECT_THROW(TextFile(folder_ / "glstat"), OutputError);
  fs::create_symlink("precious", folder_ / "a.tmp");
  write_file(folder_ / "a", "new");
  std::string line;
  std::ifstream stream(folder_ / "precious");
  std::getline(stream, line);
  EXPECT_EQ(line, "something");
  ASSERT_EQ(::mkfifo((folder_ / "messag").c_str(), 0600), 0);
  EXPECT_THROW(TextFile(folder_ / "messag"), OutputError);  // and does not wait for a reader
}

}  // namespace
}  // namespace courant
