#include "output/binout/lsda.hpp"

#include <unistd.h>

#include <bit>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

namespace courant {
namespace {

enum class Command : std::uint8_t {
  folder = 2,
  data = 3,
  variable = 4,
  begin_table = 5,
  end_table = 6,
  table_at = 7
};
constexpr std::size_t word_bytes = 8, command_bytes = word_bytes + 1;  // a length, and the command behind it
constexpr std::uintmax_t first_link = 8 + command_bytes, head_bytes = first_link + word_bytes;

void add(std::string& to, std::uint64_t value) {
  char bytes[word_bytes];
  std::memcpy(bytes, &value, word_bytes);
  to.append(bytes, word_bytes);
}

void add_command(std::string& to, std::size_t content, Command command) {
  add(to, command_bytes + content);
  to += static_cast<char>(command);
}

std::string as_bytes(std::uint64_t value) {
  std::string out;
  add(out, value);
  return out;
}

template <class T>
LsdaArray array_of(std::string in, std::string name, LsdaArray::Type type, const std::vector<T>& values) {
  LsdaArray out{std::move(in), std::move(name), type, {}, values.size()};
  if (!values.empty())
    out.bytes.assign(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  return out;
}

}  // namespace

LsdaArray lsda_reals(std::string in, std::string name, const std::vector<Real>& values) {
  static_assert(sizeof(Real) == 8);
  return array_of(std::move(in), std::move(name), LsdaArray::Type::real, values);
}

LsdaArray lsda_integers(std::string in, std::string name, const std::vector<std::int64_t>& values) {
  return array_of(std::move(in), std::move(name), LsdaArray::Type::integer, values);
}

LsdaArray lsda_text(std::string in, std::string name, const std::string& text) {
  return {std::move(in), std::move(name), LsdaArray::Type::text, text, text.size()};
}

LsdaFile::LsdaFile(std::filesystem::path file, std::optional<std::uintmax_t> bytes)
    : file_(std::move(file)),
      descriptor_(open_for_writing(file_, bytes ? Opening::as_it_is : Opening::empty)) {
  if (bytes && *bytes > head_bytes) {
    if (::ftruncate(descriptor_.number(), static_cast<off_t>(*bytes)) != 0)
      throw OutputError(file_, std::generic_category().message(errno));
    size_ = *bytes, link_ = size_ - word_bytes;
    put(as_bytes(0), link_);
    return;
  }
  // lengths and offsets of eight bytes, commands and types of one, order of bytes, IEEE
  constexpr bool little = std::endian::native == std::endian::little;
  std::string head{8, 8, 8, 1, 1, little ? '\1' : '\0', 0, 0};
  add_command(head, word_bytes, Command::table_at);
  add(head, 0);
  put(head, 0);
  size_ = head_bytes, link_ = first_link;
}

void LsdaFile::put(std::string_view bytes, std::uintmax_t at) {
  while (!bytes.empty()) {
    const ssize_t done = ::pwrite(descriptor_.number(), bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) throw OutputError(file_, std::generic_category().message(done < 0 ? errno : ENOSPC));
    bytes.remove_prefix(static_cast<std::size_t>(done)), at += static_cast<std::uintmax_t>(done);
  }
}

// A record of data: length, command, type, length of the name, name, values. A table: its begin, folders and
// the arrays in them (name, type, where the record is, number of values), its end with the offset of the next
// table.
void LsdaFile::write(const std::vector<LsdaArray>& arrays) {
  std::string out, entries, inside;
  for (const LsdaArray& one : arrays) {
    if (one.folder != inside) {
      inside = one.folder;
      for (std::string* to : {&out, &entries}) {
        add_command(*to, inside.size(), Command::folder);
        *to += inside;
      }
    }
    const std::uintmax_t at = size_ + out.size();
    add_command(out, 2 + one.name.size() + one.bytes.size(), Command::data);
    out += static_cast<char>(one.type);
    out += static_cast<char>(one.name.size());
    out += one.name;
    out += one.bytes;
    add_command(entries, one.name.size() + 1 + 2 * word_bytes, Command::variable);
    entries += one.name;
    entries += static_cast<char>(one.type);
    add(entries, at);
    add(entries, one.count);
  }
  const std::uintmax_t table = size_ + out.size();
  std::string begin;
  add(begin, command_bytes + entries.size() + command_bytes + word_bytes);  // of all of it
  begin += static_cast<char>(Command::begin_table);
  out += begin;
  out += entries;
  add_command(out, word_bytes, Command::end_table);
  add(out, 0);
  put(out, size_);
  put(as_bytes(table), link_);
  size_ += out.size(), link_ = size_ - word_bytes;
}

}  // namespace courant
