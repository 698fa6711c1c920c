#!/usr/bin/env bash
# The seven tests of De Padova, Mossa and Sibilla (2017), jumps at an abrupt drop: installs what is missing, builds, runs them by one setting and test T1 by others, evaluates, and
# writes docs/abrupt_drop_paper.md with its figures. Stopped by Ctrl-C or killed, it goes on where it was when called again.
#   bash examples/abrupt_drop/paper.sh [--jobs N] [--threads N] [--only NAME,...] [--study] [--results FOLDER] [--page FILE] [--quick]
#   bash examples/abrupt_drop/paper.sh --help
set -uo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/../lib/setup.sh"
run_paper "$project/examples/abrupt_drop/paper.py" 4000 "$@"
