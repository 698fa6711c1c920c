# Runs the libFuzzer target for SECONDS, beginning with the decks in INPUTS. What it finds of interest is kept in
# BUILD/corpus for the next run.
file(MAKE_DIRECTORY ${BUILD}/corpus)
execute_process(COMMAND ${BUILD}/tests/fuzz/fuzz_reader -max_total_time=${SECONDS} -max_len=65536 -timeout=20 -rss_limit_mb=2048
                        -print_final_stats=1 -verbosity=1 ${BUILD}/corpus ${INPUTS}
                WORKING_DIRECTORY ${BUILD} RESULT_VARIABLE result)
if(result)
  message(FATAL_ERROR "the fuzzer found a fault: the input is a file crash-, leak-, oom-, slow- or timeout-* in ${BUILD}")
endif()
