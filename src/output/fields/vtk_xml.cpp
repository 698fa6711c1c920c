#include "output/fields/vtk_xml.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace courant {
namespace {

constexpr std::size_t most_stored = 65535;  // the length of a stored block has 16 bits
constexpr int states_between_attempts = 128;

/// Bytes of a value, from VTK's word for its type: Int64, UInt8.
int width_of(std::string_view type) {
  if (type.ends_with("64")) return 8;
  return type.ends_with("32") ? 4 : 1;
}

const char* attribute_of(Compression::Method method) {
  switch (method) {
    case Compression::Method::none:
      return "";
    case Compression::Method::zlib:
      return " compressor=\"vtkZLibDataCompressor\"";
    case Compression::Method::xz:
      return " compressor=\"vtkLZMADataCompressor\"";
  }
  return "";
}

void add_uint32(std::string& out, std::size_t value) {
  const auto number = static_cast<std::uint32_t>(value);
  out.append(reinterpret_cast<const char*>(&number), sizeof number);
}

const Bytef* bytes_of(std::string_view text) {
  return reinterpret_cast<const Bytef*>(text.data());
}

/// The block as a zlib stream that holds it as it is (RFC 1950, RFC 1951: one stored block).
void store(std::string_view block, std::string& out) {
  if (block.size() > most_stored) throw std::logic_error("a stored block is too long");
  const auto length = static_cast<unsigned>(block.size());
  const unsigned sum = static_cast<unsigned>(adler32(adler32(0, nullptr, 0), bytes_of(block), length));
  const unsigned head[] = {0x78, 0x01, 0x01, length, length >> 8, ~length, ~length >> 8};
  out.clear();
  for (const unsigned byte : head) out += static_cast<char>(byte & 0xff);
  out += block;
  for (const int shift : {24, 16, 8, 0}) out += static_cast<char>(sum >> shift & 0xff);
}

/// RFC 4648, with padding.
void add_base64(std::string_view bytes, std::string& out) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto byte = [&](std::size_t i) {
    return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0U;
  };
  std::size_t at = out.size();
  out.resize(at + (bytes.size() + 2) / 3 * 4, '=');
  for (std::size_t i = 0; i < bytes.size(); i += 3, at += 4) {
    const unsigned three = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (std::size_t k = 0; k < std::min<std::size_t>(4, bytes.size() - i + 1); ++k)
      out[at + k] = digits[three >> (18 - 6 * k) & 63];
  }
}

/// A block that was stored as it is, by its third byte.
bool is_stored(std::string_view packed) {
  return packed.size() > 2 && packed[2] == 1;
}

/// Tells a block from another, and whether it was stored. A block that is taken for another is only packed
/// otherwise.
std::int64_t mark_of(std::string_view block, bool stored) {
  const auto sum = crc32(crc32(0, nullptr, 0), bytes_of(block), static_cast<unsigned>(block.size()));
  return 2 * static_cast<std::int64_t>(sum) + (stored ? 1 : 0);
}

}  // namespace

std::string in_xml(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c >= ' ' && c <= '~' ? c : ' ';
  }
  return out;
}

VtkEncoder::VtkEncoder(Compression compression)
    : compression_(compression), compressor_(BlockCompressor::make(compression)) {}
VtkEncoder::~VtkEncoder() = default;

/// Layout: number of blocks, size of a block, size of the last one if it is shorter (else 0), compressed size
/// of each block; then the blocks. Without compression: the number of bytes, then these.
void VtkEncoder::add_data(Memory& memory, std::string bytes, int stride) {
  if (!compressor_) {
    std::string whole;
    add_uint32(whole, bytes.size());
    put(whole + bytes);
    return;
  }
  const std::size_t size = block_bytes(), blocks = (bytes.size() + size - 1) / size;
  const bool as_it_is = memory.states_to_store > 0;
  const auto block_of = [size](std::string_view all, std::size_t b) {
    return b * size < all.size() ? all.substr(b * size, size) : std::string_view();
  };
  memory.blocks.resize(blocks);
  std::size_t attempted = 0, reached = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::string_view block = block_of(bytes, b);
    if (block == block_of(memory.bytes, b) || pack_as_before(memory, b, block, stride)) continue;
    if (as_it_is)
      store(block, memory.blocks[b]);
    else
      compressor_->compress(block, stride, memory.blocks[b]);
    attempted += block.size(), reached += memory.blocks[b].size();
  }
  if (as_it_is)
    --memory.states_to_store;
  else if (2 * reached > attempted && !compression_.always)
    memory.states_to_store = states_between_attempts;

  std::string sizes, packed;
  for (const std::size_t number : {blocks, size, bytes.size() % size}) add_uint32(sizes, number);
  for (const std::string& block : memory.blocks) add_uint32(sizes, block.size()), packed += block;
  put(sizes);
  put(packed);
  memory.bytes = std::move(bytes);
  memory.before_restart.clear();
}

