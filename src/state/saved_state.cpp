#include "state/saved_state.hpp"

#include <cstring>

#include "base/restart_error.hpp"

namespace courant {

void Archive::stop(const std::string& name, const std::string& why) const {
  throw RestartError("the saved state does not fit this run: '" + prefix_ + name + "' " + why);
}

void Archive::same_length(const std::string& name, std::size_t a, std::size_t b) const {
  if (a != b) stop(name, "has another length than its names");
}

const SavedArray& Archive::find(const std::string& name, SavedType type) {
  const auto found = state_.find(prefix_ + name);
  if (found == state_.end()) stop(name, "is not there");
  if (found->second.type != type) stop(name, "holds another kind of number");
  asked_[found->first] = true;
  return found->second;
}

SavedArray& Archive::make(const std::string& name, SavedType type, std::size_t rows, std::size_t bytes) {
  const auto [at, is_new] = state_.try_emplace(prefix_ + name);
  if (!is_new) throw std::logic_error("'" + at->first + "' is saved twice");
  at->second.type = type;
  at->second.rows = rows;
  at->second.bytes.resize(bytes);
  return at->second;
}

void Archive::copy(const std::string& name, std::byte* values) {
  Array<std::byte>& bytes = state_.at(prefix_ + name).bytes;
  if (bytes.empty()) return;
  if (loading_)
    std::memcpy(values, bytes.data(), bytes.size());
  else
    std::memcpy(bytes.data(), values, bytes.size());
}

void Archive::fixed(const std::string& name, SavedType type, std::size_t rows, std::size_t bytes_per_row,
                    const std::vector<std::byte*>& starts) {
  if (!loading_) {
    SavedArray& to = make(name, type, rows, rows * bytes_per_row);
    for (std::size_t k = 0; k < rows && bytes_per_row > 0; ++k)
      std::memcpy(to.bytes.data() + k * bytes_per_row, starts[k], bytes_per_row);
    return;
  }
  const SavedArray& from = find(name, type);
  if (from.bytes.size() != rows * bytes_per_row) stop(name, "has another length");
  for (std::size_t k = 0; k < rows && bytes_per_row > 0; ++k)
    std::memcpy(starts[k], from.bytes.data() + k * bytes_per_row, bytes_per_row);
}

void Archive::operator()(const std::string& name, std::string& text) {
  std::vector<char> letters(text.begin(), text.end());
  (*this)(name, letters);
  text.assign(letters.begin(), letters.end());
}

void Archive::operator()(const std::string& name, std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  (*this)(name, text);
  if (!loading_) return;
  lines.clear();
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
}

std::size_t Archive::count(const std::string& name) const {
  const auto found = state_.find(prefix_ + name);
  if (found == state_.end()) stop(name, "is not there");
  return found->second.count();
}

void Archive::stop_for_leftovers() const {
  for (const auto& [path, array] : state_)
    if (path.rfind(prefix_, 0) == 0 && !asked_.contains(path))
      throw RestartError("the saved state does not fit this run, which knows no '" + path + "'");
}

}  // namespace courant
