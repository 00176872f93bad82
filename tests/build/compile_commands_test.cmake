# No compile command of the project may define NDEBUG.
file(READ "${COMPILE_COMMANDS}" commands)
if(commands MATCHES "-DNDEBUG|-D NDEBUG")
  message(FATAL_ERROR "a compile command defines NDEBUG")
endif()
if(NOT commands MATCHES "multibody_drum.cpp")
  message(FATAL_ERROR "no compile commands to look at: ${COMPILE_COMMANDS}")
endif()
