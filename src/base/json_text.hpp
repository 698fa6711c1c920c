#pragma once
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "base/real.hpp"
#include "base/utf8.hpp"

namespace courant {

/// Writes JSON from the outside in; commas and indents come by themselves.
class JsonText {
 public:
  void open(const char* key, char bracket) {
    begin(key);
    out_ += bracket;
    closing_ += bracket == '{' ? '}' : ']';
    empty_ = true;
  }
  void close() {
    const char bracket = closing_.back();
    closing_.pop_back();
    if (!empty_) new_line();
    out_ += bracket;
    empty_ = false;
  }
  void text(const char* key, std::string_view value) { put(key, quoted(value)); }
  void flag(const char* key, bool value) { put(key, value ? "true" : "false"); }
  template <class T>
  void whole(const char* key, T value) {
    put(key, fmt::format("{}", value));
  }
  /// Numbers that are none, or that a part does not have, are null.
  void number(const char* key, Real value, Real none = std::numeric_limits<Real>::quiet_NaN()) {
    put(key, std::isfinite(value) && value != none ? fmt::format("{}", value) : "null");
  }
  std::string take() { return std::move(out_) + "\n"; }

 private:
  static std::string quoted(std::string_view value) {
    std::string out = "\"";
    for (const char c : valid_utf8(value)) {
      if (c == '"' || c == '\\')
        out += fmt::format("\\{}", c);
      else if (static_cast<unsigned char>(c) < ' ')
        out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
      else
        out += c;
    }
    return out + '"';
  }
  void new_line() { out_ += "\n" + std::string(2 * closing_.size(), ' '); }
  void begin(const char* key) {
    if (!empty_) out_ += ',';
    if (!closing_.empty()) new_line();
    if (key) out_ += quoted(key) + ": ";
    empty_ = false;
  }
  void put(const char* key, const std::string& value) {
    begin(key);
    out_ += value;
  }

  std::string out_, closing_;
  bool empty_ = true;  ///< nothing is written behind the last bracket yet
};

}  // namespace courant
