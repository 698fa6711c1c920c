#include "app/load_extension.hpp"

#include <dlfcn.h>

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "contact/interface_law.hpp"
#include "extension/additions.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

std::size_t registered() {
  return keyword_registry().size() + additions().size() + ascii_histories().size() +
         interface_law_registry().size();
}

/// A name that is there already and again among the keywords from `first` on; "" if none is.
std::string keyword_twice(std::size_t first) {
  std::set<std::string> names;
  for (std::size_t k = 0; k < keyword_registry().size(); ++k)
    for (const std::string& name : keyword_registry()[k]->names)
      if (!names.insert(name).second && k >= first) return name;
  return "";
}

std::string loading;  ///< for end_program

/// What a static object of a file throws cannot get past dlopen, which is C: it ends here.
[[noreturn]] void end_program() {
  std::string why = "unknown reason";
  try {
    if (std::current_exception()) std::rethrow_exception(std::current_exception());
  } catch (const std::exception& fault) {
    why = fault.what();
  } catch (...) {
  }
  fmt::print(stderr, "error: --load: {} failed while it was loaded: {}\n", loading, why);
  std::_Exit(1);
}

}  // namespace

// Never closed: what it registered points into it.
std::string load_extension(const std::string& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return fmt::format("the file {} does not exist", file);
  const std::filesystem::path path =
      std::filesystem::absolute(file, error);  // dlopen looks for plain names elsewhere
  if (dlopen(path.c_str(), RTLD_NOW | RTLD_NOLOAD)) return "";
  const std::size_t before = registered(), keywords = keyword_registry().size();
  loading = file;
  const std::terminate_handler usual = std::set_terminate(end_program);
  void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  std::set_terminate(usual);
  if (!handle) {
    const char* why = dlerror();
    return fmt::format("{} cannot be loaded: {}", file, why ? why : "unknown reason");
  }
  if (registered() == before) return fmt::format("{} registers nothing: no keyword, law or addition", file);
  if (const std::string twice = keyword_twice(keywords); !twice.empty())
    return fmt::format("{} registers *{}, which is there already", file, twice);
  return "";
}

}  // namespace courant
