#!/usr/bin/env bash
# The product under AddressSanitizer and UndefinedBehaviorSanitizer: unit tests and crafted inputs with the loops of every instruction set
# that this machine runs, fuzzers of the readers, verification tests. With clang and without optimisation: instrumented loops then compile
# in seconds, which take g++ minutes. The last line counts.
#
# usage: tests/sanitizers.sh [--quick] [STEP]...   STEP: build, unit, crafted, readers, verification; all if none is given
#   --quick      what every change must pass: plain loops, passes held to what they declare, readers of files, and the unit tests that run
#                whole decks or read files, without the longest; ten minutes of two cores instead of hours
#   INPUTS=500   crafted inputs for each instruction set
#   LONGEST=60   seconds after which a verification test is left out, and counted as skipped
set -uo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/../examples/lib/setup.sh"
quick=
[ "${1:-}" != --quick ] || { quick=yes; shift; }
mkdir -p "$logs"
case $(other_instruction_sets) in
  avx2) sets=(baseline avx2 avx512) ;;
  avx512) sets=(baseline avx2) ;;
  *) sets=(baseline) ;;
esac
flags='-O0 -g1 -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=undefined'
options=(-DCOURANT_INSTRUMENT_ALL=ON)
targets=(unit_tests fuzz_replay fuzz_readers courant)
export OMP_NUM_THREADS=2 OMP_WAIT_POLICY=passive
echo 'leak:libomp.so' >"$logs/leaks_of_others"  # what clang's OpenMP keeps of threads that have ended
export LSAN_OPTIONS=suppressions=$logs/leaks_of_others
if [ -n "$quick" ]; then
  build=$project/build/sanitized_quick
  # What AddressSanitizer finds by itself, or harms on no x86-64, is a quarter of the time of compiling.
  sets=(baseline) flags="${flags/-g1/-g0} -fno-sanitize=null,alignment,vptr,object-size"
  options+=(-DCOURANT_CHECK_ACCESSES=ON '-DCOURANT_LEAVE_OUT=avx2;avx512' '-DCOURANT_UNIT_TESTS=app;extension;keyword;model;output;time')
  [ $# -gt 0 ] || set -- build unit readers
  seconds=(20 1)
  # Minutes without optimisation; and those that choose loops without sanitizers, or a kernel other than the cubic spline.
  left_out=$(paste -sd: "$project/tests/long_when_sanitized.txt"):*/baseline:*/quadratic_spline:*/quartic_spline
  left_out+=:*/quintic_spline:*/Wendland_C2:*/Wendland_C4
else
  build=$project/build/sanitized
  [ $# -gt 0 ] || set -- build unit crafted readers verification
  targets+=(verification_tests)
  seconds=(60 5)
  left_out=
fi
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
  [ "$2" -eq 0 ] || tail -n 60 "$3"
}

step_build() {
  install_packages "${build_packages[@]}" "${test_packages[@]}" clang-14 libomp-14-dev
  # All but the quick build without precompiled headers, so that a missing include is seen; with them a third less time.
  configure -DCMAKE_C_COMPILER=clang-14 -DCMAKE_CXX_COMPILER=clang++-14 -DCMAKE_BUILD_TYPE=None -DCOURANT_TESTS=ON \
    -DCOURANT_UNITY=ON "-DCOURANT_PRECOMPILED_HEADERS=${quick:-no}" "-DCMAKE_CXX_FLAGS=$flags" "${options[@]}"
  build_targets "${targets[@]}"
}

step_unit() {  # for each set as many parts as there are cores, side by side, each with two threads that sleep while they wait
  local set part log parts running
  parts=$(nproc)
  for set in "${sets[@]}"; do
    running=()
    for ((part = 0; part < parts; part++)); do
      COURANT_SIMD=$set GTEST_TOTAL_SHARDS=$parts GTEST_SHARD_INDEX=$part "$build/tests/unit_tests" "--gtest_filter=-$left_out" \
        >"$logs/sanitized_unit_$set.$part.log" 2>&1 &
      running+=($!)
    done
    for ((part = 0; part < parts; part++)); do
      wait "${running[part]}"
      count_tests "unit tests, $set, part $((part + 1)) of $parts" $? "$logs/sanitized_unit_$set.$part.log"
    done
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
  local deck results=$build/results log=$logs/sanitized_readers.log
  local decks=("$project"/tests/fuzz/seeds "$project"/tests/decks/{accept,reject,warn,base})
  timeout 600 "$build/tests/fuzz/fuzz_replay" --seconds "${seconds[0]}" --limit 60 "${decks[@]}" >"$log" 2>&1
  count $? "decks changed at random" "$log"
  for deck in fuzz/results decks/accept/whole_histories; do
    "$build/courant" run "$project/tests/$deck.k" -o "$results/${deck##*/}" --quiet >"$log" 2>&1 || count 1 "run of $deck" "$log"
  done
  timeout 600 "$build/tests/fuzz/fuzz_readers" --seconds "${seconds[1]}" --limit 20 "$project" "$results/results" "$results/whole_histories" \
    >"$log" 2>&1
  count $? "files of other readers changed at random" "$log"
}

step_verification() {
  local test log=$logs/sanitized_verification.log status
  for test in $("$build/tests/verification_tests" --gtest_list_tests | awk '/^[^ ]/ {suite = $1} /^ / {print suite $1}'); do
    OMP_NUM_THREADS=1 timeout "${LONGEST:-60}" "$build/tests/verification_tests" --gtest_filter="$test" >"$log" 2>&1
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
