#pragma once
// Numbers of one state of a history: arrays in folders by the names of LS-DYNA's binout, and the rows of
// datasets of history.h5 with the same values.
#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/real.hpp"

namespace courant {

struct HistoryArray {
  std::string name;
  std::variant<std::vector<Real>, std::vector<std::int64_t>, std::string> values;
};

/// A folder of binout inside the folder of the history; "": the folder of the history.
struct HistoryFolder {
  std::string name{};
  std::vector<HistoryArray> fixed{};  ///< written once, as `metadata`
  std::vector<HistoryArray> state{};
};

/// One row of a dataset of history.h5.
struct HistoryValue {
  std::string path;       ///< "/joints/3/force"
  std::string dimension;  ///< in M, L, T
  std::vector<Real> components;
};

struct HistoryNumbers {
  std::vector<HistoryFolder> folders{};
  std::vector<HistoryValue> values{};
  std::vector<std::pair<std::string, std::string>> titles{};  ///< of groups of history.h5

  HistoryFolder& folder(const std::string& name = "") {
    const auto found = std::find_if(folders.begin(), folders.end(),
                                    [&](const HistoryFolder& one) { return one.name == name; });
    if (found != folders.end()) return *found;
    folders.push_back({name});
    return folders.back();
  }
  /// A number of the whole state.
  void real(const char* name, Real value, const std::string& in = "") {
    folder(in).state.push_back({name, std::vector<Real>{value + 0.0}});
  }
};

/// Arrays with one value for each entity of a list, which must outlive the call. `Of` below: a member or a
/// function of an entity.
template <class List>
class HistoryRows {
 public:
  /// `group`: of history.h5, which gets a group for each entity; "": binout only. `ids`: name of the ids in
  /// `metadata`. An empty list adds no folder.
  template <class Of>
  HistoryRows(HistoryNumbers& to, std::string folder, const List& list, const Of& id, std::string group = "",
              const char* ids = "ids")
      : to_(to), folder_(std::move(folder)), list_(list), group_(std::move(group)) {
    for (const auto& one : list_) ids_.push_back(std::invoke(id, one));
    fixed(ids, id);
  }
  /// Integers that stay the same over the states.
  template <class Of>
  HistoryRows& fixed(const char* name, const Of& of) {
    if (!list_.empty()) to_.folder(folder_).fixed.push_back({name, integers(of)});
    return *this;
  }
  template <class Of>
  HistoryRows& integer(const char* name, const Of& of) {
    if (!list_.empty()) to_.folder(folder_).state.push_back({name, integers(of)});
    return *this;
  }
  /// Titles of the groups of history.h5.
  template <class Of>
  HistoryRows& title(const Of& of) {
    std::size_t row = 0;
    for (const auto& one : list_) to_.titles.emplace_back(path(row++), std::invoke(of, one));
    return *this;
  }
  /// `dimension`: in M, L, T, where history.h5 gets it under the same name; "": binout only.
  template <class Of>
  HistoryRows& real(const std::string& name, const Of& of, const char* dimension = "") {
    add(name, [&](const auto& one) -> Real { return std::invoke(of, one); });
    std::size_t row = 0;
    for (const auto& one : list_) value(row++, name, dimension, {std::invoke(of, one)});
    return *this;
  }
  /// `form`: "{}_force" for x_force, y_force, z_force, and `force` in history.h5.
  template <class Of>
  HistoryRows& vector(const std::string& form, const Of& of, const char* dimension = "") {
    const std::size_t at = form.find("{}");
    for (int k = 0; k < 3; ++k)
      add(std::string(form).replace(at, 2, 1, "xyz"[k]),
          [&](const auto& one) -> Real { return Vec(std::invoke(of, one))[k]; });
    std::size_t row = 0;
    for (const auto& one : list_) {
      const Vec v = std::invoke(of, one);
      value(row++, form.substr(std::min(form.size(), at + 3)), dimension, {v[0], v[1], v[2]});
    }
    return *this;
  }
  /// A row of history.h5 of the entity `row` of the list.
  void value(std::size_t row, const std::string& name, const char* dimension, std::vector<Real> components) {
    if (group_.empty() || *dimension == '\0') return;
    for (Real& one : components) one += 0.0;  // no -0
    to_.values.push_back({path(row) + "/" + name, dimension, std::move(components)});
  }

 private:
  std::string path(std::size_t row) const { return "/" + group_ + "/" + std::to_string(ids_[row]); }
  template <class Of>
  std::vector<std::int64_t> integers(const Of& of) const {
    std::vector<std::int64_t> out;
    for (const auto& one : list_) out.push_back(static_cast<std::int64_t>(std::invoke(of, one)));
    return out;
  }
  template <class Of>
  void add(const std::string& name, const Of& of) {
    std::vector<Real> out;
    for (const auto& one : list_) out.push_back(of(one) + 0.0);  // no -0
    if (!list_.empty()) to_.folder(folder_).state.push_back({name, std::move(out)});
  }

  HistoryNumbers& to_;
  std::string folder_;
  const List& list_;
  std::string group_;
  std::vector<std::int64_t> ids_;
};

}  // namespace courant
