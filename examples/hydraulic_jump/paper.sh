#!/usr/bin/env bash
# Every number and figure of Jonsson et al. (2016): installs what is missing, builds, runs the paper's four cases, evaluates them, and
# writes docs/hydraulic_jump_paper.md with its figures; --standing: jumps that stand still, docs/hydraulic_jump_standing.md; --study: each option and number
# of the deck in turn, docs/hydraulic_jump_study.md. Stopped by Ctrl-C or killed, it goes on where it was when called again.
#   bash examples/hydraulic_jump/paper.sh [--threads N] [--only NAME,...] [--paper-setting] [--standing] [--study] [--results FOLDER] [--page FILE] [--quick]
#   bash examples/hydraulic_jump/paper.sh --help
set -uo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/../lib/setup.sh"
run_paper "$project/examples/hydraulic_jump/paper.py" 8000 "$@"
