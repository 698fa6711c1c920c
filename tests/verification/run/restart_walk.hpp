#pragma once
// Every number that a restart keeps, changed one at a time: does what comes after differ?
#include <algorithm>
#include <set>

#include "base/restart_error.hpp"
#include "base/run_error.hpp"
#include "same_bits.hpp"

namespace courant::test {

/// Other numbers of the same kind: indices and flags become 0 or one more, reals grow by a tenth and a bit.
inline void change(SavedArray& array) {
  std::byte* const bytes = array.bytes.data();
  const auto each = [&](auto zero, const auto& other) {
    for (std::size_t k = 0; k < array.count(); ++k) {
      decltype(zero) value;
      std::memcpy(&value, bytes + k * sizeof value, sizeof value);
      value = other(value);
      std::memcpy(bytes + k * sizeof value, &value, sizeof value);
    }
  };
  switch (array.type) {
    case SavedType::real:
      return each(Real(0), [](Real x) { return 1.1 * x + 1e-6; });
    case SavedType::integer64:
      return each(std::int64_t(0), [](std::int64_t n) { return n == 0 ? 1 : n - 1; });
    case SavedType::integer32:
      return each(std::int32_t(0), [](std::int32_t n) { return n == 0 ? 1 : n - 1; });
    case SavedType::byte:
      return each(char(0), [](char c) { return static_cast<char>(c == 0 ? 1 : 0); });
  }
}

/// Names without "state/" whose change, in the state at some of these times, is noticed: by the reader, the
/// run, fields, what histories print or the state at the end; and those whose change is not.
struct Walked {
  std::set<std::string> noticed, unnoticed;
};
inline Walked walk(const std::string& deck, const std::vector<int>& saved_at, int steps) {
  Walked out;
  std::set<std::string> all;
  for (const int at : saved_at) {
    auto s = simulation_of(deck);
    for (int k = 0; k < at; ++k) s->step(do_nothing);
    const SavedState saved = saved_state(*s);
    const WholeState reference = state_after(*s, steps);
    for (const auto& [path, array] : saved) {
      const std::string name = path.substr(std::string("state/").size());
      if (array.bytes.empty() || out.noticed.contains(name)) continue;
      all.insert(name);
      SavedState other = saved;
      change(other.at(path));
      try {
        if (!differences(reference, state_after_restart(deck, std::move(other), steps)).empty())
          out.noticed.insert(name);
      } catch (const RestartError&) {
        out.noticed.insert(name);
      } catch (const RunError&) {
        out.noticed.insert(name);
      }
    }
  }
  std::set_difference(all.begin(), all.end(), out.noticed.begin(), out.noticed.end(),
                      std::inserter(out.unnoticed, out.unnoticed.end()));
  return out;
}

}  // namespace courant::test
