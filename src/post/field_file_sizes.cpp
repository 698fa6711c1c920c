#include "post/field_file_sizes.hpp"

#include <charconv>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace courant {
namespace {

constexpr double most_compression = 8000;  // of LZMA, the strongest
constexpr std::size_t longest_head = 1 << 20;

/// All numbers that stand behind `key="` in the head of a file.
std::vector<double> numbers_behind(std::string_view head, std::string_view key) {
  std::vector<double> out;
  for (std::size_t at = head.find(key); at != std::string_view::npos; at = head.find(key, at + 1)) {
    const std::size_t begin = at + key.size();
    double value = 0;
    if (std::from_chars(head.data() + begin, head.data() + head.size(), value).ec == std::errc())
      out.push_back(value);
  }
  return out;
}

/// Counts in front of an array: of blocks and of bytes in one of them; without compression of bytes.
class ArrayHeader {
 public:
  ArrayHeader(std::ifstream& file, std::size_t width) : file_(file), width_(width) {}
  /// False behind the end of the file.
  bool read(double& to) {
    char bytes[sizeof(std::uint64_t)] = {};
    if (!file_.read(bytes, static_cast<std::streamsize>(width_))) return false;
    std::uint64_t value = 0;
    std::memcpy(&value, bytes, sizeof value);  // little-endian, as this machine is
    to = static_cast<double>(value);
    return true;
  }

 private:
  std::ifstream& file_;
  std::size_t width_;
};

}  // namespace

bool sizes_fit(const std::filesystem::path& path) {
  std::error_code error;
  const auto size = static_cast<double>(std::filesystem::file_size(path, error));
  std::ifstream file(path, std::ios::binary);
  if (error || !file) return true;  // told by who reads it
  std::string head(longest_head, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  const std::size_t data = head.find("<AppendedData");
  const std::size_t mark = data == std::string::npos ? data : head.find('_', data);
  if (mark == std::string::npos || head.find("encoding=\"raw\"", data) > mark) return true;
  const std::string_view text(head.data(), data);
  const double most = most_compression * size;
  for (const char* key : {"NumberOfPoints=\"", "NumberOfCells=\"", "NumberOfVerts=\"", "NumberOfLines=\"",
                          "NumberOfStrips=\"", "NumberOfPolys=\"", "NumberOfTuples=\""})
    for (const double number : numbers_behind(text, key))
      if (!(number >= 0 && number <= most)) return false;
  const bool compressed = text.find("compressor=") != std::string_view::npos;
  const std::size_t width = text.find("header_type=\"UInt64\"") != std::string_view::npos ? 8 : 4;
  for (const double offset : numbers_behind(text, "offset=\"")) {
    if (!(offset >= 0 && offset < size)) return false;
    file.clear();
    file.seekg(static_cast<std::streamoff>(mark + 1) + static_cast<std::streamoff>(offset));
    ArrayHeader header(file, width);
    double first = 0, bytes = 0;
    if (!header.read(first)) return false;
    if (!compressed && first > size) return false;
    if (!compressed) continue;
    if (!header.read(bytes) && first > 0) return false;
    if (first * static_cast<double>(width) > size || first * bytes > most + bytes) return false;
  }
  return true;
}

}  // namespace courant
