# Functions that make every target of the project: one place for the language level, warnings, sanitizers and
# folders.

find_program(GEOLOC_CCACHE ccache)
if(GEOLOC_CCACHE AND PROJECT_IS_TOP_LEVEL AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${GEOLOC_CCACHE}")
endif()

# The checks that were asked for, whatever the language: warnings as errors, sanitizers.
function(geoloc_set_checks target)
  if(GEOLOC_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(GEOLOC_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${GEOLOC_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(${target} PRIVATE -fsanitize=${GEOLOC_SANITIZE})
  endif()
endfunction()

# Flags are for our own code only, so they are never part of an exported interface.
function(geoloc_set_flags target)
  target_compile_features(${target} PUBLIC cxx_std_17)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
  # Indices are std::size_t, Eigen's are signed: clang, and clang-tidy, take -Wconversion to include that.
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion)
  # No object holds where its source lay: it is the same of every clone, for ccache and for those who build packages again.
  target_compile_options(${target} PRIVATE "-ffile-prefix-map=${PROJECT_SOURCE_DIR}/=")
  if(NOT CMAKE_UNITY_BUILD)  # in a unity build, names of one file hide those of another
    target_compile_options(${target} PRIVATE -Wshadow)
  endif()
  geoloc_set_checks(${target})
  if(GEOLOC_BUILD_FUZZERS)
    target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all)
    target_link_options(${target} PRIVATE -fsanitize=address,undefined)
  endif()
endfunction()

# For programs in C: what any C99 compiler takes, without extensions and without a warning.
function(geoloc_set_c99_flags target)
  set_target_properties(${target} PROPERTIES C_STANDARD 99 C_STANDARD_REQUIRED ON C_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE -Wall -Wextra -pedantic -Wconversion -Wstrict-prototypes)
  geoloc_set_checks(${target})
endfunction()

# For code that only joins other code, and runs at most some thousand times per second: a third less time to compile.
function(geoloc_optimise_lightly)
  foreach(target IN LISTS ARGN)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endforeach()
endfunction()

# geoloc_add_library(geoloc_io_mavlink ALIAS io_mavlink SOURCES a.cpp … PUBLIC libs… PRIVATE libs…)
# makes the static library and its name geoloc::io_mavlink. OR_SHARED: shared where BUILD_SHARED_LIBS says so; C++ has no stable
# binary interface, so that its SONAME is the whole version.
function(geoloc_add_library target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "OR_SHARED" "ALIAS" "SOURCES;PUBLIC;PRIVATE")
  if(arg_OR_SHARED AND BUILD_SHARED_LIBS)
    add_library(${target} SHARED ${arg_SOURCES})
    set_target_properties(${target} PROPERTIES VERSION "${PROJECT_VERSION}" SOVERSION "${PROJECT_VERSION}")
  else()
    add_library(${target} STATIC ${arg_SOURCES})
  endif()
  add_library(geoloc::${arg_ALIAS} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${arg_ALIAS})
  geoloc_set_flags(${target})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}/src")  # headers that users need not read
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
endfunction()

# geoloc_add_program(geoloc_sim SOURCES … LIBRARIES …): a program in <build>/bin.
function(geoloc_add_program target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LIBRARIES")
  add_executable(${target} ${arg_SOURCES})
  geoloc_set_flags(${target})
  geoloc_optimise_lightly(${target})
  target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}/src")
  target_link_libraries(${target} PRIVATE ${arg_LIBRARIES})
  get_property(_libraries_elsewhere GLOBAL PROPERTY GEOLOC_INSTALL_RPATH)
  set_target_properties(${target} PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin" INSTALL_RPATH "${_libraries_elsewhere}")
endfunction()

# geoloc_add_test(tracking SOURCES a_test.cpp … LIBRARIES …): one GoogleTest program per module, each case a ctest
# test. APART: its files have helpers with the same names, so they are never compiled as one (CMAKE_UNITY_BUILD).
function(geoloc_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "APART" "TIMEOUT" "SOURCES;LIBRARIES")
  set(target ${name}_test)
  add_executable(${target} ${arg_SOURCES})
  geoloc_set_flags(${target})
  geoloc_optimise_lightly(${target})
  # Helpers of the same name stand in several files of the larger tests.
  set_target_properties(${target} PROPERTIES UNITY_BUILD_BATCH_SIZE 8)
  if(arg_APART)
    set_target_properties(${target} PROPERTIES UNITY_BUILD OFF)
  endif()
  # It replaces operator new, whose definition must not be visible to its callers.
  set_source_files_properties("${PROJECT_SOURCE_DIR}/tests/support/allocation_counter.cpp"
    PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}/tests" "${PROJECT_SOURCE_DIR}/src")
  target_link_libraries(${target} PRIVATE ${arg_LIBRARIES} source_tree GTest::gtest GTest::gtest_main)
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 120)
  endif()
  gtest_discover_tests(${target} TEST_PREFIX "${name}." PROPERTIES TIMEOUT ${arg_TIMEOUT} DISCOVERY_TIMEOUT 60)
endfunction()
