#include "base/diagnostic.hpp"

#include <fmt/format.h>

#include "base/utf8.hpp"

namespace courant {

namespace {

/// Without control characters, which could act on a terminal, and cut where it is too long to read. Text of
/// several lines (what another program said) keeps all of them.
void make_presentable(std::string& text) {
  const bool several_lines = text.find('\n') != std::string::npos;
  if (!several_lines && text.size() > Diagnostics::longest_text)
    text = std::string(cut_utf8(text, Diagnostics::longest_text)) + "...";
  text = without_controls(text);
}

}  // namespace

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
  if (diagnostic.severity == Severity::error) ++errors_, contained_ += diagnostic.contained;
  if (diagnostic.severity == Severity::warning && ++warnings_ > max_warnings) {
    if (warnings_ == max_warnings + 1) {
      note_of_more_ = all_.size();
      all_.push_back({Severity::note, {diagnostic.where.file, 0, 0}, "", "", false});
    }
    const int more = warnings_ - max_warnings;
    all_[note_of_more_].message = more == 1 ? std::string("1 more warning is not shown")
                                            : fmt::format("{} more warnings are not shown", more);
    return;
  }
  make_presentable(diagnostic.where.file);
  make_presentable(diagnostic.where.included_from);
  make_presentable(diagnostic.message);
  make_presentable(diagnostic.hint);
  all_.push_back(std::move(diagnostic));
}

void Diagnostics::error(Location where, std::string message, std::string hint) {
  add({Severity::error, std::move(where), std::move(message), std::move(hint), false});
}

void Diagnostics::warning(Location where, std::string message, std::string hint) {
  add({Severity::warning, std::move(where), std::move(message), std::move(hint), false});
}

void Diagnostics::note(Location where, std::string message, std::string hint) {
  add({Severity::note, std::move(where), std::move(message), std::move(hint), false});
}

std::string Diagnostics::text() const {
  std::string out;
  for (const Diagnostic& d : all_) out += d.text() + "\n";
  return out;
}

}  // namespace courant
