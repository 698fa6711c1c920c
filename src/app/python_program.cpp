#include "app/python_program.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>

namespace courant {
namespace {

namespace fs = std::filesystem;

/// The folder that holds the package; empty if there is none.
fs::path package_folder(const fs::path& executable) {
  const fs::path beside = executable.parent_path();
  // of a build, installed, within the package of a wheel
  for (const fs::path& folder :
       {beside / "python", beside / ".." / "share" / "courant" / "python", beside / ".." / ".."}) {
    std::error_code unreadable;
    if (fs::exists(folder / "courant" / "__main__.py", unreadable))
      return fs::weakly_canonical(folder, unreadable);
  }
  return {};
}

}  // namespace

std::string become_python_program(const std::vector<std::string>& words) {
  std::error_code unreadable;
  const fs::path executable = fs::read_symlink("/proc/self/exe", unreadable);
  const fs::path folder = package_folder(executable);
  if (folder.empty())
    return fmt::format(
        "the Python package of courant is not beside {}: neither python nor ../share/courant/python "
        "holds it\n  hint: run the program where it was built or installed",
        executable.string());
  std::string path = folder.string();
  if (const char* more = std::getenv("PYTHONPATH"); more && *more) path += std::string(":") + more;
  ::setenv("PYTHONPATH", path.c_str(), 1);
  ::setenv("COURANT_EXECUTABLE", executable.c_str(), 0);  // for runs of suites
  const char* chosen = std::getenv("COURANT_PYTHON");
  const std::string interpreter = chosen && *chosen ? chosen : "python3";
  std::vector<std::string> all{interpreter, "-m", "courant"};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  for (std::string& word : all) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execvp(interpreter.c_str(), arguments.data());
  return fmt::format(
      "'{}' cannot be started: {}\n  hint: install python3, or name an interpreter in COURANT_PYTHON",
      interpreter, std::strerror(errno));
}

}  // namespace courant
