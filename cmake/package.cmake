# SPDX-License-Identifier: Apache-2.0
# What other projects find with find_package(strake COMPONENTS ...). A component is installed alone
# with `cmake --install BUILD --component NAME`.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(strake_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/strake)
configure_package_config_file(cmake/strake-config.cmake.in strake-config.cmake
  INSTALL_DESTINATION ${strake_package_dir}
  NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
# Before version 1 any minor version may change the interface.
write_basic_package_version_file(strake-config-version.cmake COMPATIBILITY SameMinorVersion)

# strake_component(NAME MODULES packaged modules... HEADERS files and folders of include/strake...
#   GUIDE folders of pages and examples...)
# Installs the modules as targets strake::MODULE, with their headers and all that finds them.
function(strake_component name)
  cmake_parse_arguments(arg "" "" "MODULES;HEADERS;GUIDE" ${ARGN})
  list(TRANSFORM arg_MODULES PREPEND strake_)
  install(TARGETS ${arg_MODULES} EXPORT strake-${name}
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
  install(FILES
    ${PROJECT_BINARY_DIR}/strake-config.cmake ${PROJECT_BINARY_DIR}/strake-config-version.cmake
    DESTINATION ${strake_package_dir} COMPONENT ${name})
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/NOTICE
    DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT ${name})
  foreach(folder ${arg_GUIDE})
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DESTINATION ${CMAKE_INSTALL_DOCDIR}
      COMPONENT ${name} FILES_MATCHING PATTERN *.md PATTERN *.svg PATTERN *.cpp PATTERN *.hpp
      PATTERN expected EXCLUDE PATTERN basic_tests.cpp EXCLUDE)
  endforeach()
endfunction()
