# SPDX-License-Identifier: Apache-2.0
# zstd::zstd, whether or not the installed package brings a CMake description (Debian 12's does not).
# Where there is no zstd there is no target: who includes this says what that means.
if(NOT TARGET zstd::zstd)
  find_path(ZSTD_INCLUDE_DIR zstd.h)
  find_library(ZSTD_LIBRARY zstd)
  mark_as_advanced(ZSTD_INCLUDE_DIR ZSTD_LIBRARY)
  if(ZSTD_INCLUDE_DIR AND ZSTD_LIBRARY)
    add_library(zstd::zstd UNKNOWN IMPORTED)
    set_target_properties(zstd::zstd PROPERTIES
      IMPORTED_LOCATION ${ZSTD_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${ZSTD_INCLUDE_DIR})
  endif()
endif()
