#!/usr/bin/env bash
# From a bare Debian 12 to a computed hydraulic jump: installs what is missing, builds, runs, tabulates, makes pictures.
#   bash examples/hydraulic_jump/run.sh [--threads N]
set -uo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/../lib/setup.sh"
threads=$(nproc)
while [ $# -gt 0 ]; do
  case $1 in
    --threads) threads=${2:?--threads needs a number}; shift 2 ;;
    *) stop "unknown option '$1'." "usage: bash examples/hydraulic_jump/run.sh [--threads N]" ;;
  esac
done

scene=keyword_decks/hydraulic_jump
results=results/hydraulic_jump
cd "$project" || stop "the folder $project cannot be entered."

install_packages "${build_packages[@]}" "${picture_packages[@]}"
options=()
[ -f "$build/CMakeCache.txt" ] || options=(-DCOURANT_TESTS=OFF "-DCOURANT_LEAVE_OUT=$(other_instruction_sets)")
configure "${options[@]}"
build_targets courant

up_to_date() {  # results of a complete run, younger than everything they were made from
  local file
  grep -qE '^termination: *"?normal' "$results/summary.yaml" 2>/dev/null || return 1
  for file in "$scene/d4_5s.k" "$build/courant" "$build"/libcourant.so; do
    [ "$results/summary.yaml" -nt "$file" ] || return 1
  done
}

if up_to_date; then
  say "The results in $results are up to date; remove the folder to run again."
else
  need_space "$project" 700 "the run's results"
  say "Running $scene/d4_5s.k (6 880 particles, 5 s of flow; a quarter of a minute on one core)"
  "$build/courant" run "$scene/d4_5s.k" -o "$results" --threads "$threads" ||
    stop "the run did not end normally; its messages are above and in $results/messag."
fi

"$build/courant" post "$scene/post.yaml" "$results" || stop "the results could not be evaluated; the messages are above."

say ""
say "Pictures: $results/*.png   table: $results/results.yaml   summary: $results/summary.yaml"
say "In ParaView: open $results/fields.pvd, press Apply, colour by 'velocity', press Play."
command -v paraview >/dev/null || say "ParaView is not installed: apt-get install paraview"
