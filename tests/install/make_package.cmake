# SPDX-License-Identifier: Apache-2.0
# cmake -D PACKAGE=folder -D MUST_NOT_NAME=folders -D BUILD=folder -P make_package.cmake
# cmake -D PACKAGE=folder -D MUST_NOT_NAME=folders -D SOURCE=folder -D OPTIONS=... -P ...
# Installs the patterns from a build, or builds them alone from the sources first; moves what was
# installed to PACKAGE/moved; fails where a text of it names a folder of the machine that built it.
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
endfunction()

file(REMOVE_RECURSE ${PACKAGE}/staging ${PACKAGE}/moved)
if(SOURCE)
  set(BUILD ${PACKAGE}/build)
  # As on a machine that has none of what the rest of Strake needs.
  foreach(other CLI11 GTest fmt nlohmann_json re2)
    list(APPEND OPTIONS -D CMAKE_DISABLE_FIND_PACKAGE_${other}=ON)
  endforeach()
  run(${CMAKE_COMMAND} -S ${SOURCE} -B ${BUILD} ${OPTIONS} -D STRAKE_ONLY_PARALLEL=ON
    -D BUILD_SHARED_LIBS=ON)
  run(${CMAKE_COMMAND} --build ${BUILD})
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${PACKAGE}/staging)
else()
  run(${CMAKE_COMMAND} --install ${BUILD} --component parallel --prefix ${PACKAGE}/staging)
endif()
file(RENAME ${PACKAGE}/staging ${PACKAGE}/moved)

file(GLOB_RECURSE files RELATIVE ${PACKAGE}/moved ${PACKAGE}/moved/*)
if(NOT "include/strake/parallel/for_each.hpp" IN_LIST files)
  message(FATAL_ERROR "the package lacks its headers: ${files}")
endif()
foreach(page patterns/README.md patterns/convert.md examples/ordered_sum.cpp)
  if(NOT "share/doc/strake/${page}" IN_LIST files)
    message(FATAL_ERROR "the package lacks its guide, ${page}: ${files}")
  endif()
endforeach()
foreach(file ${files})
  if(file MATCHES "^(bin|include)/"
      AND NOT file MATCHES "^include/strake/(parallel/|core/result[.]hpp$)")
    message(FATAL_ERROR "${file} is no part of the component")
  endif()
  if(file MATCHES "[.](cmake|hpp)$")
    file(READ ${PACKAGE}/moved/${file} text)
    foreach(folder ${MUST_NOT_NAME} ${PACKAGE})
      string(FIND "${text}" "${folder}" at)
      if(NOT at EQUAL -1)
        message(FATAL_ERROR "${file} names ${folder}, of the machine that built it")
      endif()
    endforeach()
  endif()
endforeach()
