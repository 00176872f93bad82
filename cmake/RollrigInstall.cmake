# cmake --install: programs, libraries, headers, assets, manual page, completions, and find_package(rollrig).
# Two components: runtime, and development, which is what only programs of others need to be compiled.
include(CMakePackageConfigHelpers)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME runtime)

# The shared library is found, and the assets are, wherever the prefix moves. The build tree has programs and libraries in
# the same folders as the prefix, so that a program needs no other path when it is installed. (CMake would append an
# empty entry to a path that it is to replace, and the loader would look for libraries in the working folder.)
file(RELATIVE_PATH rollrig_libraries_from_programs "/${CMAKE_INSTALL_BINDIR}" "/${CMAKE_INSTALL_LIBDIR}")
set_target_properties(rollrig_cvodes ${rollrig_loaded_libraries} rollrig_library PROPERTIES
  LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}" INSTALL_RPATH "$ORIGIN")
set(rollrig_programs rollrig rollrig_serve_program)
if(ROLLRIG_MPI_FOUND AND NOT ROLLRIG_DEBIAN_PACKAGES)  # a package would depend on Open MPI for all users
  list(APPEND rollrig_programs rollrig_mpi)
endif()
set_target_properties(${rollrig_programs} PROPERTIES INSTALL_RPATH "$ORIGIN/${rollrig_libraries_from_programs}")
if(NOT ROLLRIG_DEBIAN_PACKAGES)  # packages have no such path at all, since their libraries are the system's
  set_target_properties(${rollrig_programs} ${rollrig_loaded_libraries} rollrig_library PROPERTIES BUILD_WITH_INSTALL_RPATH ON)
endif()
install(TARGETS ${rollrig_programs} RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
install(DIRECTORY assets/ DESTINATION "${CMAKE_INSTALL_DATADIR}/rollrig/assets")

install(FILES "${PROJECT_BINARY_DIR}/cli/rollrig.1.gz" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
install(FILES "${PROJECT_BINARY_DIR}/cli/rollrig.bash" RENAME rollrig
  DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
set(rollrig_zsh_folder zsh/site-functions)
if(ROLLRIG_DEBIAN_PACKAGES)  # Debian's zsh reads another folder for packages
  set(rollrig_zsh_folder zsh/vendor-completions)
endif()
install(FILES "${PROJECT_BINARY_DIR}/cli/_rollrig" DESTINATION "${CMAKE_INSTALL_DATADIR}/${rollrig_zsh_folder}")
install(FILES "${PROJECT_BINARY_DIR}/cli/rollrig.fish" DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d")
install(FILES README.md CITATION.cff NOTICE.md DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(DIRECTORY docs DESTINATION "${CMAKE_INSTALL_DOCDIR}" FILES_MATCHING PATTERN "*.md" PATTERN images EXCLUDE)
# A Debian package has them as copyright and changelog.gz.
install(FILES LICENSE CHANGELOG.md DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT source_documents)

# The library: rollrig::rollrig, and behind it CVODES (sim/CMakeLists.txt) and what is
# loaded when it is needed (cmake/RollrigLoadedLibraries.cmake).
install(TARGETS rollrig_library EXPORT rollrigTargets
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" NAMELINK_COMPONENT development)
install(TARGETS rollrig_cvodes ${rollrig_loaded_libraries} LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" NAMELINK_SKIP)

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)
install(DIRECTORY include/rollrig DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
set(rollrig_cmake_folder "${CMAKE_INSTALL_LIBDIR}/cmake/rollrig")
install(EXPORT rollrigTargets NAMESPACE rollrig:: DESTINATION "${rollrig_cmake_folder}")
set(rollrig_assets_folder "${CMAKE_INSTALL_DATADIR}/rollrig/assets")
configure_package_config_file(cmake/rollrigConfig.cmake.in "${PROJECT_BINARY_DIR}/rollrigConfig.cmake"
  INSTALL_DESTINATION "${rollrig_cmake_folder}" PATH_VARS rollrig_assets_folder)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/rollrigConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/rollrigConfig.cmake" "${PROJECT_BINARY_DIR}/rollrigConfigVersion.cmake"
  DESTINATION "${rollrig_cmake_folder}")

# pkg-config, with a prefix that follows where the file is.
set(rollrig_pkg_config_folder "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
string(REGEX REPLACE "[^/]+" ".." rollrig_prefix_from_pkg_config "${rollrig_pkg_config_folder}")
configure_file(cmake/rollrig.pc.in "${PROJECT_BINARY_DIR}/rollrig.pc" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/rollrig.pc" DESTINATION "${rollrig_pkg_config_folder}")
