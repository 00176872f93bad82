# Third-party packages, all from Debian 12. tests/build/include_directions_test.cpp
# lists those that stay behind a few files.

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Ceres 2.1 REQUIRED)
find_package(fmt 9 REQUIRED)
find_package(spdlog 1.10 REQUIRED)
find_package(tomlplusplus 3.3 REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(CLI11 2.1 REQUIRED)
find_package(TBB REQUIRED)
find_package(Boost 1.74 REQUIRED)
find_package(ZLIB REQUIRED)
find_package(LibXml2 2.9 REQUIRED)
find_package(SQLiteCpp 3.2 REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(edlib REQUIRED IMPORTED_TARGET edlib-1)
pkg_check_modules(minizip REQUIRED IMPORTED_TARGET minizip)
pkg_check_modules(libmd REQUIRED IMPORTED_TARGET libmd)
pkg_check_modules(httplib REQUIRED IMPORTED_TARGET cpp-httplib>=0.11)
# UDUNITS: by hand, since its pkg-config file is not in every version of the package where it is looked for.
find_path(UDUNITS_INCLUDE_DIR udunits2.h REQUIRED)
find_library(UDUNITS_LIBRARY udunits2 REQUIRED)
add_library(rollrig_udunits INTERFACE)
target_include_directories(rollrig_udunits SYSTEM INTERFACE "${UDUNITS_INCLUDE_DIR}")
target_link_libraries(rollrig_udunits INTERFACE "${UDUNITS_LIBRARY}")

# HDF5 without MPI, the one that Debian's matio brings along: two of them in one program would meet. Programs link both
# statically, with szip and aec that they need: Debian's shared HDF5 loads curl, Kerberos, LDAP and thirty more
# libraries for files in the cloud, which rollrig never reads, and which double the time that a program takes to start.
# Shared libraries cannot take the static ones, which are not position-independent.
pkg_check_modules(hdf5 REQUIRED hdf5-serial)
find_path(MATIO_INCLUDE_DIR matio.h REQUIRED)
find_library(MATIO_LIBRARY matio REQUIRED)
find_library(MATIO_STATIC libmatio.a REQUIRED)
find_library(HDF5_STATIC libhdf5.a REQUIRED HINTS ${hdf5_LIBRARY_DIRS} ${hdf5_LIBDIR})
find_library(SZIP_STATIC libsz.a REQUIRED)
find_library(AEC_STATIC libaec.a REQUIRED)
add_library(rollrig_hdf5 INTERFACE)
target_include_directories(rollrig_hdf5 SYSTEM INTERFACE "${MATIO_INCLUDE_DIR}" ${hdf5_INCLUDE_DIRS})
set(is_program $<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>)
target_link_libraries(rollrig_hdf5 INTERFACE
  "$<${is_program}:${MATIO_STATIC};${HDF5_STATIC};${SZIP_STATIC};${AEC_STATIC};ZLIB::ZLIB;${CMAKE_DL_LIBS}>"
  "$<$<NOT:${is_program}>:${hdf5_LINK_LIBRARIES};${MATIO_LIBRARY}>")

# Simbody: its configuration file names libraries and folders only.
find_package(Simbody 3.7 REQUIRED NAMES Simbody simbody)
add_library(rollrig_simbody INTERFACE)
target_include_directories(rollrig_simbody SYSTEM INTERFACE ${Simbody_INCLUDE_DIR})
target_link_libraries(rollrig_simbody INTERFACE SimTKsimbody SimTKmath SimTKcommon)

# What tools/install_packages.sh unpacked, since it is needed for its files alone.
list(APPEND CMAKE_PREFIX_PATH "${PROJECT_SOURCE_DIR}/build/packages/usr")
# SUNDIALS: found by hand, since its configuration file asks for MPI and other solvers. Only the static
# CVODES is used, and only by the target rollrig_cvodes (see sim/CMakeLists.txt).
find_path(SUNDIALS_INCLUDE_DIR cvodes/cvodes.h REQUIRED)
find_library(SUNDIALS_CVODES_STATIC libsundials_cvodes.a REQUIRED)
file(STRINGS "${SUNDIALS_INCLUDE_DIR}/sundials/sundials_config.h" sundials_version_line
  REGEX "define SUNDIALS_VERSION ")
string(REGEX REPLACE ".*\"(.*)\".*" "\\1" ROLLRIG_SUNDIALS_VERSION "${sundials_version_line}")
if(ROLLRIG_SUNDIALS_VERSION VERSION_LESS 6.4)
  message(FATAL_ERROR "SUNDIALS 6.4 or newer is needed, found '${ROLLRIG_SUNDIALS_VERSION}'")
endif()

# The Python package, where it is wanted and can be built: not with a sanitizer, whose library Python does not load.
set(ROLLRIG_PYTHON_FOUND OFF)
if(ROLLRIG_BUILD_PYTHON AND NOT ROLLRIG_SANITIZE)
  find_program(Python3_EXECUTABLE python3 PATHS /usr/bin NO_DEFAULT_PATH)  # Debian's, which has its pybind11 and NumPy
  find_package(Python3 3.11 COMPONENTS Interpreter Development.Module QUIET)
  set(PYBIND11_FINDPYTHON ON)
  find_package(pybind11 2.10 QUIET)
  if(Python3_Development.Module_FOUND AND pybind11_FOUND)
    set(ROLLRIG_PYTHON_FOUND ON)
  endif()
endif()
