#include "post/field_file.hpp"

#include <lzma.h>
#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>
#include <utility>

namespace courant {
namespace {

constexpr std::size_t longest_head = 1 << 20, largest_block = 1 << 20;  // bytes
constexpr std::string_view data_mark = "<AppendedData encoding=\"raw\">\n_";

/// A number from 0 on, nothing else.
std::optional<std::int64_t> whole_number(const std::string& text) {
  std::int64_t value = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 0) return std::nullopt;
  return value;
}

/// Bytes of a value of one of VTK's types; 0 for others.
std::size_t width_of(std::string_view type) {
  for (const auto& [name, width] : {std::pair<std::string_view, std::size_t>{"Float32", 4},
                                    {"Float64", 8},
                                    {"Int32", 4},
                                    {"Int64", 8},
                                    {"UInt8", 1},
                                    {"Int8", 1}})
    if (type == name) return width;
  return 0;
}

template <class T, class To>
void convert(const std::string& bytes, std::vector<To>& to) {
  to.resize(bytes.size() / sizeof(T));
  for (std::size_t i = 0; i < to.size(); ++i) {
    T value;
    std::memcpy(&value, bytes.data() + i * sizeof(T), sizeof(T));
    to[i] = static_cast<To>(value);
  }
}

std::vector<Real> reals_of(std::string_view type, const std::string& bytes) {
  std::vector<Real> out;
  if (type == "Float32") convert<float>(bytes, out);
  if (type == "Float64") convert<double>(bytes, out);
  if (type == "Int32") convert<std::int32_t>(bytes, out);
  if (type == "Int64") convert<std::int64_t>(bytes, out);
  if (type == "UInt8") convert<std::uint8_t>(bytes, out);
  if (type == "Int8") convert<std::int8_t>(bytes, out);
  return out;
}

/// Unpacks into `to` and tells whether it is filled.
bool unpack_zlib(const std::string& packed, char* to, std::size_t size) {
  auto length = static_cast<uLongf>(size);
  return uncompress(reinterpret_cast<Bytef*>(to), &length, reinterpret_cast<const Bytef*>(packed.data()),
                    static_cast<uLong>(packed.size())) == Z_OK &&
         length == size;
}

bool unpack_xz(const std::string& packed, char* to, std::size_t size) {
  std::uint64_t memory = 1u << 28;
  std::size_t in = 0, out = 0;
  return lzma_stream_buffer_decode(&memory, 0, nullptr, reinterpret_cast<const std::uint8_t*>(packed.data()),
                                   &in, packed.size(), reinterpret_cast<std::uint8_t*>(to), &out,
                                   size) == LZMA_OK &&
         out == size;
}

}  // namespace

std::optional<FieldFile> FieldFile::open(const std::filesystem::path& file) {
  FieldFile out;
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  out.stream_.open(file, std::ios::binary);
  if (error || !out.stream_ || size > std::uintmax_t(std::numeric_limits<std::int64_t>::max()))
    return std::nullopt;
  out.size_ = static_cast<std::int64_t>(size);
  std::string head(std::min<std::uintmax_t>(longest_head, size), '\0');
  if (!out.stream_.read(head.data(), static_cast<std::streamsize>(head.size()))) return std::nullopt;
  constexpr std::string_view last_line = "</VTKFile>\n";  // a file that was cut off has none
  std::string ending(last_line.size(), '\0');
  out.stream_.seekg(-static_cast<std::streamoff>(ending.size()), std::ios::end);
  if (!out.stream_.read(ending.data(), static_cast<std::streamsize>(ending.size())) || ending != last_line)
    return std::nullopt;
  const std::size_t mark = head.find(data_mark);
  if (mark == std::string::npos) return std::nullopt;
  out.data_ = static_cast<std::int64_t>(mark + data_mark.size());
  head.resize(mark);
  if (!out.read_head(head)) return std::nullopt;
  return out;
}

/// Tags and their attributes one after the other; what stands between them is of no account.
bool FieldFile::read_head(const std::string& head) {
  std::string section;
  for (std::size_t at = head.find('<'); at != std::string::npos; at = head.find('<', at)) {
    const std::size_t end = head.find('>', at);
    if (end == std::string::npos) return false;
    const std::string tag = head.substr(at + 1, end - at - 1);
    at = end;
    std::map<std::string, std::string> attributes;
    const std::size_t name_end = std::min(tag.find_first_of(" /?", tag.starts_with('/') ? 1 : 0), tag.size());
    for (std::size_t k = tag.find('=', name_end); k != std::string::npos; k = tag.find('=', k)) {
      const std::size_t start = tag.rfind(' ', k), close = tag.find('"', std::min(k + 2, tag.size()));
      if (start == std::string::npos || close == std::string::npos || tag[k + 1] != '"') return false;
      attributes[tag.substr(start + 1, k - start - 1)] = tag.substr(k + 2, close - k - 2);
      k = close;
    }
    if (!take_tag(tag.substr(0, name_end), attributes, section)) return false;
  }
  return points_ > 0 || !arrays_.empty();
}

