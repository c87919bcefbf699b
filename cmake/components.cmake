# SPDX-License-Identifier: Apache-2.0
# The public library: what is installed for other projects, grouped by job. A header that is not
# named here promises nothing to anybody outside.
set(pattern_examples
  examples/convert
  examples/cancellation.cpp
  examples/first_defect.cpp
  examples/first_program.cpp
  examples/host_threads.cpp
  examples/load_balance.cpp
  examples/near_pairs.cpp
  examples/ordered_sum.cpp
  examples/packed_lists.cpp
  examples/paired_triangles.cpp
  examples/pipelined_text.cpp
  examples/prepared_parts.cpp
  examples/queued_jobs.cpp
  examples/shared_words.cpp
  examples/uneven_meshes.cpp
  examples/worker_scratch.cpp)
strake_component(parallel
  MODULES result parallel
  HEADERS core/result.hpp parallel
  PAGES docs/patterns ${pattern_examples})
if(STRAKE_ONLY_PARALLEL)
  return()
endif()

strake_component(geometry
  MODULES core geometry
  DEPENDS parallel
  HEADERS
    core/atomic_file.hpp
    core/diagnostics.hpp
    core/hash.hpp
    core/shared_array.hpp
    core/version.hpp
    geometry/primitive_separation.hpp
    geometry/closest.hpp
    geometry/depth.hpp
    geometry/ellipse.hpp
    geometry/grid.hpp
    geometry/grid_shapes.hpp
    geometry/inside.hpp
    geometry/intersect.hpp
    geometry/mesh.hpp
    geometry/part.hpp
    geometry/part_pair.hpp
    geometry/plane_intersection.hpp
    geometry/triangle_bvh.hpp
    geometry/predicates.hpp
    geometry/primitive.hpp
    geometry/rational.hpp
    geometry/separating_axis.hpp
    geometry/lower_dimensional_body.hpp
    geometry/lower_dimensional_separation.hpp
    geometry/triangle_contact.hpp
    geometry/triangulate.hpp
    geometry/vec.hpp
    geometry/support_tree.hpp
    geometry/wide_int.hpp
  PAGES docs/geometry.md examples/basic_tests.cpp)

# The pages of all components from here on refer to each other, so they come together.
set(manual
  docs/bcf.md
  docs/clash-pictures.md
  docs/clash.md
  docs/cluster.md
  docs/decisions
  docs/drawing.md
  docs/evaluation.md
  docs/first-run.md
  docs/formats/dxf.md
  docs/formats/gltf.md
  docs/formats/ifc.md
  docs/formats/importers.md
  docs/formats/page.md
  docs/formats/pdf.md
  docs/formats/primitives.md
  docs/formats/step.md
  docs/hidden-line-algorithms.md
  docs/hlr.md
  docs/pictures
  docs/profiles.md
  docs/project.md
  docs/reading-results.md
  docs/report-page.md
  docs/rules.md
  docs/selection.md
  docs/sheets.md
  docs/statuses.md
  docs/view.md
  examples/nightly.sh
  examples/ship_deck.toml
  examples/ship_rules.toml
  examples/ship_notes.toml
  examples/ship_set.toml
  examples/ship_sheet.toml
  python/README.md
  python/examples)
strake_component(model
  MODULES model io settings
  DEPENDS parallel geometry
  PACKAGES fmt re2 meshoptimizer
  HEADERS
    io/importer.hpp
    io/reader.hpp
    io/writer.hpp
    model/model.hpp
    model/scene.hpp
    model/selection.hpp
    model/single_lines.hpp
  PAGES ${manual})

strake_component(clash
  MODULES clash rules
  DEPENDS parallel geometry model
  HEADERS
    clash/clash.hpp
    clash/group.hpp
    clash/incremental.hpp
    clash/kept.hpp
    clash/options.hpp
    clash/overlaps.hpp
    clash/pair.hpp
    clash/policy.hpp
    clash/relation.hpp
    clash/reporting.hpp
    rules/rules.hpp)

strake_component(drawing
  MODULES hlr drawing sheets
  DEPENDS parallel geometry model
  PACKAGES zlib
  HEADERS
    drawing/break_lines.hpp
    drawing/centre_lines.hpp
    drawing/drawing.hpp
    drawing/hatching.hpp
    drawing/ink.hpp
    drawing/object_styles.hpp
    drawing/thinning.hpp
    drawing/view.hpp
    drawing/write.hpp
    hlr/hlr.hpp
    hlr/incremental.hpp
    hlr/steps.hpp
    sheets/sheet.hpp
    sheets/sheet_file.hpp
    sheets/write.hpp)

strake_component(report
  MODULES report
  DEPENDS parallel geometry model clash drawing
  HEADERS
    report/clash.hpp
    report/clash_diff.hpp
    report/clash_document.hpp
    report/decisions.hpp
    report/file_match.hpp
    report/view_diff.hpp
    report/view_document.hpp
    report/view_drawing.hpp)

strake_component(publish
  MODULES workbook pictures bcf page publish
  DEPENDS parallel geometry model clash drawing report
  PACKAGES agg libzip pugixml
  HEADERS publish/publish.hpp)

strake_component(project
  MODULES project
  DEPENDS parallel geometry model clash drawing report
  PACKAGES sqlite3 zstd
  HEADERS
    project/check.hpp
    project/listing.hpp
    project/project.hpp
    project/summary.hpp
    project/update.hpp)

strake_component(generate
  MODULES generate
  DEPENDS parallel geometry model clash
  HEADERS generate/ship.hpp)

# All of it, as one target.
add_library(strake_library INTERFACE)
add_library(strake::strake ALIAS strake_library)
get_property(modules GLOBAL PROPERTY strake_modules)
list(TRANSFORM modules PREPEND strake::)
target_link_libraries(strake_library INTERFACE ${modules})
set_target_properties(strake_library PROPERTIES EXPORT_NAME strake)
strake_component(all
  MODULES library
  DEPENDS parallel geometry model clash drawing report publish project generate
  HEADERS strake.hpp
  PAGES CHANGELOG.md docs/library.md examples/draw_view.cpp examples/find_clashes.cpp)

# pkg-config's description of all of them.
install(FILES ${PROJECT_BINARY_DIR}/strake.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
  COMPONENT all)

# For users of the program and of the library alike.
install(DIRECTORY schemas DESTINATION ${CMAKE_INSTALL_DATADIR}/strake COMPONENT program)
install(DIRECTORY rules DESTINATION ${CMAKE_INSTALL_DATADIR}/strake COMPONENT program)
install(FILES examples/ship_deck.toml examples/ship_notes.toml examples/ship_rules.toml examples/ship_set.toml
    examples/ship_sheet.toml
  DESTINATION ${CMAKE_INSTALL_DATADIR}/strake/examples COMPONENT program)
install(PROGRAMS examples/nightly.sh
  DESTINATION ${CMAKE_INSTALL_DATADIR}/strake/examples COMPONENT program)
