#!/usr/bin/env bash
# The seven tests of De Padova, Mossa and Sibilla (2017), jumps at an abrupt drop: installs what is missing, builds, runs them by one setting and test T1 by others, evaluates, and
# writes docs/abrupt_drop_paper.md with its figures. Stopped by Ctrl-C or killed, it goes on where it was when called again.
#   bash examples/abrupt_drop/paper.sh [--jobs N] [--threads N] [--only NAME,...] [--study] [--results FOLDER] [--page FILE] [--quick]
#   bash examples/abrupt_drop/paper.sh --help
set -uo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/../lib/setup.sh"
script=$project/examples/abrupt_drop/paper.py
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
need_space "$project" 4000 "the results of all runs"
exec "$python" "$script" --courant "$build/courant" "$@"
