#include "verify/processes.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>

namespace courant {
namespace {

using Clock_ = std::chrono::steady_clock;

double seconds_since(Clock_::time_point start) {
  return std::chrono::duration<double>(Clock_::now() - start).count();
}

struct Child {
  std::size_t job = 0;
  pid_t pid = 0;
  Clock_::time_point start = Clock_::now();
  bool asked_to_end = false;
};

/// Replaces the forked child by the program; only calls that are safe after fork().
[[noreturn]] void become(char* const* words, const char* log, pid_t parent) {
  setpgid(0, 0);                        // an interrupt from the terminal is ours to hand on
  prctl(PR_SET_PDEATHSIG, SIGKILL);     // nobody would collect what it computes
  if (getppid() != parent) _exit(127);  // the parent was gone before that
  const int in = open("/dev/null", O_RDONLY), out = open(log, O_WRONLY | O_CREAT | O_TRUNC | O_APPEND, 0644);
  if (in < 0 || out < 0 || dup2(in, STDIN_FILENO) < 0 || dup2(out, STDOUT_FILENO) < 0 ||
      dup2(out, STDERR_FILENO) < 0)
    _exit(127);
  execv(words[0], words);
  constexpr char text[] = "error: the program cannot be started\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text, sizeof text - 1);
  _exit(127);
}

pid_t start(const ProcessJob& job) {
  std::vector<std::string> words = job.words;
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const std::string log = (job.folder / "errors.txt").string();
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid == 0) become(pointers.data(), log.c_str(), parent);
  return pid;
}

RunRecord record_of(int status, const rusage& usage, const Child& child, const ProcessJob& job) {
  RunRecord out;
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  out.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  out.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  out.timed_out = child.asked_to_end;
  out.time_limit = job.time_limit;
  out.wall_seconds = seconds_since(child.start);
  out.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  out.peak_memory_bytes = std::int64_t(usage.ru_maxrss) * 1024;
  return out;
}

class Processes {
 public:
  Processes(const std::vector<ProcessJob>& jobs, const ProcessCalls& calls) : jobs_(jobs), calls_(calls) {}
  Processes(const Processes&) = delete;
  Processes& operator=(const Processes&) = delete;
  ~Processes() {  // a callback has thrown, or the user has had enough
    for (const Child& child : running_) {
      kill(child.pid, SIGKILL);
      waitpid(child.pid, nullptr, 0);
    }
  }

  bool run(int at_once, const std::atomic<bool>* stop) {
    std::size_t next = 0;
    auto told = Clock_::now();
    while (next < jobs_.size() || !running_.empty()) {
      if (stop && stop->load()) return false;
      while (next < jobs_.size() && running_.size() < static_cast<std::size_t>(std::max(1, at_once)))
        begin(next++);
      collect(stop);
      if (seconds_since(told) > 0.1) {
        told = Clock_::now();
        if (calls_.waiting) calls_.waiting();
      }
      const timespec pause{0, 5000000};
      nanosleep(&pause, nullptr);
    }
    return true;
  }

 private:
  void begin(std::size_t job) {
    const pid_t pid = start(jobs_[job]);
    if (calls_.started) calls_.started(job);
    if (pid > 0) {
      running_.push_back({job, pid});
      return;
    }
    RunRecord failed;  // no process could be made
    failed.exit_code = 127;
    calls_.ended(job, failed);
  }

  void collect(const std::atomic<bool>* stop) {
    for (std::size_t k = 0; k < running_.size();) {
      Child& child = running_[k];
      const ProcessJob& job = jobs_[child.job];
      int status = 0;
      rusage usage{};
      if (wait4(child.pid, &status, WNOHANG, &usage) == 0) {
        limit(child, job.time_limit);
        ++k;
        continue;
      }
      const Child ended = child;
      running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(k));
      if (!(stop && stop->load())) calls_.ended(ended.job, record_of(status, usage, ended, job));
    }
  }

  static void limit(Child& child, Real time_limit) {
    constexpr Real patience = 5;  // s, to write the last state
    const double elapsed = seconds_since(child.start);
    if (elapsed > time_limit + patience) kill(child.pid, SIGKILL);
    if (elapsed > time_limit && !child.asked_to_end) {
      kill(child.pid, SIGTERM);
      child.asked_to_end = true;
    }
  }

  const std::vector<ProcessJob>& jobs_;
  const ProcessCalls& calls_;
  std::vector<Child> running_;
};

}  // namespace

bool run_processes(const std::vector<ProcessJob>& jobs, int at_once, const std::atomic<bool>* stop,
                   const ProcessCalls& calls) {
  return Processes(jobs, calls).run(at_once, stop);
}

}  // namespace courant
