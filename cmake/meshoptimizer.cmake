# SPDX-License-Identifier: Apache-2.0
# meshoptimizer::meshoptimizer, under one name whichever package brings it (Debian's target has no namespace).
# Where there is no meshoptimizer there is no target: who includes this says what that means.
if(NOT TARGET meshoptimizer::meshoptimizer)
  find_path(MESHOPTIMIZER_INCLUDE_DIR meshoptimizer.h)
  find_library(MESHOPTIMIZER_LIBRARY meshoptimizer)
  mark_as_advanced(MESHOPTIMIZER_INCLUDE_DIR MESHOPTIMIZER_LIBRARY)
  if(MESHOPTIMIZER_INCLUDE_DIR AND MESHOPTIMIZER_LIBRARY)
    add_library(meshoptimizer::meshoptimizer UNKNOWN IMPORTED)
    set_target_properties(meshoptimizer::meshoptimizer PROPERTIES
      IMPORTED_LOCATION ${MESHOPTIMIZER_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${MESHOPTIMIZER_INCLUDE_DIR})
  endif()
endif()