void VtkEncoder::put(std::string_view bytes) {
  if (as_text_)
    add_base64(bytes, data_);
  else
    data_ += bytes;
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
  // counters and numbers of particles run up; floats are best left as they are
  const bool counts = std::string_view(array.type).substr(0, 5) != "Float";
  const int stride = counts ? width_of(array.type) * array.components : 0;
  add_data(memory_[fmt::format("{}/{}", section, array.name)], std::move(array.bytes), stride);
}

VtkEncoder::File VtkEncoder::encode(VtkDataSet data) {
  constexpr bool little = std::endian::native == std::endian::little;
  data_.clear();
  // The encoding is in a document type, not at AppendedData: only so short a tag is read by ParaView 5.11
  // with an expat that holds back what it parses (CVE-2023-52425; Debian 12 since 2.5.0-1+deb12u2). meshio
  // reads no raw data behind such a tag, and no .vtp at all: grids are text.
  as_text_ = std::string_view(data.type) == "UnstructuredGrid";
  header_ = fmt::format(
      "<?xml version=\"1.0\"?>\n<!DOCTYPE VTKFile [<!ATTLIST AppendedData encoding CDATA "
      "\"{}\">]>\n<VTKFile type=\"{}\" version=\"0.1\" byte_order=\"{}\" "
      "header_type=\"UInt32\"{}>\n<{}>\n<FieldData>\n",
      as_text_ ? "base64" : "raw", data.type, little ? "LittleEndian" : "BigEndian",
      attribute_of(compression_.method), data.type);
  VtkArray time{"TimeValue", "Float64", 1, "", std::string(sizeof data.t, '\0')};
  std::memcpy(time.bytes.data(), &data.t, sizeof data.t);
  add_array("FieldData", std::move(time), " NumberOfTuples=\"1\"");
  for (VtkArray& one : data.facts) add_array("FieldData", std::move(one), " NumberOfTuples=\"1\"");
  header_ += fmt::format("</FieldData>\n<Piece {}>\n", data.sizes);
  for (VtkSection& section : data.sections) {
    header_ += fmt::format("<{}>\n", section.name);
    for (VtkArray& array : section.arrays) add_array(section.name, std::move(array), "");
    header_ += fmt::format("</{}>\n", section.name);
  }
  header_ += fmt::format("</Piece>\n</{}>\n<AppendedData>\n_", data.type);
  data_ += "\n</AppendedData>\n</VTKFile>\n";
  return {header_, data_};
}

/// The first state after a restart: a block that was there before it.
bool VtkEncoder::pack_as_before(Memory& memory, std::size_t b, std::string_view block, int stride) {
  if (b >= memory.before_restart.size()) return false;
  const bool stored = memory.before_restart[b] % 2 != 0;
  if (memory.before_restart[b] != mark_of(block, stored)) return false;
  if (stored)
    store(block, memory.blocks[b]);
  else
    compressor_->compress(block, stride, memory.blocks[b]);
  return true;
}

void VtkEncoder::keep(Archive& archive) {
  std::map<std::string, std::int64_t> states, counts;
  std::vector<std::int64_t> marks;
  const std::size_t size = block_bytes();
  for (const auto& [name, memory] : memory_) {
    states[name] = memory.states_to_store;
    counts[name] = static_cast<std::int64_t>(memory.before_restart.size() + memory.blocks.size());
    marks.insert(marks.end(), memory.before_restart.begin(), memory.before_restart.end());
    for (std::size_t b = 0; memory.before_restart.empty() && b < memory.blocks.size(); ++b)
      marks.push_back(
          mark_of(std::string_view(memory.bytes).substr(b * size, size), is_stored(memory.blocks[b])));
  }
  archive("states_to_store", states);
  archive("blocks", counts);
  archive("marks", marks);
  if (!archive.loading()) return;
  auto at = marks.begin();
  for (const auto& [name, count] : counts) {
    if (count < 0 || count > marks.end() - at) archive.stop("blocks", "counts marks that are not there");
    Memory& memory = memory_[name];
    memory.states_to_store = static_cast<int>(states[name]);
    memory.before_restart.assign(at, at + count);
    at += count;
  }
}

}  // namespace courant
