#pragma once

namespace courant {

/// The command line, section by section in `courant help`. Returns the exit code: 0 normal, 1 the input is
/// wrong, 2 the run ended in error, 3 anything else.
int command_line(int argc, char** argv);

}  // namespace courant
