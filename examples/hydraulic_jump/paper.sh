#!/usr/bin/env bash
# Every number and figure of Jonsson et al. (2016): installs what is missing, builds, runs the paper's four cases, evaluates them, and
# writes docs/hydraulic_jump_paper.md with its figures; --standing: jumps that stand still, docs/hydraulic_jump_standing.md; --study: each option and number
# of the deck in turn, docs/hydraulic_jump_study.md. Stopped by Ctrl-C or killed, it goes on where it was when called again.
#   bash examples/hydraulic_jump/paper.sh [--threads N] [--only NAME,...] [--paper-setting] [--standing] [--study] [--results FOLDER] [--page FILE] [--quick]
#   bash examples/hydraulic_jump/paper.sh --help
set -uo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/../lib/setup.sh"
script=$project/examples/hydraulic_jump/paper.py
python=/usr/bin/python3  # Debian's, which has yaml; another one in PATH may not
[ -x "$python" ] || python=python3
for word in "$@"; do
  case $word in
    -h | --help) sed -n '3,/^"""$/p' "$script" | sed '$d'; exit 0 ;;
  esac
done

install_packages "${build_packages[@]}" "${picture_packages[@]}" python3-yaml
(cd "$project" || exit 1
  options=()
  [ -f "$build/CMakeCache.txt" ] || options=(-DCOURANT_TESTS=OFF)
  configure "${options[@]}"
  build_targets courant) || exit 1
need_space "$project" 8000 "the results of all runs"
exec "$python" "$script" --courant "$build/courant" "$@"
