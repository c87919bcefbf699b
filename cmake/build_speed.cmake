# SPDX-License-Identifier: Apache-2.0
# Builds from nothing are quick by unity builds and precompiled headers (decision 0060; measured in decision 0076).
#
# Headers of other projects that most sources include, read once instead of once a source. What is
# ours is left out: a change of it would rebuild everything. The sources include what they use all the
# same (clang-tidy sees them without).
option(STRAKE_PRECOMPILE "Precompile the headers of the standard library and of GoogleTest" ON)

set(STRAKE_STANDARD_HEADERS
  <algorithm> <array> <bit> <cmath> <cstddef> <cstdint> <filesystem> <functional> <limits> <map>
  <memory> <numeric> <optional> <span> <stop_token> <string> <string_view> <tuple> <unordered_map>
  <utility> <variant> <vector>)

# strake_precompile(TARGET GROUP [HEADERS header...])
# Precompiles the standard headers and those named for TARGET. Targets of one GROUP have the same
# flags and share what the first of them compiled.
function(strake_precompile target group)
  # A shared library has a macro of its own, so that none could share what another compiled.
  if(NOT STRAKE_PRECOMPILE OR BUILD_SHARED_LIBS)
    return()
  endif()
  cmake_parse_arguments(arg "" "" "HEADERS" ${ARGN})
  # What ccache needs to know a source again that includes a precompiled header.
  target_compile_options(${target} PRIVATE
    $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>
    # GCC 12 shows warnings about the inside of precompiled headers that it hides where the same headers
    # are included, and is wrong about texts in them (GCC bug 105651).
    $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds>
    $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>
    $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overread>
    "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
  get_property(first GLOBAL PROPERTY strake_precompiled_${group})
  if(first)
    target_precompile_headers(${target} REUSE_FROM ${first})
  else()
    set_property(GLOBAL PROPERTY strake_precompiled_${group} ${target})
    target_precompile_headers(${target} PRIVATE ${STRAKE_STANDARD_HEADERS} ${arg_HEADERS})
  endif()
endfunction()

# strake_compile_quickly(TARGET [TEST]): in a release build, for what no loop of which is hot. A TEST is run
# once: -Og compiles it in four fifths of the time of -O1.
function(strake_compile_quickly target)
  # GCC follows values less far below -O2, and suspects some that are set.
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:$<IF:$<STREQUAL:${ARGN},TEST>,-Og,-O1>>
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
endfunction()

option(STRAKE_UNITY "Compile up to twenty sources at once: fastest from nothing, slowest after a change" OFF)

# strake_unite(TARGET): one compiler run for up to twenty sources, each for as many, so that none is
# waited for. What is hidden in a source must have a name of its own in its module therefore.
function(strake_unite target)
  get_target_property(sources ${target} SOURCES)
  list(LENGTH sources n)
  math(EXPR units "(${n} + 19) / 20")
  math(EXPR batch "(${n} + ${units} - 1) / ${units}")
  set_target_properties(${target} PROPERTIES
    UNITY_BUILD ${STRAKE_UNITY}
    UNITY_BUILD_BATCH_SIZE ${batch})
  if(STRAKE_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # A source's hidden types in its own classes are warned of in what a source includes alone.
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
    # GCC collects garbage from 128 MB on, where the larger runs hold several times that anyway.
    target_compile_options(${target} PRIVATE "SHELL:--param ggc-min-heapsize=524288")
  endif()
endfunction()

# strake_inline_fully(TARGET): GCC stops inlining where a run of it has grown by 40 %, which is sooner
# the more sources it has: clash detection took 7 % more instructions. 120 % is as good as no limit
# (decision 0060).
function(strake_inline_fully target)
  if(STRAKE_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    target_compile_options(${target} PRIVATE "SHELL:--param inline-unit-growth=120")
  endif()
endfunction()
