# The programs in the pages, but for README's (readme_program.cmake) and Python's (tests/python), compile against the installed tree as
# they stand: they are parts of a function that has what the text around them speaks of.
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")
set(source "${WORK_DIR}/pages")
file(REMOVE_RECURSE "${source}")
set(cpp "#include <geoloc/geoloc.hpp>

using namespace geoloc;
void log(const char* line);
int report(const std::vector<std::string>& problems);

")
set(c "#include <geoloc/geoloc.h>
#include <stdio.h>

")
set(given_cpp "Geolocator& geolocator, const GeolocatorConfig& config, const AttitudeSample& attitude, const PositionSample& position, const FrameDetections& frame")
set(given_c "const geoloc_camera camera")
set(count_cpp 0)
set(count_c 0)
file(GLOB pages "${CMAKE_CURRENT_LIST_DIR}/../../docs/*.md")
foreach(page IN LISTS pages)
  file(READ "${page}" rest)
  while(rest MATCHES "\n```(cpp|c)\n([^`]*)```(.*)$")
    set(language "${CMAKE_MATCH_1}")
    set(block "${CMAKE_MATCH_2}")
    set(rest "${CMAKE_MATCH_3}")
    math(EXPR count_${language} "${count_${language}} + 1")
    string(APPEND ${language} "int block_${count_${language}}(${given_${language}});\n"
      "int block_${count_${language}}(${given_${language}}) {\n  {\n${block}  }\n  return 0;\n}\n\n")
  endwhile()
endforeach()
if(count_cpp LESS 2 OR count_c LESS 1)
  message(FATAL_ERROR "found ${count_cpp} programs in C++ and ${count_c} in C")
endif()
file(WRITE "${source}/pages.cpp" "${cpp}")
file(WRITE "${source}/pages.c" "${c}")
file(WRITE "${source}/CMakeLists.txt" "cmake_minimum_required(VERSION 3.22)
project(pages CXX C)
find_package(geoloc 0.1 REQUIRED)
add_library(pages OBJECT pages.cpp pages.c)
target_compile_options(pages PRIVATE -fsyntax-only -Wall -Wextra -Werror -Wno-unused-parameter)
target_link_libraries(pages PRIVATE geoloc::geoloc)
")
run("${CMAKE_COMMAND}" -S "${source}" -B "${source}/build" -G "${GENERATOR}" "-DCMAKE_PREFIX_PATH=${tree}"
  "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}" "-DCMAKE_C_COMPILER=${C_COMPILER}" "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}")
run("${CMAKE_COMMAND}" --build "${source}/build")
