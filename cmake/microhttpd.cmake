# SPDX-License-Identifier: Apache-2.0
# microhttpd::microhttpd. Where there is no GNU libmicrohttpd there is no target: who includes this says what that
# means.
if(NOT TARGET microhttpd::microhttpd)
  find_path(MICROHTTPD_INCLUDE_DIR microhttpd.h)
  find_library(MICROHTTPD_LIBRARY microhttpd)
  mark_as_advanced(MICROHTTPD_INCLUDE_DIR MICROHTTPD_LIBRARY)
  if(MICROHTTPD_INCLUDE_DIR AND MICROHTTPD_LIBRARY)
    add_library(microhttpd::microhttpd UNKNOWN IMPORTED)
    set_target_properties(microhttpd::microhttpd PROPERTIES
      IMPORTED_LOCATION ${MICROHTTPD_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${MICROHTTPD_INCLUDE_DIR})
  endif()
endif()
