# SPDX-License-Identifier: Apache-2.0
# What other projects find with find_package(strake COMPONENTS ...). A component is installed alone
# with `cmake --install BUILD --component NAME`, and needs those that it depends on.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(strake_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/strake)

# strake_component(NAME MODULES modules... DEPENDS components... PACKAGES others... HEADERS files and
#   folders of include/strake... PAGES files and folders...)
# Installs the modules as targets strake::MODULE, with their headers and all that finds them.
# PACKAGES: what has to be found for whoever links them, each with a target PACKAGE::PACKAGE.
# PAGES: pages, pictures and examples that come with it; they lie as in the sources, so that their
# links hold.
function(strake_component name)
  cmake_parse_arguments(arg "" "" "MODULES;DEPENDS;PACKAGES;HEADERS;PAGES" ${ARGN})
  list(TRANSFORM arg_MODULES PREPEND strake_ OUTPUT_VARIABLE targets)
  install(TARGETS ${targets} EXPORT strake-${name}
    ARCHIVE COMPONENT ${name}
    LIBRARY COMPONENT ${name}
    INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT strake-${name} FILE strake-targets-${name}.cmake NAMESPACE strake::
    DESTINATION ${strake_package_dir} COMPONENT ${name})
  foreach(entry ${arg_HEADERS})
    get_filename_component(folder ${entry} DIRECTORY)
    set(what FILES)
    if(IS_DIRECTORY ${PROJECT_SOURCE_DIR}/include/strake/${entry})
      set(what DIRECTORY)
    endif()
    install(${what} ${PROJECT_SOURCE_DIR}/include/strake/${entry}
      DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/strake/${folder} COMPONENT ${name})
  endforeach()
  foreach(page ${arg_PAGES})
    get_filename_component(folder ${page} DIRECTORY)
    set(what FILES)
    if(IS_DIRECTORY ${PROJECT_SOURCE_DIR}/${page})
      set(what DIRECTORY)
    endif()
    install(${what} ${PROJECT_SOURCE_DIR}/${page} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder}
      COMPONENT ${name})
  endforeach()
  install(FILES
    ${PROJECT_BINARY_DIR}/strake-config.cmake ${PROJECT_BINARY_DIR}/strake-config-version.cmake
    ${PROJECT_SOURCE_DIR}/cmake/libraries.cmake
    DESTINATION ${strake_package_dir} COMPONENT ${name})
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/NOTICE
    DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT ${name})
  set_property(GLOBAL APPEND PROPERTY strake_components ${name})
  set_property(GLOBAL APPEND PROPERTY strake_modules ${arg_MODULES})
  set_property(GLOBAL PROPERTY strake_modules_${name} ${arg_MODULES})
  set_property(GLOBAL PROPERTY strake_depends_${name} ${arg_DEPENDS})
  set_property(GLOBAL PROPERTY strake_packages_${name} ${arg_PACKAGES})
  set_property(GLOBAL PROPERTY strake_headers_${name} ${arg_HEADERS})
  set_property(GLOBAL PROPERTY strake_pages_${name} ${arg_PAGES})
endfunction()

# strake_component_list()
# What strake_component() was told of each, a line per fact, for who documents them: components.txt in
# the build folder.
function(strake_component_list)
  get_property(components GLOBAL PROPERTY strake_components)
  set(lines "")
  foreach(component ${components})
    string(APPEND lines "component ${component}\n")
    foreach(fact modules depends headers pages)
      get_property(value GLOBAL PROPERTY strake_${fact}_${component})
      list(JOIN value " " value)
      string(APPEND lines "${fact} ${value}\n")
    endforeach()
  endforeach()
  file(CONFIGURE OUTPUT components.txt CONTENT "${lines}" @ONLY)
endfunction()

# strake_package()
# After the last component: the files that find them, by CMake and by pkg-config.
function(strake_package)
  strake_component_list()
  get_property(components GLOBAL PROPERTY strake_components)
  get_property(modules GLOBAL PROPERTY strake_modules)
  set(strake_facts "  set(components ${components})\n")
  foreach(component ${components})
    foreach(fact depends packages)
      get_property(value GLOBAL PROPERTY strake_${fact}_${component})
      string(APPEND strake_facts "  set(${fact}_${component} ${value})\n")
    endforeach()
  endforeach()
  string(REPLACE ";" " " strake_facts "${strake_facts}")
  configure_package_config_file(cmake/strake-config.cmake.in strake-config.cmake
    INSTALL_DESTINATION ${strake_package_dir}
    NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
  # Before version 1 any minor version may change the interface.
  write_basic_package_version_file(strake-config-version.cmake COMPATIBILITY SameMinorVersion)
  # Static libraries are named before those that they need.
  list(REMOVE_ITEM modules library)
  list(REVERSE modules)
  list(TRANSFORM modules PREPEND "-lstrake_")
  list(JOIN modules " " strake_libraries)
  # Who links a static library links what it needs.
  set(strake_requires "Requires")
  if(BUILD_SHARED_LIBS)
    set(strake_requires "Requires.private")
  else()
    string(APPEND strake_libraries " -lmeshoptimizer") # which has no description for pkg-config
  endif()
  foreach(dir includedir libdir)
    string(TOUPPER CMAKE_INSTALL_${dir} place)
    set(strake_pc_${dir} ${${place}})
    if(NOT IS_ABSOLUTE "${strake_pc_${dir}}")
      string(PREPEND strake_pc_${dir} "\${prefix}/")
    endif()
  endforeach()
  file(RELATIVE_PATH strake_prefix_from_pkgconfig
    ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
  string(REGEX REPLACE "/$" "" strake_prefix_from_pkgconfig "${strake_prefix_from_pkgconfig}")
  configure_file(cmake/strake.pc.in strake.pc @ONLY)
endfunction()
