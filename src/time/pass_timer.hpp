#pragma once
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace courant {

/// Wall-clock seconds per pass, for the timing table of a run.
class PassTimer {
 public:
  struct Row {
    std::string name;
    double seconds = 0;
    std::int64_t calls = 0;
  };
  static double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }
  /// Index of the row of that name; a new row is after the others.
  std::size_t row(const std::string& name);
  void add(std::size_t row, double seconds) {
    table_[row].seconds += seconds;
    ++table_[row].calls;
  }
  /// Adds the time of a pass before a restart.
  void add(const Row& before) {
    Row& to = table_[row(before.name)];
    to.seconds += before.seconds;
    to.calls += before.calls;
  }
  template <class F>
  void measure(const std::string& name, F&& f) {
    const double start = now();
    f();
    add(row(name), now() - start);
  }
  const std::vector<Row>& table() const { return table_; }

 private:
  std::vector<Row> table_;
};

}  // namespace courant
