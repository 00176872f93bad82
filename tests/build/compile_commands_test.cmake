# No compile command of the project may define NDEBUG.
file(READ "${COMPILE_COMMANDS}" commands)
if(commands MATCHES "-DNDEBUG|-D NDEBUG")
  message(FATAL_ERROR "a compile command defines NDEBUG")
endif()
# One file, or one unit of a folder.
if(NOT commands MATCHES "multibody_drum.cpp|rollrig_rigs.dir/Unity")
  message(FATAL_ERROR "no compile commands to look at: ${COMPILE_COMMANDS}")
endif()
