# SPDX-License-Identifier: MIT
# cmake -DGIT=... -DSOURCE=... -DHEADER=... -P write_revision.cmake: writes the git revision of SOURCE into HEADER,
# and leaves the file untouched when it says so already, so that nothing recompiles.

set(revision "")
if(GIT)
  # Only SOURCE's own checkout counts, not one that it happens to be unpacked in; and a build takes no git locks.
  get_filename_component(parent "${SOURCE}" DIRECTORY)
  set(ENV{GIT_CEILING_DIRECTORIES} "${parent}")
  set(ENV{GIT_OPTIONAL_LOCKS} 0)
  execute_process(COMMAND "${GIT}" describe --always --dirty --abbrev=12 "--exclude=*"
    WORKING_DIRECTORY "${SOURCE}" OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(NOT revision)
  set(revision "unknown")
endif()

set(text "#define STAIRWELL_REVISION \"${revision}\"\n")
if(EXISTS "${HEADER}")
  file(READ "${HEADER}" old)
endif()
if(NOT "${old}" STREQUAL "${text}")
  file(WRITE "${HEADER}" "${text}")
endif()
