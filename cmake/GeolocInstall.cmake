# The library as find_package(geoloc), which gives geoloc::geoloc, and as pkg-config's module geoloc; either needs Eigen and
# GeographicLib alone, and may be moved with its prefix. The library for C is find_package(geoloc COMPONENTS c), which gives
# geoloc::geoloc_c, and geoloc_c; they need nothing to be compiled with. Programs, model and flights go beside them.
include(CMakePackageConfigHelpers)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME dev)  # what is not said to be of lib or programs (GeolocPackages.cmake)

set(_package "${CMAKE_INSTALL_LIBDIR}/cmake/geoloc")
install(TARGETS geoloc EXPORT geoloc ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(FILES "${PROJECT_SOURCE_DIR}/include/geoloc/geoloc.hpp" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/geoloc")
set(_public_modules calibration camera fleet geometry pipeline projection state tracking)
foreach(_module IN LISTS _public_modules)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/geoloc/${_module}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/geoloc")
endforeach()

install(EXPORT geoloc NAMESPACE geoloc:: DESTINATION "${_package}" FILE geoloc-targets.cmake)
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/geoloc-config.cmake.in"
  "${PROJECT_BINARY_DIR}/geoloc-config.cmake" INSTALL_DESTINATION "${_package}")
if(TARGET geoloc_c)
  install(TARGETS geoloc_c EXPORT geoloc_c
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT lib NAMELINK_COMPONENT dev)
  install(FILES "${PROJECT_SOURCE_DIR}/include/geoloc/geoloc.h" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/geoloc")
  install(EXPORT geoloc_c NAMESPACE geoloc:: DESTINATION "${_package}" FILE geoloc-c-targets.cmake)
endif()
write_basic_package_version_file("${PROJECT_BINARY_DIR}/geoloc-config-version.cmake" COMPATIBILITY SameMinorVersion)
install(FILES
  "${PROJECT_BINARY_DIR}/geoloc-config.cmake"
  "${PROJECT_BINARY_DIR}/geoloc-config-version.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/FindGeographicLib.cmake"
  DESTINATION "${_package}")

# A static library carries no record of what it needs, so GeographicLib is among the public requirements: pkg-config leaves
# private ones out unless it is told --static.
set(_pkg_config "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
if(IS_ABSOLUTE "${_pkg_config}")
  set(_pc_prefix "${CMAKE_INSTALL_PREFIX}")
else()
  file(RELATIVE_PATH _prefix_from_here "/${_pkg_config}" "/")
  string(REGEX REPLACE "/$" "" _pc_prefix "\${pcfiledir}/${_prefix_from_here}")
endif()
set(_pc_libdir "\${prefix}")
set(_pc_includedir "\${prefix}")
cmake_path(APPEND _pc_libdir "${CMAKE_INSTALL_LIBDIR}")  # replaces the prefix where the folder is absolute
cmake_path(APPEND _pc_includedir "${CMAKE_INSTALL_INCLUDEDIR}")
set(_modules geoloc)
if(TARGET geoloc_c)
  list(APPEND _modules geoloc_c)
endif()
foreach(_module IN LISTS _modules)
  configure_file("${PROJECT_SOURCE_DIR}/cmake/${_module}.pc.in" "${PROJECT_BINARY_DIR}/${_module}.pc" @ONLY)
  install(FILES "${PROJECT_BINARY_DIR}/${_module}.pc" DESTINATION "${_pkg_config}")
endforeach()

set(_programs)
set(_program_files)
foreach(_program IN ITEMS geoloc_app geoloc_detect geoloc_eval geoloc_fuse geoloc_import geoloc_replay geoloc_sim)
  if(TARGET ${_program})
    install(TARGETS ${_program} RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT programs)
    list(APPEND _programs ${_program})
    list(APPEND _program_files "$<TARGET_FILE:${_program}>")
  endif()
endforeach()
if(TARGET geoloc_app)
  install(FILES "${PROJECT_SOURCE_DIR}/packaging/geoloc.service" DESTINATION lib/systemd/system COMPONENT programs)
endif()
find_package(Python3 COMPONENTS Interpreter)
if(TARGET geoloc_app AND Python3_FOUND AND NOT GEOLOC_SANITIZE AND (CMAKE_CROSSCOMPILING_EMULATOR OR NOT CMAKE_CROSSCOMPILING))
  include(GeolocPages)
endif()
if(GEOLOC_BUILD_APPS)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/data/models" "${PROJECT_SOURCE_DIR}/data/flights"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/geoloc" COMPONENT programs)
  if(TARGET geoloc_geoid)
    install(DIRECTORY "${PROJECT_BINARY_DIR}/share/geoloc/geoids" DESTINATION "${CMAKE_INSTALL_DATADIR}/geoloc" COMPONENT programs)
  endif()
endif()
