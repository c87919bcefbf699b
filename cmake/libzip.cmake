# SPDX-License-Identifier: Apache-2.0
# libzip::libzip, whether or not the installed package brings a CMake description that works (Debian 12's asks for
# the programs of another package). Where there is no libzip there is no target: who includes this says what that means.
if(NOT TARGET libzip::libzip)
  find_path(LIBZIP_INCLUDE_DIR zip.h)
  find_library(LIBZIP_LIBRARY zip)
  mark_as_advanced(LIBZIP_INCLUDE_DIR LIBZIP_LIBRARY)
  if(LIBZIP_INCLUDE_DIR AND LIBZIP_LIBRARY)
    add_library(libzip::libzip UNKNOWN IMPORTED)
    set_target_properties(libzip::libzip PROPERTIES
      IMPORTED_LOCATION ${LIBZIP_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${LIBZIP_INCLUDE_DIR})
  endif()
endif()
