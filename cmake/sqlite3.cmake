# SPDX-License-Identifier: Apache-2.0
# sqlite3::sqlite3, under the name by which strake_component() looks for it. Where there is no SQLite
# there is no target: who includes this says what that means.
if(NOT TARGET sqlite3::sqlite3)
  find_path(SQLITE3_INCLUDE_DIR sqlite3.h)
  find_library(SQLITE3_LIBRARY sqlite3)
  mark_as_advanced(SQLITE3_INCLUDE_DIR SQLITE3_LIBRARY)
  if(SQLITE3_INCLUDE_DIR AND SQLITE3_LIBRARY)
    add_library(sqlite3::sqlite3 UNKNOWN IMPORTED)
    set_target_properties(sqlite3::sqlite3 PROPERTIES
      IMPORTED_LOCATION ${SQLITE3_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${SQLITE3_INCLUDE_DIR})
  endif()
endif()
