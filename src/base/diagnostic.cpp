#include "base/diagnostic.hpp"

#include <fmt/format.h>

namespace courant {

std::string Diagnostic::text() const {
  std::string out;
  if (!where.file.empty()) {
    out += where.file;
    if (where.line > 0) out += fmt::format(":{}", where.line);
    if (where.column > 0) out += fmt::format(":{}", where.column);
    out += ": ";
  }
  const char* word[] = {"note", "warning", "error"};
  out += fmt::format("{}: {}", word[static_cast<int>(severity)], message);
  if (!where.included_from.empty()) out += "\n  included from " + where.included_from;
  if (!hint.empty()) out += "\n  hint: " + hint;
  return out;
}

void Diagnostics::add(Diagnostic diagnostic) {
  if (diagnostic.severity == Severity::error) ++errors_;
  if (diagnostic.severity == Severity::warning) ++warnings_;
  all_.push_back(std::move(diagnostic));
}

void Diagnostics::error(Location where, std::string message, std::string hint) {
  add({Severity::error, std::move(where), std::move(message), std::move(hint)});
}

void Diagnostics::warning(Location where, std::string message, std::string hint) {
  add({Severity::warning, std::move(where), std::move(message), std::move(hint)});
}

void Diagnostics::note(Location where, std::string message, std::string hint) {
  add({Severity::note, std::move(where), std::move(message), std::move(hint)});
}

std::string Diagnostics::text() const {
  std::string out;
  for (const Diagnostic& d : all_) out += d.text() + "\n";
  return out;
}

}  // namespace courant