bool FieldFile::take_tag(const std::string& name, const std::map<std::string, std::string>& attributes,
                         std::string& section) {
  const auto text = [&](const char* key) {
    const auto found = attributes.find(key);
    return found == attributes.end() ? std::string() : found->second;
  };
  const auto most = std::int64_t(std::numeric_limits<Index>::max());
  if (name == "VTKFile") {
    const std::string packing = text("compressor");
    packing_ = packing.empty()                      ? Packing::none
               : packing == "vtkZLibDataCompressor" ? Packing::zlib
                                                    : Packing::xz;
    return text("byte_order") == "LittleEndian" && text("header_type") == "UInt32" &&
           (packing_ != Packing::xz || packing == "vtkLZMADataCompressor");
  }
  if (name == "Piece") {
    const auto points = whole_number(text("NumberOfPoints"));
    const auto cells =
        attributes.count("NumberOfCells") ? whole_number(text("NumberOfCells")) : std::int64_t(0);
    if (!points || !cells || *points > most || *cells > most) return false;
    points_ = *points, cells_ = *cells;
  } else if (name == "DataArray") {
    const auto components = whole_number(text("NumberOfComponents")), offset = whole_number(text("offset"));
    constexpr std::int64_t most_components = 64;
    if (!components || !offset || *components < 1 || *components > most_components ||
        *offset > size_ - data_ || width_of(text("type")) == 0 || text("format") != "appended")
      return false;
    arrays_[section + "/" + text("Name")] = {text("type"), static_cast<int>(*components), *offset};
  } else if (name != "InformationKey" && !name.starts_with('/')) {
    section = name;
  }
  return true;
}

bool FieldFile::has(const std::string& section, const std::string& name) const {
  return find(section, name) != nullptr;
}

int FieldFile::components(const std::string& section, const std::string& name) const {
  const Array* array = find(section, name);
  return array ? array->components : 0;
}

const FieldFile::Array* FieldFile::find(const std::string& section, const std::string& name) const {
  const auto found = arrays_.find(section + "/" + name);
  return found == arrays_.end() ? nullptr : &found->second;
}

std::optional<std::vector<Real>> FieldFile::values(const std::string& section, const std::string& name,
                                                   std::int64_t tuples) {
  const Array* array = find(section, name);
  if (!array) return std::nullopt;
  const double wanted =
      static_cast<double>(tuples) * array->components * static_cast<double>(width_of(array->type));
  const auto bytes = bytes_of(*array, wanted);
  if (!bytes || static_cast<double>(bytes->size()) != wanted) return std::nullopt;
  return reals_of(array->type, *bytes);
}

std::optional<std::vector<std::int64_t>> FieldFile::integers(const std::string& section,
                                                             const std::string& name, std::int64_t most) {
  const Array* array = find(section, name);
  if (!array || array->components != 1 || !(array->type == "Int32" || array->type == "Int64"))
    return std::nullopt;
  const std::size_t width = width_of(array->type);
  const auto bytes = bytes_of(*array, static_cast<double>(most) * static_cast<double>(width));
  if (!bytes || bytes->size() % width != 0) return std::nullopt;
  std::vector<std::int64_t> out;
  if (width == 4)
    convert<std::int32_t>(*bytes, out);
  else
    convert<std::int64_t>(*bytes, out);
  return out;
}

bool FieldFile::read(std::uint32_t* to, std::size_t count) {  // little-endian, as this machine is
  return static_cast<bool>(
      stream_.read(reinterpret_cast<char*>(to), static_cast<std::streamsize>(count * sizeof *to)));
}

/// Its data, unpacked; nothing where they are damaged or more than `most` bytes.
std::optional<std::string> FieldFile::bytes_of(const Array& array, double most) {
  stream_.clear();
  stream_.seekg(data_ + array.offset);
  if (packing_ != Packing::none) return packed_bytes(most);
  std::uint32_t length = 0;
  if (!read(&length, 1) || length > most || length > size_) return std::nullopt;
  std::string out(length, '\0');
  if (!stream_.read(out.data(), static_cast<std::streamsize>(length))) return std::nullopt;
  return out;
}

/// Number of blocks, bytes of a block, of the last one if it is shorter, compressed bytes of each; the
/// blocks.
std::optional<std::string> FieldFile::packed_bytes(double most) {
  std::uint32_t head[3] = {0, 0, 0};
  if (!read(head, 3)) return std::nullopt;
  const auto [blocks, block, last] = head;
  if (blocks > size_ / std::int64_t(sizeof(std::uint32_t)) || block > largest_block || last > block)
    return std::nullopt;
  if (static_cast<double>(blocks) * block > most + block) return std::nullopt;
  std::vector<std::uint32_t> lengths(blocks);
  if (!read(lengths.data(), blocks)) return std::nullopt;
  std::string out, packed;
  for (std::size_t b = 0; b < blocks; ++b) {
    if (lengths[b] > size_) return std::nullopt;
    packed.resize(lengths[b]);
    if (!stream_.read(packed.data(), static_cast<std::streamsize>(packed.size()))) return std::nullopt;
    const std::size_t size = b + 1 == blocks && last > 0 ? last : block, before = out.size();
    out.resize(before + size);  // grows by what the blocks before have proved to hold
    const bool whole = packing_ == Packing::zlib ? unpack_zlib(packed, out.data() + before, size)
                                                 : unpack_xz(packed, out.data() + before, size);
    if (!whole) return std::nullopt;
  }
  return out;
}

}  // namespace courant
