# SPDX-License-Identifier: Apache-2.0
# After find_package(strake): it leaves no variables behind but those that find_package is known for.
get_cmake_property(variables VARIABLES)
list(FILTER variables INCLUDE REGEX "^_?strake_")
list(FILTER variables EXCLUDE REGEX "^strake_([a-z]+_)?(FOUND|NOT_FOUND_MESSAGE)$")
list(FILTER variables EXCLUDE REGEX "^strake_(DIR|CONFIG|VERSION|CONSIDERED|FIND)")
if(variables)
  message(FATAL_ERROR "find_package(strake) leaves variables behind: ${variables}")
endif()
