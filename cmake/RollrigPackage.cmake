# cpack: the Debian packages rollrig, rollrig-dev and python3-rollrig. cmake --workflow --preset package builds them.
set(ROLLRIG_MAINTAINER "the rollrig developers <rollrig@example.org>" CACHE STRING
  "Maintainer of the Debian packages; give your own where you publish them")
set(package_version "${PROJECT_VERSION}-1")
set(templates "${CMAKE_CURRENT_LIST_DIR}/debian")
set(debian "${PROJECT_BINARY_DIR}/debian")

# Every time in the packages is the date of the release, so that every build gives the same bytes.
execute_process(COMMAND date --utc "--date=${ROLLRIG_RELEASE_DATE}" +%s
  OUTPUT_VARIABLE release_time_s OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND date --utc "--date=${ROLLRIG_RELEASE_DATE}" --rfc-email
  OUTPUT_VARIABLE release_date OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)

# What Debian asks of every package: copyright with the text of LICENSE, and changelogs.
file(READ LICENSE license)
string(REGEX REPLACE "^.*Copyright \\(c\\) ([^\n]*)\n.*" "\\1" copyright_holder "${license}")
string(REGEX REPLACE "^.*Copyright [^\n]*\n\n(.*)\n$" "\\1" license "${license}")
string(REPLACE "\n\n" "\n.\n" license "${license}")
string(REPLACE "\n" "\n " license "${license}")
configure_file("${templates}/copyright.in" "${debian}/copyright" @ONLY)
configure_file("${templates}/changelog.in" "${debian}/changelog" @ONLY)
execute_process(COMMAND gzip -9nc "${debian}/changelog" OUTPUT_FILE "${debian}/changelog.Debian.gz"
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND gzip -9nc "${PROJECT_SOURCE_DIR}/CHANGELOG.md" OUTPUT_FILE "${debian}/changelog.gz"
  COMMAND_ERROR_IS_FATAL ANY)
install(FILES "${debian}/changelog.gz" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT runtime)
function(rollrig_install_debian_files package component)
  install(FILES "${debian}/copyright" "${debian}/changelog.Debian.gz"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${package}" COMPONENT ${component})
  install(FILES "${templates}/${package}.lintian-overrides" RENAME ${package}
    DESTINATION "${CMAKE_INSTALL_DATADIR}/lintian/overrides" COMPONENT ${component})
endfunction()
rollrig_install_debian_files(rollrig runtime)
rollrig_install_debian_files(rollrig-dev development)
rollrig_install_debian_files(python3-rollrig python)
if(NOT ROLLRIG_PYTHON_FOUND)
  message(FATAL_ERROR "The Debian packages need pybind11: tools/install_packages.sh packages_package.txt")
endif()

# The loader's cache follows the libraries by a trigger, and shlibs says to packages of others what to depend on.
file(WRITE "${debian}/triggers" "activate-noawait ldconfig\n")
set(soversion "${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}")
file(WRITE "${debian}/shlibs"
  "librollrig ${soversion} rollrig (= ${package_version})\nlibrollrig_cvodes ${soversion} rollrig (= ${package_version})\n\
librollrig_multibody ${soversion} rollrig (= ${package_version})\n\
librollrig_least_squares ${soversion} rollrig (= ${package_version})\n")

# What cpack reads at its start. It would find the dependencies by itself, but then also write scripts that call
# ldconfig, which a package must leave to the trigger.
file(WRITE "${debian}/control" "")  # dpkg-shlibdeps does not start without
math(EXPR next_python_minor "${Python3_VERSION_MINOR} + 1")
configure_file("${templates}/cpack.cmake.in" "${debian}/cpack.cmake" @ONLY)
set(CPACK_PROJECT_CONFIG_FILE "${debian}/cpack.cmake")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "${ROLLRIG_MAINTAINER}")
set(CPACK_COMPONENTS_ALL runtime development python)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_PACKAGE_VERSION "${package_version}")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME rollrig)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA "${debian}/shlibs;${debian}/triggers")
set(CPACK_DEBIAN_RUNTIME_DESCRIPTION "virtual rolling-resistance laboratory
rollrig simulates tire tests on multibody test rigs, and vehicles on rollers
and on the road, with temperature-dependent tire loss: ISO 28580, coastdowns,
dynamometer settings, SAE J1634 multi-cycle tests.

It also finds out why a measurement and the simulation differ, and names the
physical effect or sensor error that explains the difference.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME rollrig-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "rollrig (= ${package_version})")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "virtual rolling-resistance laboratory (C++ development files)
rollrig simulates tire tests on multibody test rigs, and vehicles on rollers
and on the road, with temperature-dependent tire loss.

This package contains the headers of its C++ library, and the files by which
CMake and pkg-config find it.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-rollrig)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-pandas")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${templates}/python/postinst;${templates}/python/prerm")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "virtual rolling-resistance laboratory (Python 3)
rollrig simulates tire tests on multibody test rigs, and vehicles on rollers
and on the road, with temperature-dependent tire loss.

This package contains the Python package rollrig: runs, sweeps, fits and
diagnoses, with results as NumPy arrays.")
include(CPack)

# ctest --preset package_test
enable_testing()
foreach(test contents install reproducible)
  add_test(NAME "packages: ${test}"
    COMMAND "${PROJECT_SOURCE_DIR}/tests/package/${test}_test.sh" "${PROJECT_BINARY_DIR}")
  set_tests_properties("packages: ${test}" PROPERTIES SKIP_RETURN_CODE 77)
endforeach()
