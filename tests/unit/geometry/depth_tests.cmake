# SPDX-License-Identifier: Apache-2.0
strake_test(geometry_bvh_test
  SOURCES bvh_test.cpp MODULES geometry parallel LABELS fast parallel)
strake_test(geometry_radius_lp_test
  SOURCES radius_lp_test.cpp ../../support/part_builder.cpp MODULES geometry LABELS fast)
strake_test(geometry_depth_test
  SOURCES depth_test.cpp ../../support/part_builder.cpp MODULES geometry LABELS fast)
strake_test(geometry_caving_depth_test
  SOURCES caving_depth_test.cpp ../../support/part_builder.cpp MODULES geometry LABELS fast)
strake_test(geometry_level_scope_test
  SOURCES level_scope_test.cpp ../../support/part_builder.cpp MODULES geometry LABELS fast)
strake_test(geometry_depth_field_test
  SOURCES depth_field_test.cpp ../../support/part_builder.cpp MODULES geometry LABELS fast)
strake_test(geometry_level_search_test
  SOURCES level_search_test.cpp ../../support/part_builder.cpp MODULES geometry LABELS fast)
strake_test(geometry_fitted_depth_test
  SOURCES fitted_depth_test.cpp ../../support/part_builder.cpp MODULES geometry LABELS fast)
strake_test(geometry_shrink_test
  SOURCES shrink_test.cpp ../../support/part_builder.cpp MODULES geometry LABELS fast)
strake_test(geometry_flush_contact_test
  SOURCES flush_contact_test.cpp ../../support/part_builder.cpp MODULES geometry LABELS fast)
strake_test(geometry_analytic_pair_test
  SOURCES analytic_pair_test.cpp MODULES geometry LABELS fast)
strake_test(geometry_analytic_solver_test
  SOURCES analytic_solver_test.cpp MODULES geometry LABELS fast)
