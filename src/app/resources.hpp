#pragma once
#include <cstdint>

namespace courant {

double cpu_seconds();        ///< of all threads of this process so far [s]
std::int64_t peak_memory();  ///< of this process so far [bytes]

}  // namespace courant
