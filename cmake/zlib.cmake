# SPDX-License-Identifier: Apache-2.0
# zlib::zlib, under the name by which strake_component() looks for it. Where there is no zlib there is
# no target: who includes this says what that means.
if(NOT TARGET zlib::zlib)
  find_path(ZLIB_INCLUDE_DIR zlib.h)
  find_library(ZLIB_LIBRARY z)
  mark_as_advanced(ZLIB_INCLUDE_DIR ZLIB_LIBRARY)
  if(ZLIB_INCLUDE_DIR AND ZLIB_LIBRARY)
    add_library(zlib::zlib UNKNOWN IMPORTED)
    set_target_properties(zlib::zlib PROPERTIES
      IMPORTED_LOCATION ${ZLIB_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${ZLIB_INCLUDE_DIR})
  endif()
endif()
