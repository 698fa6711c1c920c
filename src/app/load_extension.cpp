#include "app/load_extension.hpp"

#include <dlfcn.h>

#include <cstddef>
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

}  // namespace

// Never closed: what it registered points into it.
std::string load_extension(const std::string& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return fmt::format("the file {} does not exist", file);
  const std::filesystem::path path =
      std::filesystem::absolute(file, error);  // dlopen looks for plain names elsewhere
  if (dlopen(path.c_str(), RTLD_NOW | RTLD_NOLOAD)) return "";
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
  return "";
}

}  // namespace courant
