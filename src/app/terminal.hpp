#pragma once
// Lines on standard output beside a status line that is written over and over.
#include <functional>
#include <string>
#include <string_view>

namespace courant {

/// Writes to standard output. Where nobody reads any more (a pipe whose reader has ended) the text is lost,
/// and nothing else.
void print_text(std::string_view text);
/// Prints a line; on a terminal it takes the place of the status line.
void print_line(const std::string& line);
/// Shows a status line; empty where standard output is no terminal.
std::function<void(const std::string&)> status_line();
/// Whether somebody may type.
bool keyboard_is_terminal();
/// Takes the status line away.
void clear_status_line();

}  // namespace courant
