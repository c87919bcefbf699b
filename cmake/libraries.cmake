# SPDX-License-Identifier: Apache-2.0
# The libraries of others, for Strake's own build and, installed beside its configuration, for who links it.

# strake_find_library(NAME)
# Makes the target NAME::NAME, under this one name whichever package brings the library. Some packages
# have no CMake description (Debian 12's RE2 and zstd), one that does not work (its libzip asks for the
# programs of another package) or another name for the target. Where there is no such library there is
# no target: who calls this says what that means.
function(strake_find_library name)
  set(agg_header agg2/agg_rasterizer_scanline_aa.h)
  # Compiled so that it may end up in a shared library (Debian: libagg_pic), or as it is.
  set(agg_names agg_pic agg)
  set(libzip_header zip.h)
  set(libzip_names zip)
  set(meshoptimizer_header meshoptimizer.h)
  set(microhttpd_header microhttpd.h)
  set(re2_header re2/re2.h)
  set(sqlite3_header sqlite3.h)
  set(zlib_header zlib.h)
  set(zlib_names z)
  set(zstd_header zstd.h)
  if(NOT DEFINED ${name}_header)
    find_package(${name} QUIET)
    return()
  endif()
  # Libraries that it links besides are named in its own description alone.
  if(name STREQUAL "re2")
    find_package(re2 CONFIG QUIET)
  endif()
  if(TARGET ${name}::${name})
    return()
  endif()
  string(TOUPPER ${name} var)
  find_path(${var}_INCLUDE_DIR ${${name}_header})
  if(NOT DEFINED ${name}_names)
    set(${name}_names ${name})
  endif()
  find_library(${var}_LIBRARY NAMES ${${name}_names})
  mark_as_advanced(${var}_INCLUDE_DIR ${var}_LIBRARY)
  if(${var}_INCLUDE_DIR AND ${var}_LIBRARY)
    add_library(${name}::${name} UNKNOWN IMPORTED)
    set_target_properties(${name}::${name} PROPERTIES
      IMPORTED_LOCATION ${${var}_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${${var}_INCLUDE_DIR})
  endif()
endfunction()

# strake_require_library(NAME title package)
# The same; stops where there is none, and names the package of Debian that has it.
function(strake_require_library name title package)
  strake_find_library(${name})
  if(NOT TARGET ${name}::${name})
    message(FATAL_ERROR "${title} is not found: install its headers and library (Debian: ${package})")
  endif()
endfunction()
