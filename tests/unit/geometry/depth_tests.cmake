# SPDX-License-Identifier: Apache-2.0
strake_test(geometry_bvh_test
  SOURCES bvh_test.cpp MODULES geometry parallel LABELS fast parallel)
strake_test(geometry_inscribed_ball_test
  SOURCES inscribed_ball_test.cpp MODULES geometry LABELS fast)
strake_test(geometry_depth_test
  SOURCES depth_test.cpp MODULES geometry LABELS fast)
strake_test(geometry_concave_depth_test
  SOURCES concave_depth_test.cpp MODULES geometry LABELS fast)
strake_test(geometry_offset_cell_test
  SOURCES offset_cell_test.cpp MODULES geometry LABELS fast)
strake_test(geometry_distance_field_test
  SOURCES distance_field_test.cpp MODULES geometry LABELS fast)
strake_test(geometry_level_search_test
  SOURCES level_search_test.cpp MODULES geometry LABELS fast)
strake_test(geometry_fitted_depth_test
  SOURCES fitted_depth_test.cpp MODULES geometry LABELS fast)
strake_test(geometry_separating_displacement_test
  SOURCES separating_displacement_test.cpp MODULES geometry LABELS fast)
strake_test(geometry_coplanar_contact_test
  SOURCES coplanar_contact_test.cpp MODULES geometry LABELS fast)
strake_test(geometry_primitive_separation_test
  SOURCES primitive_separation_test.cpp MODULES geometry LABELS fast)
strake_test(geometry_primitive_solvers_test
  SOURCES primitive_solvers_test.cpp MODULES geometry LABELS fast)
