# SPDX-License-Identifier: MIT
# What every target of ours shares: the standard, the warnings, the sanitizers. Third-party headers are SYSTEM.

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
set(CMAKE_CXX_EXTENSIONS OFF)

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
  set(CMAKE_C_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
endif()

add_library(stairwell_options INTERFACE)
target_compile_features(stairwell_options INTERFACE cxx_std_20)
target_include_directories(stairwell_options INTERFACE "${PROJECT_SOURCE_DIR}")
# No fused multiply-add: a resumed session must propose the bit-identical next radius on any machine.
target_compile_options(stairwell_options INTERFACE
  -Wall -Wextra -Wshadow -Wconversion -ffp-contract=off
  # GCC 12 sees overlapping copies in "literal" + string where there are none (GCC bug 105651).
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>
  $<$<BOOL:${STAIRWELL_WERROR}>:-Werror>)
if(STAIRWELL_SANITIZE)
  target_compile_options(stairwell_options INTERFACE
    -fsanitize=${STAIRWELL_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(stairwell_options INTERFACE -fsanitize=${STAIRWELL_SANITIZE})
endif()

# stairwell_library(NAME SOURCES a.cpp ... LINK lib ...): one static library per folder; LINK is PUBLIC
# where a header needs it and so is the arrow of the architecture.
function(stairwell_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_link_libraries(${name} PUBLIC ${ARG_LINK} PRIVATE ${ARG_PRIVATE_LINK})
  target_link_libraries(${name} PUBLIC stairwell_options)
endfunction()

# stairwell_program(NAME SOURCES main.cpp LINK lib ...): a binary in build/<preset>/bin.
function(stairwell_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINK} program stairwell_options)
endfunction()
