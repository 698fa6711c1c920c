#!/usr/bin/env bash
# The whole product under AddressSanitizer and UndefinedBehaviorSanitizer, with the loops of every instruction set: unit tests and crafted
# inputs for each set that this machine runs, verification tests, fuzzers of the readers. By hand, not in each run of the tests: the build
# takes half an hour of two cores. With clang and without optimisation: instrumented loops then compile in seconds, which take g++ minutes.
# The last line counts.
#
# usage: tests/sanitizers.sh [STEP]...   STEP: build, unit, crafted, readers, verification; all if none is given
#   INPUTS=500   crafted inputs for each instruction set
#   QUICK=60     seconds after which a verification test is left out, and counted as skipped
set -uo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/../examples/lib/setup.sh"
build=$project/build/sanitized
mkdir -p "$logs"
[ $# -gt 0 ] || set -- build unit crafted readers verification
flags='-O0 -g1 -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=undefined'
export OMP_NUM_THREADS=2 OMP_WAIT_POLICY=passive
sets=(baseline)
grep -qw avx2 /proc/cpuinfo && sets+=(avx2)
grep -qw avx512vl /proc/cpuinfo && sets+=(avx512)
passed=0 failed=0 skipped=0

count() {  # status, what ran, log
  if [ "$1" -eq 0 ]; then
    passed=$((passed + 1))
    say "passed   $2"
  else
    failed=$((failed + 1))
    say "FAILED   $2: $3"
    tail -n 40 "$3"
  fi
}

count_tests() {  # what ran, its status, log of googletest
  local good bad
  good=$(grep -c '^\[       OK \]' "$3") bad=$(grep -cE '^\[  FAILED  \] .*\([0-9]+ ms\)$' "$3")
  [ "$2" -eq 0 ] || [ "$bad" -gt 0 ] || bad=1  # a finding ends the program in the middle of a test
  passed=$((passed + good)) failed=$((failed + bad))
  say "$1: $good passed, $bad failed"
  [ "$2" -eq 0 ] || grep -hE 'ERROR: AddressSanitizer|runtime error:|^\[  FAILED  \]|Failure$' "$3" | sort -u | head -n 40
}

step_build() {
  configure -DCMAKE_C_COMPILER=clang-14 -DCMAKE_CXX_COMPILER=clang++-14 -DCMAKE_BUILD_TYPE=None -DCOURANT_TESTS=ON \
    -DCOURANT_UNITY=ON -DCOURANT_PRECOMPILED_HEADERS=OFF "-DCMAKE_CXX_FLAGS=$flags" -DCOURANT_INSTRUMENT_ALL=ON
  ninja -C "$build" -j "$(parallel_jobs)" -k 0 courant unit_tests verification_tests fuzz_replay fuzz_readers
}

step_unit() {
  local set log
  for set in "${sets[@]}"; do
    log=$logs/sanitized_unit_$set.log
    COURANT_SIMD=$set "$build/tests/unit_tests" >"$log" 2>&1
    count_tests "unit tests, $set" $? "$log"
  done
}

step_crafted() {
  local set log seed=1
  for set in "${sets[@]}"; do
    log=$logs/sanitized_crafted_$set.log
    COURANT_SIMD=$set python3 "$project/tests/fuzz/crafted.py" "$build/courant" "$project" "$build/crafted_$set" "${INPUTS:-500}" $seed >"$log" 2>&1
    count $? "$(tail -n 1 "$log"), $set" "$log"
    seed=$((seed + 1))
  done
}

step_readers() {
  local deck name results=$build/results log=$logs/sanitized_readers.log
  local decks=("$project"/tests/fuzz/seeds "$project"/tests/decks/{accept,reject,warn,base})
  "$build/tests/fuzz/fuzz_replay" --seconds 60 --limit 60 "${decks[@]}" >"$log" 2>&1
  count $? "decks changed at random" "$log"
  for deck in fuzz/results decks/accept/whole_histories; do
    "$build/courant" run "$project/tests/$deck.k" -o "$results/${deck##*/}" --quiet >"$log" 2>&1 || count 1 "run of $deck" "$log"
  done
  "$build/tests/fuzz/fuzz_readers" --seconds 5 --limit 20 "$project" "$results/results" "$results/whole_histories" >"$log" 2>&1
  count $? "files of other readers changed at random" "$log"
}

step_verification() {
  local test log=$logs/sanitized_verification.log status
  for test in $("$build/tests/verification_tests" --gtest_list_tests | awk '/^[^ ]/ {suite = $1} /^ / {print suite $1}'); do
    OMP_NUM_THREADS=1 timeout "${QUICK:-60}" "$build/tests/verification_tests" --gtest_filter="$test" >"$log" 2>&1
    status=$?
    if [ "$status" -eq 124 ]; then
      skipped=$((skipped + 1))
      say "left out $test"
    else
      count "$status" "$test" "$log"
    fi
  done
}

for step in "$@"; do "step_$step" || failed=$((failed + 1)); done
printf '%d passed, %d failed, %d skipped\n' "$passed" "$failed" "$skipped"
[ "$failed" -eq 0 ]
