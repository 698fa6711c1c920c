#pragma once

namespace courant {

/// Normal, the input is wrong, the run ended in error or is broken, anything else.
enum ExitCode { exit_ok = 0, exit_input = 1, exit_run = 2, exit_other = 3 };

/// The command line, section by section in `courant help`. Returns an ExitCode.
int command_line(int argc, char** argv);

}  // namespace courant
