#include "output/history_checksum.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <string_view>

namespace courant {

namespace {

std::string line_of(std::string_view bytes) {
  return fmt::format("\ncourant history file, crc32 {:08x}\n",
                     crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace

std::string history_checksum(const std::string& bytes) {
  return line_of(bytes);
}

bool take_history_checksum(std::string& content) {
  const std::size_t length = line_of({}).size();
  if (content.size() < length) return false;
  const std::string_view bytes = std::string_view(content).substr(0, content.size() - length);
  if (std::string_view(content).substr(bytes.size()) != line_of(bytes)) return false;
  content.resize(bytes.size());
  return true;
}

}  // namespace courant
