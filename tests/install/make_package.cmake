# SPDX-License-Identifier: Apache-2.0
# cmake -D PACKAGE=folder -D MUST_NOT_NAME=folders -D BUILD=folder -D COMPONENTS=... -P ...
# cmake -D PACKAGE=folder -D MUST_NOT_NAME=folders -D SOURCE=folder -D OPTIONS=... -P ...
# Installs components of a build, or builds the patterns alone from the sources first; moves what
# was installed to PACKAGE/moved; fails where a text of it names a folder of the machine that built
# it, where it lacks one of MUST_HAVE, or has a header that does not match the expression HEADERS.
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
endfunction()

# Lists come with | between their items.
foreach(list COMPONENTS MUST_HAVE OPTIONS)
  string(REPLACE "|" ";" ${list} "${${list}}")
endforeach()

# What was found in an older package is not to be remembered.
file(REMOVE_RECURSE ${PACKAGE}/staging ${PACKAGE}/moved ${PACKAGE}/consumer ${PACKAGE}/pkg_config)
if(SOURCE)
  set(BUILD ${PACKAGE}/build)
  # As on a machine that has none of what the rest of Strake needs.
  foreach(other CLI11 GTest fmt nlohmann_json re2 SQLite3 ZLIB zstd)
    list(APPEND OPTIONS -D CMAKE_DISABLE_FIND_PACKAGE_${other}=ON)
  endforeach()
  run(${CMAKE_COMMAND} -S ${SOURCE} -B ${BUILD} ${OPTIONS} -D STRAKE_ONLY_PARALLEL=ON
    -D BUILD_SHARED_LIBS=ON)
  run(${CMAKE_COMMAND} --build ${BUILD})
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${PACKAGE}/staging)
else()
  foreach(component ${COMPONENTS})
    run(${CMAKE_COMMAND} --install ${BUILD} --component ${component} --prefix ${PACKAGE}/staging)
  endforeach()
endif()
file(RENAME ${PACKAGE}/staging ${PACKAGE}/moved)

file(GLOB_RECURSE files RELATIVE ${PACKAGE}/moved ${PACKAGE}/moved/*)
foreach(file ${MUST_HAVE})
  if(NOT file IN_LIST files)
    message(FATAL_ERROR "the package lacks ${file}: ${files}")
  endif()
endforeach()
foreach(file ${files})
  if(file MATCHES "^(bin|include)/" AND NOT file MATCHES "^include/strake/(${HEADERS})")
    message(FATAL_ERROR "${file} is no part of the components")
  endif()
  if(file MATCHES "[.](cmake|hpp|pc)$")
    file(READ ${PACKAGE}/moved/${file} text)
    foreach(folder ${MUST_NOT_NAME} ${PACKAGE})
      string(FIND "${text}" "${folder}" at)
      if(NOT at EQUAL -1)
        message(FATAL_ERROR "${file} names ${folder}, of the machine that built it")
      endif()
    endforeach()
  endif()
endforeach()
