#pragma once
#include <cstdint>
#include <string>

namespace courant {

/// How many other threads of the machine want a processor just now, as the system counts them; 0 where it
/// does not tell.
int running_elsewhere();

/// Finds by trial with how many threads steps are quickest: small scenes wait more than they compute, and on
/// a machine busy with other work each wait for another thread may last a time slice. Results do not depend
/// on it.
///
/// Mean times of some steps are compared: those of the present number against those of half or twice as many,
/// which are taken on if quicker by more than noise. A trial that goes badly is broken off, and trials take a
/// small share of the time: a fiftieth at first, less where none changed anything. Steps that become much
/// slower, as when others take the machine, bring the next one at once; the first one waits for a thousand
/// steps where processors are used as they should be.
class ThreadChoice {
 public:
  /// `most`: threads there are; `work`: particles and elements; `busy`: threads of others that run.
  ThreadChoice(int most, std::int64_t work, int busy);
  int threads() const { return trying_ ? other_ : best_; }  ///< for the next step
  /// After each step, with the time and the processors' time since any start [s]. A line for the user where
  /// the choice has changed.
  std::string step(double now, double cpu);

 private:
  void begin(bool trying);
  std::string end_trial(double mean);
  void choose_other();

  int most_, best_ = 1, other_ = 1, told_ = 0;
  bool trying_ = false, upwards_ = false;
  double best_mean_ = 0;  ///< of a step with best_ threads [s]; 0: not measured yet
  int steps_ = 0;         ///< since the last change
  double last_ = 0, sum_ = 0, cpu_start_ = 0;
  double pause_factor_ = 50;                  ///< time between trials, in lengths of one
  double trial_start_ = 0, next_trial_ = -1;  ///< [s]; next_trial_ < 0: none has been planned yet
};

}  // namespace courant
