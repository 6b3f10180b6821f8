# The library's CMake package: find_package(geoloc) gives geoloc::geoloc, which depends only on Eigen and
# GeographicLib. Programs, model and flights are installed beside it.
include(CMakePackageConfigHelpers)

set(_package "${CMAKE_INSTALL_LIBDIR}/cmake/geoloc")
install(TARGETS geoloc EXPORT geoloc ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
set(_public_modules calibration camera geometry pipeline projection state tracking)
foreach(_module IN LISTS _public_modules)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/geoloc/${_module}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/geoloc")
endforeach()

install(EXPORT geoloc NAMESPACE geoloc:: DESTINATION "${_package}" FILE geoloc-targets.cmake)
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/geoloc-config.cmake.in"
  "${PROJECT_BINARY_DIR}/geoloc-config.cmake" INSTALL_DESTINATION "${_package}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/geoloc-config-version.cmake" COMPATIBILITY SameMinorVersion)
install(FILES
  "${PROJECT_BINARY_DIR}/geoloc-config.cmake"
  "${PROJECT_BINARY_DIR}/geoloc-config-version.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/FindGeographicLib.cmake"
  DESTINATION "${_package}")

foreach(_program IN ITEMS geoloc_app geoloc_detect geoloc_eval geoloc_replay geoloc_sim)
  if(TARGET ${_program})
    install(TARGETS ${_program} RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
  endif()
endforeach()
if(GEOLOC_BUILD_APPS)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/data/models" "${PROJECT_SOURCE_DIR}/data/flights"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/geoloc")
endif()
