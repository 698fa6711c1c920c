#pragma once
#include <string>

namespace courant {

/// Brings in a shared object, whose static objects register keywords, laws and additions. Returns why it
/// cannot be loaded; empty where it was.
std::string load_extension(const std::string& file);

}  // namespace courant
