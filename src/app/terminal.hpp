#pragma once
// Lines on standard output beside a status line that is written over and over.
#include <functional>
#include <string>
#include <string_view>

namespace courant {

/// Writes to standard output. Without a reader (a pipe whose reader has ended) the text is lost, and nothing
/// else.
void print_text(std::string_view text);
/// Prints a line; on a terminal it replaces the status line.
void print_line(const std::string& line);
/// Shows a status line; empty where standard output is no terminal.
std::function<void(const std::string&)> status_line();
/// When a line about progress is due where lines stay, as in a file: after 5 s, then after 10, 20, 40 and
/// every 60 s, so that short runs print nothing and a day's run some thousand lines.
class ProgressTimes {
 public:
  /// Whether one is due so many seconds after the start; the next is then later.
  bool take(double seconds);

 private:
  double next_ = 5, gap_ = 10;  ///< [s]
};
/// Shows a status line now and then as a line of its own.
std::function<void(const std::string&)> progress_lines();
/// Whether the terminal accepts input.
bool keyboard_is_terminal();
/// Takes the status line away.
void clear_status_line();

}  // namespace courant
