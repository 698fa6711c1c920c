// Built into the unit tests of a copy of the tree by mutation.py: which locations of changes each test
// reaches, one line a test in the file COURANT_MUTANTS_TESTS: name, milliseconds, file, numbers. What was
// reached before the first test is under "before".
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <string>

namespace {

class Reached : public testing::EmptyTestEventListener {
 public:
  explicit Reached(const char* path) : out_(path, std::ios::app) {}

  void OnTestStart(const testing::TestInfo&) override {
    if (!begun_) write("before", 0, "");
    begun_ = true;
    std::memset(courant_mutants::reached, 0, courant_mutants::most);
  }
  void OnTestEnd(const testing::TestInfo& test) override {
    if (test.result()->Failed()) return;
    write(std::string(test.test_suite_name()) + "." + test.name(), test.result()->elapsed_time(),
          test.file());
  }

 private:
  void write(const std::string& name, testing::TimeInMillis milliseconds, const char* file) {
    out_ << name << '\t' << milliseconds << '\t' << file << '\t';
    for (int k = 0; k < courant_mutants::most; ++k)
      if (courant_mutants::reached[k]) out_ << k << ' ';
    out_ << std::endl;
  }
  std::ofstream out_;
  bool begun_ = false;
};

const bool added = [] {
  const char* path = std::getenv("COURANT_MUTANTS_TESTS");
  if (path && courant_mutants::reached)
    testing::UnitTest::GetInstance()->listeners().Append(new Reached(path));
  return true;
}();

}  // namespace
