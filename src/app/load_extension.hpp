#pragma once
#include <string>

namespace courant {

/// Brings in a shared object, whose static objects register keywords, laws and additions. Returns why it
/// cannot be loaded, registers nothing, or a keyword that is there already; empty where all is well. One that
/// throws while it is loaded ends the program with exit code 1 and a message.
std::string load_extension(const std::string& file);

}  // namespace courant
