# SPDX-License-Identifier: Apache-2.0
# agg::agg, Anti-Grain Geometry compiled so that it may end up in a shared library (Debian: libagg_pic),
# or as it is. Where there is none there is no target: who includes this says what that means.
if(NOT TARGET agg::agg)
  find_path(AGG_INCLUDE_DIR agg2/agg_rasterizer_scanline_aa.h)
  find_library(AGG_LIBRARY NAMES agg_pic agg)
  mark_as_advanced(AGG_INCLUDE_DIR AGG_LIBRARY)
  if(AGG_INCLUDE_DIR AND AGG_LIBRARY)
    add_library(agg::agg UNKNOWN IMPORTED)
    set_target_properties(agg::agg PROPERTIES
      IMPORTED_LOCATION ${AGG_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${AGG_INCLUDE_DIR})
  endif()
endif()
