# SPDX-License-Identifier: MIT
# find_package(stairwell CONFIG): the target stairwell::resolution_controller, for C++20 and C11.
include("${CMAKE_CURRENT_LIST_DIR}/stairwellTargets.cmake")

# The static library is C++ inside. A project without C++ links by its C compiler, which does not add the
# C++ runtime by itself.
get_property(stairwell_languages GLOBAL PROPERTY ENABLED_LANGUAGES)
if(NOT "CXX" IN_LIST stairwell_languages)
  get_target_property(stairwell_type stairwell::resolution_controller TYPE)
  if(stairwell_type STREQUAL "STATIC_LIBRARY")
    set_property(TARGET stairwell::resolution_controller APPEND PROPERTY INTERFACE_LINK_LIBRARIES
      $<IF:$<PLATFORM_ID:Darwin>,c++,stdc++> m)
  endif()
  foreach(configuration "" _RELEASE _DEBUG _RELWITHDEBINFO _MINSIZEREL)
    set_property(TARGET stairwell::resolution_controller PROPERTY IMPORTED_LINK_INTERFACE_LANGUAGES${configuration} C)
  endforeach()
  # The feature cxx_std_20 asks for a compiler that is not there.
  set_property(TARGET stairwell::resolution_controller PROPERTY INTERFACE_COMPILE_FEATURES "")
endif()
