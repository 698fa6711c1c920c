#include "app/load_extension.hpp"

#include <dlfcn.h>

#include <cstddef>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "contact/interface_law.hpp"
#include "elements/solid/formulation.hpp"
#include "extension/additions.hpp"
#include "extension/compiled_against.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

std::size_t registered() {
  return keyword_registry().size() + world_builders().size() + ascii_histories().size() +
         interface_law_registry().size() + solid_formulations().size();
}

/// A name that is there already and again among the keywords from `first` on; "" if none is.
std::string keyword_twice(std::size_t first) {
  std::set<std::string> names;
  for (std::size_t k = 0; k < keyword_registry().size(); ++k)
    for (const std::string& name : keyword_registry()[k]->names)
      if (!names.insert(name).second && k >= first) return name;
  return "";
}

/// Why a file must not run: objects of other headers have another layout, and it would crash. Empty for what
/// is no shared object: the linker says why.
std::string compiled_against_others(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (bytes.compare(0, 4, "\177ELF") != 0) return "";
  const std::string_view mine(compiled_against, sizeof compiled_against);  // with the 0 at its end
  if (bytes.find(mine) != std::string::npos) return "";
  const std::string_view begin = mine.substr(0, mine.rfind(' ') + 1);
  return bytes.find(begin) == std::string::npos
             ? "does not say which headers it was compiled against: it lacks #include "
               "\"extension/compiled_against.hpp\""
             : "was compiled against the headers of another Courant: compile it again against those of this "
               "one";
}

}  // namespace

// Never closed: what it registered points into it.
std::string load_extension(const std::string& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return fmt::format("the file {} does not exist", file);
  if (!std::filesystem::is_regular_file(file, error))  // a pipe would be waited for
    return fmt::format("{} is no file", file);
  const std::filesystem::path path =
      std::filesystem::absolute(file, error);     // dlopen looks for plain names elsewhere
  static std::set<std::filesystem::path> loaded;  // more than one call in a process may name it
  const std::filesystem::path same = std::filesystem::weakly_canonical(path, error);
  if (loaded.contains(same)) return "";
  if (const std::string why = compiled_against_others(path); !why.empty())
    return fmt::format("{} {}", file, why);
  const std::size_t before = registered(), keywords = keyword_registry().size();
  // C's declaration promises that nothing is thrown; static objects of the file may do so all the same.
  void* (*volatile const open)(const char*, int) = dlopen;
  void* handle = nullptr;
  try {
    handle = open(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  } catch (const std::exception& fault) {
    return fmt::format("{} failed while it was loaded: {}", file, fault.what());
  } catch (...) {
    return fmt::format("{} failed while it was loaded", file);
  }
  if (!handle) {
    const char* why = dlerror();
    return fmt::format("{} cannot be loaded: {}", file, why ? why : "unknown reason");
  }
  if (registered() == before) return fmt::format("{} registers nothing: no keyword, law or addition", file);
  if (const std::string twice = keyword_twice(keywords); !twice.empty())
    return fmt::format("{} registers *{}, which is there already", file, twice);
  loaded.insert(same);
  return "";
}

}  // namespace courant
