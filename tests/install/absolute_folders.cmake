# SPDX-License-Identifier: Apache-2.0
# cmake -D SOURCE=folder -D FOLDER=of its build -D OPTIONS=... -P ...
# What pkg-config says of folders that do not lie below the prefix, and of those that do.
cmake_minimum_required(VERSION 3.25)
string(REPLACE "|" ";" OPTIONS "${OPTIONS}")

# said(VARIABLE TEXT): pkg-config of the configured build gives the variable that value.
function(said variable text)
  execute_process(
    COMMAND ${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${FOLDER}
      pkg-config --define-variable=pcfiledir=/where/it/is --variable=${variable} strake
    OUTPUT_VARIABLE value OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  if(NOT value STREQUAL text)
    message(FATAL_ERROR "${variable} is \"${value}\", not \"${text}\"")
  endif()
endfunction()

# configured(OPTIONS...)
function(configured)
  file(REMOVE_RECURSE ${FOLDER})
  execute_process(
    COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${FOLDER} ${OPTIONS} -D STRAKE_ONLY_PARALLEL=ON
      -D CMAKE_INSTALL_PREFIX=/opt/strake ${ARGN}
    OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endfunction()

configured(-D CMAKE_INSTALL_LIBDIR=/opt/libs -D CMAKE_INSTALL_INCLUDEDIR=/opt/headers)
said(libdir /opt/libs)
said(includedir /opt/headers)
configured(-D CMAKE_INSTALL_LIBDIR=lib/any -D CMAKE_INSTALL_INCLUDEDIR=include)
said(libdir /where/it/is/../../../lib/any)
said(includedir /where/it/is/../../../include)
