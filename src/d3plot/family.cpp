#include "d3plot/family.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <system_error>

#include "d3plot/words.hpp"
#include "output/file.hpp"
#include "output/result_names.hpp"

namespace courant {
namespace {

void write_at(const std::filesystem::path& file, const Descriptor& to, std::string_view bytes,
              std::size_t at) {
  while (!bytes.empty()) {
    const ssize_t done = ::pwrite(to.number(), bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) throw OutputError(file, std::generic_category().message(done < 0 ? errno : ENOSPC));
    bytes.remove_prefix(static_cast<std::size_t>(done)), at += static_cast<std::size_t>(done);
  }
}

}  // namespace

D3plotFamily::D3plotFamily(std::filesystem::path dir, int bits, std::size_t state_bytes, std::size_t most)
    : dir_(std::move(dir)),
      state_bytes_(state_bytes),
      states_in_file_(static_cast<int>(std::clamp<std::size_t>(most / state_bytes, 1, 1 << 20))) {
  Words words(bits);
  words.real(d3plot_end);
  end_ = words.take();
}

std::filesystem::path D3plotFamily::file(int index) const {
  return result_path(dir_, fmt::format("{}{:02d}", result_names::d3plot, index));
}

void D3plotFamily::remove_from(int index) {
  const std::filesystem::path head = result_path(dir_, result_names::d3plot);
  const std::string name = head.filename().string();
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(head.parent_path(), error)) {  // with gaps
    const std::string other = entry.path().filename().string();
    int number = 0;
    if (other.rfind(name, 0) != 0 ||
        std::from_chars(other.data() + name.size(), other.data() + other.size(), number).ptr !=
            other.data() + other.size() ||
        number < index)
      continue;
    if (!std::filesystem::remove(entry.path(), error)) throw OutputError(entry.path(), error.message());
  }
}

bool D3plotFamily::has_head() const {
  std::error_code none;
  return std::filesystem::exists(result_path(dir_, result_names::d3plot), none);
}

bool D3plotFamily::has_states(int number) const {
  std::error_code none;
  for (int index = 1; index <= (number + states_in_file_ - 1) / states_in_file_; ++index)
    if (!std::filesystem::exists(file(index), none)) return false;
  return true;
}

int D3plotFamily::next_whole(int number) const {
  const int index = number / states_in_file_ + 1;
  std::error_code none;
  const bool lost = number % states_in_file_ != 0 && !std::filesystem::exists(file(index), none);
  return lost ? index * states_in_file_ : number;
}

void D3plotFamily::begin(std::string_view model) {
  remove_from(1);
  write_head(model);
}

void D3plotFamily::write_head(std::string_view model) {
  write_file(result_path(dir_, result_names::d3plot), model);
  bytes_ += static_cast<std::int64_t>(model.size());
}

void D3plotFamily::write(int number, std::string_view state) {
  const int index = number / states_in_file_ + 1;
  const std::size_t at = static_cast<std::size_t>(number % states_in_file_) * state_bytes_;
  const Descriptor to = open_for_writing(file(index), Opening::as_it_is);
  if (at == 0) write_at(file(index), to, end_, 0);
  write_at(file(index), to, state.substr(end_.size()), at + end_.size());
  write_at(file(index), to, end_, at + state_bytes_);
  write_at(file(index), to, state.substr(0, end_.size()), at);
  bytes_ += static_cast<std::int64_t>(state.size());
}

void D3plotFamily::cut(int number) {
  const int index = number / states_in_file_ + 1, inside = number % states_in_file_;
  remove_from(inside == 0 ? index : index + 1);
  std::error_code none;
  if (inside == 0 || !std::filesystem::exists(file(index), none)) return;
  const std::size_t at = static_cast<std::size_t>(inside) * state_bytes_;
  const Descriptor to = open_for_writing(file(index), Opening::as_it_is);
  write_at(file(index), to, end_, at);
  if (::ftruncate(to.number(), static_cast<off_t>(at + end_.size())) != 0)
    throw OutputError(file(index), std::generic_category().message(errno));
}

}  // namespace courant
