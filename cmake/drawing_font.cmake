# SPDX-License-Identifier: Apache-2.0
# The font of drawings that carry their letters with them (PDF), as bytes of the library, so that the
# program needs no file when it runs (decision 0079).
#
# As a script (cmake -D FONT=... -D OUT=... -P drawing_font.cmake) it writes the source that holds the
# bytes: a compiler takes a text of a megabyte in no time, and an array of as many numbers in seconds.
if(CMAKE_SCRIPT_MODE_FILE)
  file(READ ${FONT} bytes HEX)
  string(LENGTH "${bytes}" digits)
  math(EXPR size "${digits} / 2")
  string(REGEX REPLACE "(..)" "\\\\x\\1" bytes "${bytes}")
  file(WRITE ${OUT} "// Made from DejaVuSans.ttf by cmake/drawing_font.cmake.
#include \"drawing/lettering/font_data.hpp\"

namespace strake::drawing {
namespace {
constexpr char kFont[] = \"${bytes}\";
}
std::string_view font_data() { return {kFont, ${size}}; }
}  // namespace strake::drawing
")
  return()
endif()

find_file(STRAKE_DRAWING_FONT DejaVuSans.ttf
  PATHS /usr/share/fonts /usr/local/share/fonts
  PATH_SUFFIXES truetype/dejavu dejavu dejavu-sans-fonts TTF
  DOC "The font that drawings carry with them: DejaVu Sans 2.37")
mark_as_advanced(STRAKE_DRAWING_FONT)
if(NOT STRAKE_DRAWING_FONT)
  message(FATAL_ERROR "DejaVuSans.ttf is not found: install it (Debian: fonts-dejavu-core), or name it by "
    "-D STRAKE_DRAWING_FONT=FILE")
endif()
file(SHA256 ${STRAKE_DRAWING_FONT} hash)
if(NOT hash STREQUAL abdc775b21b1bc470d50c97e790d276f2054b7504e56e5bd3e64f48d68582322)
  message(WARNING "${STRAKE_DRAWING_FONT} is not DejaVu Sans 2.37 as Debian 12 has it: PDF files will have other "
    "bytes than those of other builds, and texts perhaps other widths than title blocks allow for")
endif()

# strake_drawing_font(SOURCE): sets SOURCE to the source that defines font_data().
function(strake_drawing_font source)
  set(made ${CMAKE_CURRENT_BINARY_DIR}/generated/font_data.cpp)
  add_custom_command(OUTPUT ${made}
    COMMAND ${CMAKE_COMMAND} -D FONT=${STRAKE_DRAWING_FONT} -D OUT=${made}
      -P ${PROJECT_SOURCE_DIR}/cmake/drawing_font.cmake
    DEPENDS ${STRAKE_DRAWING_FONT} ${PROJECT_SOURCE_DIR}/cmake/drawing_font.cmake
    COMMENT "The font of drawings as a source")
  set_source_files_properties(${made} PROPERTIES
    SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
  set(${source} ${made} PARENT_SCOPE)
endfunction()
