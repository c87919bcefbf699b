# SPDX-License-Identifier: Apache-2.0
# The conversions of docs/patterns/convert.md, before and after, for their programs and benchmark.
if(NOT TARGET strake_conversions)
  set(here ${CMAKE_CURRENT_LIST_DIR})
  add_library(strake_conversions STATIC ${here}/bounding_box_after.cpp
    ${here}/bounding_box_before.cpp ${here}/box.cpp ${here}/clearance_after.cpp
    ${here}/clearance_before.cpp ${here}/comes_near.cpp ${here}/mass_after.cpp
    ${here}/mass_before.cpp ${here}/model.cpp ${here}/sums.cpp ${here}/triangle_distance.cpp)
  target_include_directories(strake_conversions PUBLIC ${here})
  target_link_libraries(strake_conversions PUBLIC strake::parallel PRIVATE strake_flags)
endif()
