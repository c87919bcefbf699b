# SPDX-License-Identifier: Apache-2.0
option(STRAKE_TESTS "Build the tests" ON)
option(STRAKE_SLOW_TESTS "Build the nightly oracles too (CGAL, long fuzzing)" OFF)
option(STRAKE_BENCHMARKS "Build the benchmarks" OFF)
option(STRAKE_FUZZERS "Build the libFuzzer targets (Clang only)" OFF)
option(STRAKE_ONLY_PARALLEL "Build strake::parallel and nothing else: needs no other package" OFF)
option(STRAKE_PYTHON "Build the Python package (nanobind)" OFF)
option(STRAKE_STEP "Build the importer of STEP and IGES (Open CASCADE 7.6)" OFF)
option(STRAKE_VIEWER "Build and test the page that HTML reports are made of, where Node is found" OFF)
option(BUILD_SHARED_LIBS "Make shared libraries" OFF)
# For who works on the sources: another compiler than ours warns of more, which must not keep anyone
# from a build.
option(STRAKE_WARNINGS "Warnings, as errors" OFF)
# Shows who looks at an order that standard libraries leave open (decision 0123).
option(STRAKE_OTHER_ORDER "Leave another order where no result may depend on it, so that tests fail where one does" OFF)
set(STRAKE_SANITIZE "" CACHE STRING "Sanitizers, as -fsanitize takes them")

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

find_program(STRAKE_CCACHE ccache)
if(STRAKE_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${STRAKE_CCACHE})
endif()

# Properties of every target of ours. No contraction of a*b+c: results must not depend on the
# compiler's choice to fuse.
add_library(strake_flags INTERFACE)
target_compile_options(strake_flags INTERFACE
  -ffp-contract=off
  # GCC 12's std::stable_sort uses what it deprecates itself; Clang blames its caller.
  $<$<CXX_COMPILER_ID:Clang>:-Wno-deprecated-declarations>)
if(STRAKE_WARNINGS)
  target_compile_options(strake_flags INTERFACE
    -Werror -Wall -Wextra -Wconversion -Wsign-conversion -Wnon-virtual-dtor -Woverloaded-virtual
    -Wcast-align -Wundef
    # In a unity build Clang takes the hidden constant of another source for shadowed by a local one.
    $<$<NOT:$<AND:$<BOOL:${STRAKE_UNITY}>,$<CXX_COMPILER_ID:Clang>>>:-Wshadow>
    # GCC 12 sees an overlap in "text" + std::string that cannot happen (GCC bug 105651).
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
endif()
if(STRAKE_OTHER_ORDER)
  target_compile_definitions(strake_flags INTERFACE STRAKE_OTHER_ORDER)
endif()
if(STRAKE_SANITIZE)
  target_compile_options(strake_flags INTERFACE
    -fsanitize=${STRAKE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(strake_flags INTERFACE -fsanitize=${STRAKE_SANITIZE})
endif()
if(STRAKE_FUZZERS)
  # Coverage feedback in all code: a fuzzer that sees only its own five lines searches blindly.
  target_compile_options(strake_flags INTERFACE -fsanitize=fuzzer-no-link)
  target_link_options(strake_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()
