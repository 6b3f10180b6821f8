# The shared library shows exactly the functions that its header declares, under a version, and bears its SONAME.
execute_process(COMMAND "${NM}" --dynamic --defined-only "${LIBRARY}" OUTPUT_VARIABLE shown COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^ \n]+\n" shown "${shown}")
list(TRANSFORM shown STRIP)
list(FILTER shown EXCLUDE REGEX "^GEOLOC_0$")  # the version itself
list(SORT shown)

file(READ "${HEADER}" text)
string(REGEX MATCHALL "[ *](geoloc_[a-z_]+)\\(" declared "${text}")
list(FILTER declared EXCLUDE REGEX "geoloc_(create|counters|explain|last_error)\\($")  # comments name these, too
list(TRANSFORM declared REPLACE "[ *(]" "")
list(APPEND declared geoloc_create geoloc_explain geoloc_last_error)
list(REMOVE_DUPLICATES declared)
list(TRANSFORM declared APPEND "@@GEOLOC_0")
list(SORT declared)
if(NOT shown STREQUAL declared)
  message(FATAL_ERROR "shown:    ${shown}\ndeclared: ${declared}")
endif()

execute_process(COMMAND "${READELF}" --dynamic "${LIBRARY}" OUTPUT_VARIABLE dynamic COMMAND_ERROR_IS_FATAL ANY)
if(NOT dynamic MATCHES "SONAME[^\n]*\\[${SONAME}\\]")
  message(FATAL_ERROR "no SONAME ${SONAME} in\n${dynamic}")
endif()
