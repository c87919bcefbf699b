# SPDX-License-Identifier: Apache-2.0
strake_test(geometry_bvh_test
  SOURCES bvh_test.cpp MODULES geometry parallel LABELS fast parallel)
strake_test(geometry_depth_test UNITE
  SOURCES concave_depth_test.cpp coplanar_contact_test.cpp depth_test.cpp distance_field_test.cpp fitted_depth_test.cpp
          inscribed_ball_test.cpp level_search_test.cpp offset_cell_test.cpp primitive_separation_test.cpp
          primitive_solvers_test.cpp separating_displacement_test.cpp
  MODULES geometry LABELS fast)
