#pragma once
#include "app/run_deck.hpp"

namespace courant {

/// The command line, section by section in `courant help`. Returns an ExitCode.
int command_line(int argc, char** argv);

}  // namespace courant
