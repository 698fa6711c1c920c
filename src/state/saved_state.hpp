#pragma once
// The state of a run as named arrays of numbers: the content of a restart file.
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "base/real.hpp"
#include "parallel/array.hpp"

namespace courant {

/// Type of the numbers of an array.
enum class SavedType : char { real, integer64, integer32, byte };

template <class T>
constexpr SavedType saved_type() {
  if constexpr (std::is_floating_point_v<T>) {
    static_assert(sizeof(T) == 8);
    return SavedType::real;
  } else {
    static_assert(std::is_integral_v<T> && (sizeof(T) == 8 || sizeof(T) == 4 || sizeof(T) == 1));
    return sizeof(T) == 8 ? SavedType::integer64 : sizeof(T) == 4 ? SavedType::integer32 : SavedType::byte;
  }
}

struct SavedArray {
  SavedType type = SavedType::byte;
  std::size_t rows = 1;  ///< components of a field, one after the other
  Array<std::byte> bytes;
  std::size_t width() const {  ///< of a number [bytes]
    return type == SavedType::byte ? 1 : type == SavedType::integer32 ? 4 : 8;
  }
  std::size_t count() const { return bytes.size() / width(); }  ///< numbers in all rows
};

/// By path: "particles/velocity", "passes/contact 1/travel".
using SavedState = std::map<std::string, SavedArray>;

/// Saves members of objects in a SavedState, or loads them from it: one list of members serves both
/// directions, so no saved member can be forgotten on loading. Loading throws RestartError where a name is
/// missing or has another type or size.
class Archive {
 public:
  static Archive saver(SavedState& state) { return Archive(state, false); }
  static Archive loader(SavedState& state) { return Archive(state, true); }
  bool loading() const { return loading_; }

  /// Names are below `group` during the lifetime of the returned object.
  class Group {
   public:
    Group(Archive& archive, const std::string& group) : archive_(archive), before_(archive.prefix_) {
      archive_.prefix_ += group + "/";
    }
    Group(const Group&) = delete;
    Group& operator=(const Group&) = delete;
    ~Group() { archive_.prefix_ = before_; }

   private:
    Archive& archive_;
    std::string before_;
  };

  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(const std::string& name, T& value) {
    fixed(name, saved_type<T>(), 1, sizeof value, {reinterpret_cast<std::byte*>(&value)});
  }
  void operator()(const std::string& name, Vec& value) {
    fixed(name, SavedType::real, 1, sizeof value, {reinterpret_cast<std::byte*>(value.data())});
  }
  void operator()(const std::string& name, std::string& text);
  template <class T, class Allocator>
  requires std::is_arithmetic_v<T>
  void operator()(const std::string& name, std::vector<T, Allocator>& values) {
    list(name, saved_type<T>(), values);
  }
  void operator()(const std::string& name, std::vector<Vec>& values) { list(name, SavedType::real, values); }
  /// Texts without line ends.
  void operator()(const std::string& name, std::vector<std::string>& lines);
  /// Numbers by name.
  template <class T>
  void operator()(const std::string& name, std::map<std::string, T>& map) {
    std::vector<std::string> names;
    std::vector<T> values;
    for (const auto& [key, value] : map) names.push_back(key), values.push_back(value);
    (*this)(name + "_names", names);
    (*this)(name, values);
    if (!loading_) return;
    same_length(name, names.size(), values.size());
    map.clear();
    for (std::size_t k = 0; k < names.size(); ++k) map[names[k]] = values[k];
  }
  /// Rows of a length that does not change, as of a field; `count` numbers in each.
  template <class T>
  void rows(const std::string& name, const std::vector<T*>& rows, std::size_t count) {
    std::vector<std::byte*> starts;
    for (T* row : rows) starts.push_back(reinterpret_cast<std::byte*>(row));
    fixed(name, saved_type<T>(), rows.size(), count * sizeof(T), starts);
  }

  /// Whether the state has an array of that name.
  bool has(const std::string& name) const { return state_.contains(prefix_ + name); }
  /// Numbers saved under that name in all rows, while loading.
  std::size_t count(const std::string& name) const;

  /// Throws RestartError if the state has an array that was not requested: it is from a run with other
  /// passes.
  void stop_for_leftovers() const;
  [[noreturn]] void stop(const std::string& name, const std::string& why) const;

 private:
  Archive(SavedState& state, bool loading) : state_(state), loading_(loading) {}
  void fixed(const std::string& name, SavedType type, std::size_t rows, std::size_t bytes_per_row,
             const std::vector<std::byte*>& starts);
  const SavedArray& find(const std::string& name, SavedType type);
  SavedArray& make(const std::string& name, SavedType type, std::size_t rows, std::size_t bytes);
  void same_length(const std::string& name, std::size_t a, std::size_t b) const;

  template <class Vector>
  void list(const std::string& name, SavedType type, Vector& values) {
    using T = typename Vector::value_type;
    if (loading_) {
      const SavedArray& from = find(name, type);
      if (from.bytes.size() % sizeof(T) != 0) stop(name, "has another length");
      values.resize(from.bytes.size() / sizeof(T));
    } else {
      make(name, type, 1, values.size() * sizeof(T));
    }
    copy(name, reinterpret_cast<std::byte*>(values.data()));
  }
  void copy(const std::string& name, std::byte* values);

  SavedState& state_;
  bool loading_;
  std::string prefix_;
  std::map<std::string, bool> asked_;  // paths
};

}  // namespace courant
