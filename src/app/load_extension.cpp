#include "app/load_extension.hpp"

#include <dlfcn.h>

#include <filesystem>

#include <fmt/format.h>

namespace courant {

// Never closed: what it registered points into it.
std::string load_extension(const std::string& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return fmt::format("the file {} does not exist", file);
  const std::filesystem::path path =
      std::filesystem::absolute(file, error);  // dlopen looks for plain names elsewhere
  try {
    if (dlopen(path.c_str(), RTLD_NOW | RTLD_GLOBAL)) return "";
  } catch (const std::exception& fault) {  // of a static object
    return fmt::format("{}: {}", file, fault.what());
  }
  const char* why = dlerror();
  return fmt::format("{} cannot be loaded: {}", file, why ? why : "unknown reason");
}

}  // namespace courant
