# SPDX-License-Identifier: Apache-2.0
# Runs an example and compares what it prints with a stored file, byte for byte:
#   cmake -D PROGRAM=build/dev/bin/example_x -D EXPECTED=examples/expected/x.txt -P compare_output.cmake
execute_process(COMMAND ${PROGRAM} OUTPUT_VARIABLE printed RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} ended with ${status}; it printed\n${printed}")
endif()
file(READ ${EXPECTED} expected)
if(NOT "${printed}" STREQUAL "${expected}")
  message(FATAL_ERROR "${PROGRAM} printed\n${printed}where ${EXPECTED} has\n${expected}")
endif()
