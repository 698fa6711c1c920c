#pragma once
#include <string>

namespace courant {

/// Brings in a shared object, whose static objects register keywords, laws and additions. Returns why it
/// cannot be loaded: it was compiled against other headers, throws, registers nothing, or a keyword that is
/// there already; empty where all is well. After a failure part of it may be registered: the program should
/// end.
std::string load_extension(const std::string& file);

}  // namespace courant
