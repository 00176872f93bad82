# Language, warnings and build types, for every target of the project.

# C++17: Simbody 3.7's headers do not compile as C++20, and headers are shared.
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, RelWithDebInfo or Release" FORCE)
endif()

# Debian's Simbody is built without NDEBUG and its inline functions depend on it: a program that defines
# NDEBUG and includes its headers crashes. So no build type of this project defines it;
# tests/build/ndebug_test.cpp and tests/build/compile_commands_test.cmake verify that. Programs that use the library of
# rollrig may define it, since its public headers include none of Simbody.
foreach(language C CXX)
  set(CMAKE_${language}_FLAGS_RELEASE "-O2")
  set(CMAKE_${language}_FLAGS_RELWITHDEBINFO "-O2 -g")
  set(CMAKE_${language}_FLAGS_MINSIZEREL "-Os")
endforeach()

include(GNUInstallDirs)
add_library(rollrig_options INTERFACE)
# -Werror=missing-field-initializers: each kind of machine must set every member of MachineTraits.
target_compile_options(rollrig_options INTERFACE -Wall -Wextra -Wconversion $<$<CXX_COMPILER_ID:GNU>:-Wshadow=local>
                                                 -Werror=missing-field-initializers
                                                 $<$<BOOL:${ROLLRIG_WERROR}>:-Werror>)
target_include_directories(rollrig_options INTERFACE "${PROJECT_SOURCE_DIR}")
# Asserts inside Eigen's kernels cost a multiple of the arithmetic; nothing of Simbody depends on them. Other builds have
# them, and the standard library's: an index out of range ends the program.
target_compile_definitions(rollrig_options INTERFACE
  $<IF:$<CONFIG:Release>,EIGEN_NO_DEBUG,_GLIBCXX_ASSERTIONS>)

# Libraries that spend their run time in other libraries: -O1 takes less time to compile, and costs no speed. Fits and
# diagnoses were measured to be as fast, and to give the same bytes.
function(rollrig_optimize_little)
  foreach(target IN LISTS ARGN)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endforeach()
endfunction()

# Debian packages: hardened as Debian's own, and the same bytes from every folder.
if(ROLLRIG_DEBIAN_PACKAGES)
  add_compile_options("-ffile-prefix-map=${PROJECT_SOURCE_DIR}=." -fstack-protector-strong -D_FORTIFY_SOURCE=2)
  add_link_options(-Wl,-z,relro,-z,now)
  set(CMAKE_BUILD_RPATH_USE_ORIGIN ON)
  set(CMAKE_SKIP_INSTALL_RPATH ON)
endif()

# Sanitizers: -DROLLRIG_SANITIZE=address,undefined
set(ROLLRIG_SANITIZE "" CACHE STRING "Value for -fsanitize=, or empty")
if(ROLLRIG_SANITIZE)
  # Reports need lines of the sources alone (-g1); full debug information takes twice the memory to compile. With -O2,
  # Clang takes several minutes for a folder, with -O1 a fraction.
  add_compile_options(-fsanitize=${ROLLRIG_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all -O1 -g1)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    add_compile_options("-fsanitize-ignorelist=${PROJECT_SOURCE_DIR}/tests/sanitizers/headers.txt")
  endif()
  add_link_options(-fsanitize=${ROLLRIG_SANITIZE})
  add_compile_definitions(ROLLRIG_SANITIZED)
endif()

# Coverage for libFuzzer, by the preset fuzz (tools/fuzz)
option(ROLLRIG_FUZZ "Build the readers for libFuzzer; needs Clang" OFF)
if(ROLLRIG_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()

find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE}")
endif()
