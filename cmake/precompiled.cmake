# SPDX-License-Identifier: Apache-2.0
# Headers of other projects that most sources include, read once instead of once a source. What is
# ours is left out: a change of it would rebuild everything. The sources include what they use all the
# same (clang-tidy sees them without).
option(STRAKE_PRECOMPILE "Precompile the headers of the standard library and of GoogleTest" ON)

set(STRAKE_STANDARD_HEADERS
  <algorithm> <array> <bit> <cmath> <cstddef> <cstdint> <filesystem> <functional> <limits> <map>
  <memory> <numeric> <optional> <span> <stop_token> <string> <string_view> <tuple> <unordered_map>
  <utility> <variant> <vector>)

# strake_precompile(TARGET GROUP [HEADERS header...] [LIBS library...])
# Precompiles the standard headers and those named for TARGET. Targets of one GROUP have the same
# flags and share what the first of them compiled.
function(strake_precompile target group)
  if(NOT STRAKE_PRECOMPILE)
    return()
  endif()
  cmake_parse_arguments(arg "" "" "HEADERS" ${ARGN})
  # What ccache needs to know a source again that includes a precompiled header.
  target_compile_options(${target} PRIVATE
    $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>
    "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
  get_property(first GLOBAL PROPERTY strake_precompiled_${group})
  if(first)
    target_precompile_headers(${target} REUSE_FROM ${first})
  else()
    set_property(GLOBAL PROPERTY strake_precompiled_${group} ${target})
    target_precompile_headers(${target} PRIVATE ${STRAKE_STANDARD_HEADERS} ${arg_HEADERS})
  endif()
endfunction()
