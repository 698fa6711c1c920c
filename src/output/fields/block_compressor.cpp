#include "output/fields/block_compressor.hpp"

#include <lzma.h>
#include <zlib.h>

#include <array>
#include <cstdint>
#include <new>
#include <stdexcept>

namespace courant {
namespace {

constexpr int fast = 1;  // higher levels cost several times the time for little

/// zlib's compressor, set up once: that takes longer than a block.
class Deflater : public BlockCompressor {
 public:
  explicit Deflater(int level) {
    if (deflateInit(&stream_, level) != Z_OK) throw std::bad_alloc();
  }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;
  ~Deflater() override { deflateEnd(&stream_); }

  void compress(std::string_view block, int, std::string& out) override {
    room_.resize(deflateBound(&stream_, block.size()));
    // zlib only reads it
    stream_.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(block.data()));
    stream_.avail_in = static_cast<uInt>(block.size());
    stream_.next_out = reinterpret_cast<Bytef*>(room_.data());
    stream_.avail_out = static_cast<uInt>(room_.size());
    if (deflate(&stream_, Z_FINISH) != Z_STREAM_END) throw std::logic_error("zlib did not finish a block");
    out.assign(room_.data(), stream_.total_out);
    deflateReset(&stream_);
  }

 private:
  z_stream stream_{};
  std::string room_;
};

/// The .xz format. Literals are modelled by their location in a number of four bytes, which fits floats.
class Xz : public BlockCompressor {
 public:
  explicit Xz(int level) {
    if (lzma_lzma_preset(&options_, static_cast<std::uint32_t>(level))) throw std::logic_error("level of xz");
    options_.lc = 0, options_.lp = 2, options_.pb = 2;
    options_.dict_size = 1 << 18;  // a block; the presets' tables take longer to clear than a block to pack
    delta_.type = LZMA_DELTA_TYPE_BYTE;
  }

  void compress(std::string_view block, int stride, std::string& out) override {
    delta_.dist = static_cast<std::uint32_t>(stride);
    const lzma_filter with_delta[] = {
        {LZMA_FILTER_DELTA, &delta_}, {LZMA_FILTER_LZMA2, &options_}, {LZMA_VLI_UNKNOWN, nullptr}};
    const bool use_delta = stride > 0 && stride <= LZMA_DELTA_DIST_MAX;
    out.resize(lzma_stream_buffer_bound(block.size()));
    std::size_t size = 0;
    const lzma_ret result = lzma_stream_buffer_encode(
        const_cast<lzma_filter*>(with_delta + (use_delta ? 0 : 1)), LZMA_CHECK_CRC32, nullptr,
        reinterpret_cast<const std::uint8_t*>(block.data()), block.size(),
        reinterpret_cast<std::uint8_t*>(out.data()), &size, out.size());
    if (result == LZMA_MEM_ERROR) throw std::bad_alloc();
    if (result != LZMA_OK) throw std::logic_error("xz did not finish a block");
    out.resize(size);
  }

 private:
  lzma_options_lzma options_{};
  lzma_options_delta delta_{};
};

}  // namespace

std::unique_ptr<BlockCompressor> BlockCompressor::make(const Compression& compression) {
  const int level = compression.level < 0 ? fast : compression.level;
  switch (compression.method) {
    case Compression::Method::none:
      return nullptr;
    case Compression::Method::zlib:
      return std::make_unique<Deflater>(level);
    case Compression::Method::xz:
      return std::make_unique<Xz>(level);
  }
  return nullptr;
}

}  // namespace courant
