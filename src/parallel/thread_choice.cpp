#include "parallel/thread_choice.hpp"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <limits>
#include <string>
#include <thread>

namespace courant {

namespace {

constexpr int settling = 8;       // steps after a change: work is shared again when neighbours are looked for
constexpr int measured = 32;      // steps of a mean, so that some searches of neighbours are among them
constexpr double quicker = 0.93;  // what a trial must come to
constexpr double hopeless = 1.2;  // of the time that the best would have taken: a trial ends
constexpr double disturbed = 1.5;     // of its own mean: something has changed
constexpr double rarest = 400;        // pause, in lengths of a trial
constexpr double used = 0.7;          // of the threads' time: less is spent by waiting
constexpr int first_pause = 30;       // means, about a thousand steps
constexpr std::int64_t least = 1000;  // particles and elements for a second thread

}  // namespace

int running_elsewhere() {
  int fewest = std::numeric_limits<int>::max();  // what runs for a moment only does not matter
  for (int look = 0; look < 4; ++look) {
    if (look > 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    std::ifstream file("/proc/loadavg");
    double load = 0;
    int running = 1;
    for (int k = 0; k < 3; ++k) file >> load;
    file >> running;  // "2/345": this thread is one of them
    if (!file) return 0;
    fewest = std::min(fewest, std::max(running - 1, 0));
  }
  return fewest;
}

ThreadChoice::ThreadChoice(int most, std::int64_t work, int busy) : most_(most) {
  if (work >= least) best_ = std::max(1, most - busy);
  told_ = best_;
}

void ThreadChoice::begin(bool trying) {
  trying_ = trying;
  steps_ = 0, sum_ = 0;
}

void ThreadChoice::choose_other() {
  if (best_ == 1)
    upwards_ = true;
  else if (best_ == most_)
    upwards_ = false;
  other_ = upwards_ ? std::min(2 * best_, most_) : std::max(best_ / 2, 1);
}

std::string ThreadChoice::end_trial(double mean) {
  const bool better = mean < quicker * best_mean_;
  const double length = last_ - trial_start_;
  if (better)
    best_ = other_, best_mean_ = mean, pause_factor_ = 50;
  else
    upwards_ = !upwards_, pause_factor_ = std::min(2 * pause_factor_, rarest);
  // a better one may have a still better neighbour
  next_trial_ = better ? last_ : last_ + pause_factor_ * length;
  begin(false);
  if (best_ == told_) return {};
  told_ = best_;
  return "steps are quickest with " + std::to_string(best_) + (best_ == 1 ? " thread" : " threads") + " of " +
         std::to_string(most_) + ": these are taken from here on (--threads takes a fixed number)";
}

std::string ThreadChoice::step(double now, double cpu) {
  if (most_ == 1) return {};
  const double seconds = now - last_;
  last_ = now;
  if (++steps_ <= settling) {
    if (steps_ == 1 && trying_) trial_start_ = now - seconds;
    cpu_start_ = cpu;
    const bool ends = trying_ && now - trial_start_ > hopeless * best_mean_ * (settling + measured);
    return ends ? end_trial(hopeless * best_mean_) : std::string();
  }
  sum_ += seconds;
  const int count = steps_ - settling;
  if (trying_) {
    if (count < measured && sum_ <= hopeless * best_mean_ * measured) return {};
    return end_trial(count < measured ? hopeless * best_mean_ : sum_ / measured);
  }
  if (count < measured) return {};
  const double mean = sum_ / measured;
  const bool is_disturbed = best_mean_ > 0 && mean > disturbed * best_mean_;
  if (next_trial_ < 0)
    next_trial_ = best_ > 1 && cpu - cpu_start_ < used * best_ * sum_ ? now : now + first_pause * sum_;
  best_mean_ = mean;
  steps_ = settling, sum_ = 0, cpu_start_ = cpu;
  if (now < next_trial_ && !is_disturbed) return {};
  choose_other();
  begin(true);
  return {};
}

}  // namespace courant
