# Defines opencv_core, opencv_imgproc, … as targets, from OpenCV's own CMake package if there is one, otherwise from the
# libraries themselves: Debian's small packages (libopencv-dnn-dev …) are a fraction of libopencv-dev, the only one with
# the CMake package. Every folder that uses OpenCV must include this, because imported targets are visible only there.
include_guard(DIRECTORY)
set(_components core imgproc imgcodecs calib3d dnn)
find_package(OpenCV 4.5 QUIET COMPONENTS ${_components})
if(NOT OpenCV_FOUND AND NOT TARGET opencv_core)
  find_path(GEOLOC_OPENCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4)
  foreach(_component IN LISTS _components)
    find_library(GEOLOC_OPENCV_${_component} opencv_${_component})
    if(NOT GEOLOC_OPENCV_INCLUDE_DIR OR NOT GEOLOC_OPENCV_${_component})
      message(FATAL_ERROR "OpenCV's ${_component} is missing: apt-get install libopencv-${_component}-dev, "
                          "or build the library alone with -DGEOLOC_BUILD_IO=OFF -DGEOLOC_BUILD_SIM=OFF")
    endif()
    add_library(opencv_${_component} SHARED IMPORTED GLOBAL)
    set_target_properties(opencv_${_component} PROPERTIES
      IMPORTED_LOCATION "${GEOLOC_OPENCV_${_component}}"
      INTERFACE_INCLUDE_DIRECTORIES "${GEOLOC_OPENCV_INCLUDE_DIR}")
  endforeach()
endif()
