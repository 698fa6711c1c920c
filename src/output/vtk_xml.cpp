#include "output/vtk_xml.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <new>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace courant {
namespace {

constexpr std::size_t block_bytes = 4096;
constexpr int states_between_attempts = 128;

void add_uint32(std::string& out, std::size_t value) {
  const auto number = static_cast<std::uint32_t>(value);
  out.append(reinterpret_cast<const char*>(&number), sizeof number);
}

const Bytef* bytes_of(std::string_view text) {
  return reinterpret_cast<const Bytef*>(text.data());
}

/// The block as a zlib stream that holds it as it is (RFC 1950, RFC 1951: one stored block).
void store(std::string_view block, std::string& out) {
  static_assert(block_bytes <= 65535, "the length of a stored block has 16 bits");
  const auto length = static_cast<unsigned>(block.size());
  const unsigned sum = static_cast<unsigned>(adler32(adler32(0, nullptr, 0), bytes_of(block), length));
  const unsigned head[] = {0x78, 0x01, 0x01, length, length >> 8, ~length, ~length >> 8};
  out.clear();
  for (const unsigned byte : head) out += static_cast<char>(byte & 0xff);
  out += block;
  for (const int shift : {24, 16, 8, 0}) out += static_cast<char>(sum >> shift & 0xff);
}

}  // namespace

/// zlib's compressor, set up once: that takes longer than a block.
class VtkEncoder::Deflater {
 public:
  Deflater() {
    constexpr int fast = 1;  // higher levels cost several times the time for little
    if (deflateInit(&stream_, fast) != Z_OK) throw std::bad_alloc();
    room_.resize(deflateBound(&stream_, block_bytes));
  }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;
  ~Deflater() { deflateEnd(&stream_); }

  void compress(std::string_view block, std::string& out) {
    stream_.next_in = const_cast<Bytef*>(bytes_of(block));  // zlib only reads it
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

VtkEncoder::VtkEncoder() : deflater_(std::make_unique<Deflater>()) {}
VtkEncoder::~VtkEncoder() = default;

/// Layout: number of blocks, size of a block, size of the last one if it is shorter (else 0), compressed size
/// of each block; then the blocks.
void VtkEncoder::add_data(Memory& memory, std::string bytes) {
  const std::size_t blocks = (bytes.size() + block_bytes - 1) / block_bytes;
  const bool as_it_is = memory.states_to_store > 0;
  const auto block_of = [](std::string_view all, std::size_t b) {
    return b * block_bytes < all.size() ? all.substr(b * block_bytes, block_bytes) : std::string_view();
  };
  memory.blocks.resize(blocks);
  std::size_t attempted = 0, reached = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::string_view block = block_of(bytes, b);
    if (block == block_of(memory.bytes, b)) continue;
    if (as_it_is)
      store(block, memory.blocks[b]);
    else
      deflater_->compress(block, memory.blocks[b]);
    attempted += block.size(), reached += memory.blocks[b].size();
  }
  if (as_it_is)
    --memory.states_to_store;
  else if (2 * reached > attempted)
    memory.states_to_store = states_between_attempts;

  for (const std::size_t number : {blocks, block_bytes, bytes.size() % block_bytes})
    add_uint32(data_, number);
  for (const std::string& block : memory.blocks) add_uint32(data_, block.size());
  for (const std::string& block : memory.blocks) data_ += block;
  memory.bytes = std::move(bytes);
}

void VtkEncoder::add_array(const char* section, VtkArray array, const char* attributes) {
  const auto out = std::back_inserter(header_);
  fmt::format_to(
      out, "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"{} format=\"appended\" offset=\"{}\"",
      array.type, array.name, array.components, attributes, data_.size());
  if (array.dimension.empty())
    header_ += "/>\n";
  else
    fmt::format_to(out,
                   ">\n<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">{}</InformationKey>\n"
                   "</DataArray>\n",
                   array.dimension);
  add_data(memory_[fmt::format("{}/{}", section, array.name)], std::move(array.bytes));
}

VtkEncoder::File VtkEncoder::encode(VtkDataSet data) {
  constexpr bool little = std::endian::native == std::endian::little;
  data_.clear();
  header_ = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"0.1\" byte_order=\"{}\" "
      "header_type=\"UInt32\" "
      "compressor=\"vtkZLibDataCompressor\">\n<{}>\n<FieldData>\n",
      data.type, little ? "LittleEndian" : "BigEndian", data.type);
  VtkArray time{"TimeValue", "Float64", 1, "", std::string(sizeof data.t, '\0')};
  std::memcpy(time.bytes.data(), &data.t, sizeof data.t);
  add_array("FieldData", std::move(time), " NumberOfTuples=\"1\"");
  header_ += fmt::format("</FieldData>\n<Piece {}>\n", data.sizes);
  for (VtkSection& section : data.sections) {
    header_ += fmt::format("<{}>\n", section.name);
    for (VtkArray& array : section.arrays) add_array(section.name, std::move(array), "");
    header_ += fmt::format("</{}>\n", section.name);
  }
  header_ += fmt::format("</Piece>\n</{}>\n<AppendedData encoding=\"raw\">\n_", data.type);
  data_ += "\n</AppendedData>\n</VTKFile>\n";
  return {header_, data_};
}

}  // namespace courant
