#pragma once
// A folder of its own for each test.
#include <gtest/gtest.h>

#include <filesystem>

namespace courant::test {

class TemporaryFolder : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) /
                                  testing::UnitTest::GetInstance()->current_test_info()->name();
};

}  // namespace courant::test
