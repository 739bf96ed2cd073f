# SPDX-License-Identifier: MIT
# The controller alone, installed into a temporary folder, and the example built against it outside the tree, once
# in C++ and once in C: both must run and say the same.
#     cmake -DSOURCE=<tree> -DGENERATOR=Ninja -P package_test.cmake
set(temporary "$ENV{TMPDIR}")
if(temporary STREQUAL "")
  set(temporary /tmp)
endif()
string(RANDOM LENGTH 12 name)
set(folder "${temporary}/stairwell-package-${name}")

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(code)
    file(REMOVE_RECURSE "${folder}")
    message(FATAL_ERROR "${ARGN}\nended with ${code}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

# Nothing but a compiler is needed.
run(${CMAKE_COMMAND} -S "${SOURCE}/resolution_controller" -B "${folder}/controller" -G "${GENERATOR}"
    -DCMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build "${folder}/controller")
run(${CMAKE_COMMAND} --install "${folder}/controller" --prefix "${folder}/prefix")

# Headers stand alone: each compiles with nothing but the installed folder.
file(GLOB headers RELATIVE "${folder}/prefix/include/stairwell" "${folder}/prefix/include/stairwell/*/*.h")
set(alone "")
foreach(header ${headers})
  string(MAKE_C_IDENTIFIER "${header}" identifier)
  file(WRITE "${folder}/alone/${identifier}.cpp" "#include \"${header}\"\n#include \"${header}\"\n")
  list(APPEND alone ${identifier}.cpp)
endforeach()
list(LENGTH alone count)
if(count LESS 10)
  message(FATAL_ERROR "only ${count} headers were installed: ${headers}")
endif()
list(JOIN alone " " alone)
file(WRITE "${folder}/alone/CMakeLists.txt" "cmake_minimum_required(VERSION 3.25)
project(alone LANGUAGES CXX)
find_package(stairwell 0.1 CONFIG REQUIRED)
add_library(alone OBJECT ${alone})
target_compile_options(alone PRIVATE -Wall -Wextra -Werror)
target_link_libraries(alone PRIVATE stairwell::resolution_controller)
")
run(${CMAKE_COMMAND} -S "${folder}/alone" -B "${folder}/alone/build" -G "${GENERATOR}"
    -DCMAKE_PREFIX_PATH=${folder}/prefix)
run(${CMAKE_COMMAND} --build "${folder}/alone/build")

# As a part of an engine that has no version of its own.
file(WRITE "${folder}/host/CMakeLists.txt" "cmake_minimum_required(VERSION 3.25)
project(host LANGUAGES CXX)
add_subdirectory(${SOURCE}/resolution_controller controller)
")
run(${CMAKE_COMMAND} -S "${folder}/host" -B "${folder}/host/build" -G "${GENERATOR}")

file(COPY "${SOURCE}/examples/engine" DESTINATION "${folder}")
foreach(language CXX C)
  run(${CMAKE_COMMAND} -S "${folder}/engine" -B "${folder}/${language}" -G "${GENERATOR}"
      -DCMAKE_BUILD_TYPE=Release -DENGINE_LANGUAGE=${language} -DCMAKE_PREFIX_PATH=${folder}/prefix)
  run(${CMAKE_COMMAND} --build "${folder}/${language}")
  run("${folder}/${language}/engine_frame")
  set(output${language} "${output}")
endforeach()
file(REMOVE_RECURSE "${folder}")
if(NOT outputCXX STREQUAL outputC OR NOT outputCXX MATCHES "light 1: +[0-9]+ texels")
  message(FATAL_ERROR "C++ says\n${outputCXX}\nC says\n${outputC}")
endif()
message("${outputCXX}")
