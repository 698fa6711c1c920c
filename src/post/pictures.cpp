#include "post/pictures.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

extern char** environ;

namespace courant {
namespace {

/// Runs a program without a shell, its output into `log`. Returns its exit status, -1 if it could not be
/// started.
int run(const std::vector<std::string>& words, const std::filesystem::path& log) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, 1, 2);
  pid_t child = 0;
  const int failed = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed) return -1;
  int status = 0;
  if (waitpid(child, &status, 0) != child || !WIFEXITED(status)) return -1;
  return WEXITSTATUS(status);
}

std::filesystem::path find_script(const char* name) {
  std::error_code ignored;
  for (const std::filesystem::path beside : {COURANT_PLOT_SCRIPT, COURANT_INSTALLED_PLOT_SCRIPT})
    if (const auto path = beside.parent_path() / name; std::filesystem::exists(path, ignored)) return path;
  return {};
}

}  // namespace

bool draw_pictures(const std::filesystem::path& dir, const char* name, Diagnostics& diagnostics) {
  const std::filesystem::path script = find_script(name), log = dir / "plot.log";
  const std::string none = "no pictures were drawn: ";
  std::error_code ignored;
  if (script.empty()) {
    diagnostics.warning({}, none + "the script " + name + " is missing",
                        "expected beside " + std::string(COURANT_INSTALLED_PLOT_SCRIPT));
    return false;
  }
  std::string python;
  for (const char* candidate :
       {"python3", "/usr/bin/python3"})  // the second: the distribution's, where another shadows it
    if (python.empty() && run({candidate, "-c", "import matplotlib"}, log) == 0) python = candidate;
  if (python.empty()) {
    std::filesystem::remove(log, ignored);
    diagnostics.warning({}, none + "python3 with matplotlib was not found",
                        "apt-get install python3-matplotlib");
    return false;
  }
  if (run({python, script.string(), dir.string()}, log) == 0) {
    std::filesystem::remove(log, ignored);
    return true;
  }
  std::ifstream in(log);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  diagnostics.warning({script.string()}, none + "the script failed:\n" + text,
                      "run it by hand: " + python + " " + script.string() + " " + dir.string());
  return false;
}

}  // namespace courant
