# SPDX-License-Identifier: Apache-2.0

# strake_module(NAME [COLD|HOT] SOURCES... DEPENDS modules... [LIBS private libraries...])
# One layer of the library: library strake_NAME, alias strake::NAME; static, unless
# BUILD_SHARED_LIBS. Position-independent when static, too: it may end up in a plug-in. What is COLD
# reads what a person wrote, and is compiled quickly rather than to run quickly. In what is HOT
# functions are inlined as if each source were compiled alone.
function(strake_module name)
  cmake_parse_arguments(arg "COLD;HOT" "" "SOURCES;DEPENDS;LIBS" ${ARGN})
  add_library(strake_${name} ${arg_SOURCES})
  add_library(strake::${name} ALIAS strake_${name})
  target_include_directories(strake_${name}
    PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> PRIVATE ${PROJECT_SOURCE_DIR}/src)
  foreach(module ${arg_DEPENDS})
    target_link_libraries(strake_${name} PUBLIC strake::${module})
  endforeach()
  target_link_libraries(strake_${name} PRIVATE $<BUILD_INTERFACE:strake_flags> ${arg_LIBS})
  target_compile_features(strake_${name} PUBLIC cxx_std_20)
  # Calls within a module are inlined although it may become a shared library.
  target_compile_options(strake_${name} PRIVATE -fno-semantic-interposition)
  # Before version 1 any minor version may change the interface, hence its place in SOVERSION.
  set_target_properties(strake_${name} PROPERTIES
    EXPORT_NAME ${name}
    VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
    POSITION_INDEPENDENT_CODE ON
    INSTALL_RPATH $ORIGIN)
  strake_unite(strake_${name})
  if(arg_HOT)
    strake_inline_fully(strake_${name})
  endif()
  if(arg_COLD)
    strake_compile_quickly(strake_${name})
    strake_precompile(strake_${name} cold_modules)
  else()
    strake_precompile(strake_${name} modules)
  endif()
endfunction()

# strake_test(NAME [UNITE] SOURCES... MODULES modules... [LIBS ...] [LABELS fast|slow|parallel ...] [TIMEOUT s])
# One GoogleTest program, one CTest entry. "fast" programs also run under the sanitizers. What
# tests/support has for the modules is linked. What is hidden in the sources of one that is to UNITE has
# names of its own in the program, so that a unity build compiles them at once.
function(strake_test name)
  cmake_parse_arguments(arg "UNITE" "TIMEOUT" "SOURCES;MODULES;LIBS;LABELS" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/tests)
  foreach(module ${arg_MODULES})
    target_link_libraries(${name} PRIVATE strake::${module})
    if(TARGET strake_support_${module})
      target_link_libraries(${name} PRIVATE strake_support_${module})
    endif()
  endforeach()
  target_link_libraries(${name} PRIVATE strake_flags GTest::gtest_main ${arg_LIBS})
  if(arg_UNITE)
    strake_unite(${name})
  endif()
  # A test that is run once is not worth what optimising GoogleTest's macros takes; the library
  # under it, and what searches for hours, are optimised as ever.
  if(slow IN_LIST arg_LABELS)
    strake_precompile(${name} slow_tests HEADERS <gtest/gtest.h>)
  else()
    strake_compile_quickly(${name} TEST)
    strake_precompile(${name} tests HEADERS <gtest/gtest.h>)
  endif()
  add_test(NAME ${name} COMMAND ${name})
  if(NOT arg_TIMEOUT)
    # Against hanging; a machine that is busy with other things must not fail by it.
    set(arg_TIMEOUT 600)
  endif()
  set_tests_properties(${name} PROPERTIES TIMEOUT ${arg_TIMEOUT} LABELS "${arg_LABELS}")
  foreach(label ${arg_LABELS})
    if(NOT TARGET strake_tests_${label})
      add_custom_target(strake_tests_${label})
    endif()
    add_dependencies(strake_tests_${label} ${name})
  endforeach()
endfunction()

# strake_rounds_test(NAME SOURCES... MODULES modules... [LIBS ...] [TIMEOUT s])
# A fast test with few rounds; among the slow tests, as ..._long_test, the same with many
# (STRAKE_LONG_RUN).
function(strake_rounds_test name)
  cmake_parse_arguments(arg "" "TIMEOUT" "SOURCES;MODULES;LIBS" ${ARGN})
  set(what SOURCES ${arg_SOURCES} MODULES ${arg_MODULES} LIBS ${arg_LIBS})
  strake_test(${name} ${what} LABELS fast TIMEOUT ${arg_TIMEOUT})
  if(STRAKE_SLOW_TESTS)
    string(REGEX REPLACE "(_property)?_test$" "_long_test" long ${name})
    strake_test(${long} ${what} LABELS slow TIMEOUT 7200)
    target_compile_definitions(${long} PRIVATE STRAKE_LONG_RUN)
  endif()
endfunction()
