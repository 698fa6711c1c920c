#pragma once
// The programs around the library that are Python: the package `courant` in src/python.
#include <string>
#include <vector>

namespace courant {

/// Becomes `python3 -m courant WORDS`; returns only where that fails, with the message. The package is
/// searched beside the executable (`python`, `../share/courant/python`), the interpreter is COURANT_PYTHON or
/// `python3`.
std::string become_python_program(const std::vector<std::string>& words);

}  // namespace courant
