#include "verify/schedule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace courant {

std::string duration_text(double seconds) {
  const long s = std::lround(seconds);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} h {:02} min", s / 3600, s / 60 % 60);
}

RunSchedule::RunSchedule(std::vector<Run> runs, int at_once) : at_once_(std::max(1, at_once)) {
  for (const Run& run : runs) runs_.push_back({{run}});
}

void RunSchedule::started(std::size_t run) {
  runs_[run].state = State::running;
  runs_[run].start = std::chrono::steady_clock::now();
}

void RunSchedule::ended(std::size_t run, double wall_seconds) {
  runs_[run].state = State::done;
  runs_[run].seconds = wall_seconds;
  ++done_;
}

double RunSchedule::seconds_left() const {
  struct Sum {
    double seconds = 0, cost = 0;
  };
  std::map<std::size_t, Sum> of_case;
  Sum all;
  for (const Entry& run : runs_) {
    if (run.state != State::done) continue;
    for (Sum* sum : {&of_case[run.of_case], &all}) sum->seconds += run.seconds, sum->cost += run.cost;
  }
  if (!(all.cost > 0)) return -1;
  double work = 0, longest = 0;
  for (const Entry& run : runs_) {
    if (run.state == State::done) continue;
    const auto known = of_case.find(run.of_case);
    const Sum& like = known == of_case.end() ? all : known->second;
    double left = run.cost * like.seconds / like.cost;
    if (run.state == State::running)
      left -= std::chrono::duration<double>(std::chrono::steady_clock::now() - run.start).count();
    left = std::max(0.0, left);
    work += left;
    longest = std::max(longest, left);
  }
  return std::max(longest, work / at_once_);
}

}  // namespace courant
