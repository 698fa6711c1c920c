#!/usr/bin/env bash
# From a bare Debian 12 to tested: installs what is missing, builds, runs every test. The last line: N passed, N failed, N skipped.
#   bash tests/run.sh [--quick] [--warnings-as-errors] [--again] [options of ctest, such as -R NAME]
# --quick leaves out the tests of tests/slow_tests.txt: some two minutes on two cores instead of ten.
# When nothing has changed since all tests passed here, it says so and stops; --again runs them all the same.
set -uo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/../examples/lib/setup.sh"
options=(-DCOURANT_TESTS=ON)
again=${CI:-}
quick=
while true; do
  case ${1:-} in
    --warnings-as-errors) options+=(-DCOURANT_WARNINGS_AS_ERRORS=ON); shift ;;
    --again) again=yes; shift ;;
    --quick) quick=yes; shift ;;
    *) break ;;
  esac
done
cd "$project" || stop "the folder $project cannot be entered."

[ -z "$quick" ] || set -- -E "$(paste -sd'|' tests/slow_tests.txt)" "$@"
install_packages "${build_packages[@]}" "${picture_packages[@]}" "${test_packages[@]}"
settled=yes  # configure again only if something changes
for option in "${options[@]}"; do
  name=${option#-D}
  grep -qs "^${name%%=*}:BOOL=ON" "$build/CMakeCache.txt" || settled=no
done
if grep -qs '^COURANT_LEAVE_OUT:STRING=.' "$build/CMakeCache.txt"; then  # the example builds fewer loops: tests compare all sets that run here
  options+=(-DCOURANT_LEAVE_OUT=)
  settled=no
fi
if [ $settled = yes ]; then configure; else configure "${options[@]}"; fi
build_targets

passed=$logs/tests.passed  # the closing line of the last run in which every test passed
if [ -z "$again" ] && [ $# -eq 0 ] && [ -f "$passed" ] &&
  [ -z "$(find src cmake tests keyword_decks examples docs CMakeLists.txt README.md "$build"/courant "$build"/libcourant.so \
    "$build"/tests/*_tests -newer "$passed" -type f -not -path '*/__pycache__*' -print -quit)" ]; then
  say "Nothing has changed since all tests passed here ($(date -r "$passed" '+%F %T')); --again runs them."
  cat "$passed"
  exit 0
fi

# Only what failed is printed, and a count now and then.
show_tests() {
  awk '/^ *Start +[0-9]+:/ || /^Test project/ || /^Internal ctest/ {next}
       /Test +#[0-9]+:.* Passed / {if (++done % 50 == 0) {print "  " done " tests passed"; fflush()} next}
       {print; fflush()}'
}
say "Testing"
ctest --test-dir "$build" --parallel "$(nproc)" --output-on-failure --no-tests=error --timeout 600 "$@" 2>&1 |
  tee "$logs/tests.log" | show_tests
status=${PIPESTATUS[0]}

summary=$(grep -E 'tests passed, [0-9]+ tests? failed out of [0-9]+' "$logs/tests.log" | tail -n 1)
[ -n "$summary" ] || stop "no test was run." "$(tail -n 1 "$logs/tests.log")"
failed=$(printf '%s' "$summary" | sed -E 's/.*passed, ([0-9]+) tests? failed out of.*/\1/')
total=$(printf '%s' "$summary" | sed -E 's/.*out of ([0-9]+).*/\1/')
skipped=$(grep -c '\*\*\*Skipped' "$logs/tests.log")  # ctest counts them as passed
closing=$(printf '%d passed, %d failed, %d skipped' $((total - failed - skipped)) "$failed" "$skipped")
printf '%s\n' "$closing"
[ "$failed" -eq 0 ] && [ "$status" -eq 0 ] || exit 1
[ $# -gt 0 ] || printf '%s\n' "$closing" >"$passed"
