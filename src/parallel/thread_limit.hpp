#pragma once
#include <string>

namespace courant {

/// Why so many threads (0: one per core) cannot be started, with a hint; empty where nothing is known to be
/// in the path. OpenMP itself would end the program.
std::string why_not_threads(int threads);

}  // namespace courant
