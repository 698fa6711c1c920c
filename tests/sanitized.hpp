#pragma once

// clang and g++ each have a name of their own for it.
#if defined(__SANITIZE_ADDRESS__)
#define COURANT_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define COURANT_SANITIZED 1
#endif
#endif
#ifndef COURANT_SANITIZED
#define COURANT_SANITIZED 0
#endif

namespace courant::test {

/// Whether this program is built with AddressSanitizer: slower, and with address space reserved without
/// bound.
inline constexpr bool address_sanitizer = COURANT_SANITIZED;

}  // namespace courant::test
