#pragma once
#include <memory>
#include <string>
#include <string_view>

namespace courant {

/// How the data of field files are packed. VTK 9.1 and ParaView 5.11 unpack all of them without a plugin.
struct Compression {
  enum class Method { none, zlib, xz };
  Method method = Method::zlib;
  int level = -1;       ///< 0 to 9; -1: 1
  bool always = false;  ///< also what zlib can hardly shrink: takes longer
};

/// Packs blocks of bytes, each by itself.
class BlockCompressor {
 public:
  virtual ~BlockCompressor() = default;
  /// `stride`: > 0 where each byte is near the one so many bytes before (counters). Throws std::bad_alloc.
  virtual void compress(std::string_view block, int stride, std::string& out) = 0;
  /// nullptr for `none`. Throws std::bad_alloc.
  static std::unique_ptr<BlockCompressor> make(const Compression& compression);
};

}  // namespace courant
