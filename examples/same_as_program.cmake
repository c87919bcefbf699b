# SPDX-License-Identifier: Apache-2.0
# cmake -D EXAMPLE=program -D STRAKE=program -D WRITES=file -D "COMMAND=arguments..." -D FOLDER=folder
#   -P same_as_program.cmake
# Runs an example on a ship that strake makes, and on a file of which a facet is skipped; it must
# write what `strake COMMAND MODEL -o FILE` does, to the byte.
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${FOLDER} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})
run(${STRAKE} generate ship --objects 300 -o ship.glb --quiet)
file(WRITE ${FOLDER}/damaged.stl "solid plate
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 900 0 0
vertex 0 900 0
endloop
endfacet
facet normal 0 0 1
outer loop
vertex 900 0 0
vertex nan 900 0
vertex 0 900 0
endloop
endfacet
endsolid plate
")
foreach(model ship.glb damaged.stl)
  run(${EXAMPLE} ${model})
  run(${STRAKE} ${COMMAND} ${model} --quiet -o expected_${WRITES})
  run(${CMAKE_COMMAND} -E compare_files ${WRITES} expected_${WRITES})
endforeach()
# And a file that is none: told, and nothing is written.
file(REMOVE ${FOLDER}/${WRITES})
execute_process(COMMAND ${EXAMPLE} missing.glb WORKING_DIRECTORY ${FOLDER}
  RESULT_VARIABLE result ERROR_VARIABLE told)
if(result EQUAL 0 OR NOT told MATCHES "missing.glb" OR EXISTS ${FOLDER}/${WRITES})
  message(FATAL_ERROR "a missing file: exit code ${result}, \"${told}\"")
endif()
