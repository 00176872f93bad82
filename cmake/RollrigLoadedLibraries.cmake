# Libraries that rollrig loads when it first needs them (sim/core/shared_library.h): each links packages that take long
# to load, has copies of what it uses of the static libraries, and exports one function. No program is linked to them;
# targets depend on them by name.
set(rollrig_loaded_libraries rollrig_multibody rollrig_least_squares)

function(rollrig_add_loaded_library target)
  if(NOT target IN_LIST rollrig_loaded_libraries)
    message(FATAL_ERROR "cmake/RollrigLoadedLibraries.cmake does not name ${target}")
  endif()
  add_library(${target} SHARED ${ARGN})
  set_target_properties(${target} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
    VERSION "${PROJECT_VERSION}" SOVERSION "${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}")
  # For a bundled wheel (python/make_wheel.sh --bundle): --no-as-needed lists every linked library in the target, and
  # --disable-new-dtags writes RPATH instead of RUNPATH, which the loader also uses for what those libraries need.
  target_link_options(${target} PRIVATE -Wl,--exclude-libs,ALL -Wl,--no-as-needed LINKER:--disable-new-dtags)
endfunction()

# The source that loads a library gets the library's file name as the macro ROLLRIG_<NAME>_LIBRARY.
function(rollrig_loads_library source target)
  string(TOUPPER "${target}_LIBRARY" macro)
  set_property(SOURCE ${source} APPEND PROPERTY COMPILE_DEFINITIONS
    "${macro}=\"lib${target}.so.${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}\"")
endfunction()
