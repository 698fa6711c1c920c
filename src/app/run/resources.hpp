#pragma once
#include <cstdint>

namespace courant {

double cpu_seconds();        ///< of all threads of this process so far [s]
std::int64_t peak_memory();  ///< of this process so far [bytes]

/// Whether the process has a limit of addresses (ulimit -v) or data: memory may then be refused to it. Files
/// are written in turn with the computation then, so that neither takes what the other has looked for.
bool memory_is_limited();

}  // namespace courant
