# geoloc_embed_files(target page_files a.html b.css …): builds text files into the program, as a function
# geoloc::io::page_files() that returns them (src/io/embedded_file.hpp). It is generated at build time by running this
# file as a script.
if(CMAKE_SCRIPT_MODE_FILE)
  set(_arrays "")
  set(_entries "")
  foreach(_path IN LISTS FILES)
    get_filename_component(_name "${_path}" NAME)
    string(MAKE_C_IDENTIFIER "${_name}" _symbol)
    file(READ "${_path}" _hex HEX)
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," _bytes "${_hex}")
    string(APPEND _arrays "constexpr char ${_symbol}[] = {${_bytes}};\n")
    string(APPEND _entries "      {\"${_name}\", {${_symbol}, sizeof ${_symbol}}},\n")
  endforeach()
  file(WRITE "${OUTPUT}" "#include <vector>

#include \"${HEADER}\"

namespace geoloc::io {
namespace {

${_arrays}
}  // namespace

const std::vector<EmbeddedFile>& ${FUNCTION}();

const std::vector<EmbeddedFile>& ${FUNCTION}() {
  static const std::vector<EmbeddedFile> files{
${_entries}  };
  return files;
}

}  // namespace geoloc::io
")
  return()
endif()

set(GEOLOC_EMBED_SCRIPT "${CMAKE_CURRENT_LIST_FILE}")
function(geoloc_embed_files target name)
  list(TRANSFORM ARGN PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/" OUTPUT_VARIABLE _paths)
  set(_source "${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp")
  add_custom_command(
    OUTPUT "${_source}"
    COMMAND "${CMAKE_COMMAND}" "-DOUTPUT=${_source}" "-DFUNCTION=${name}" "-DFILES=${_paths}"
      "-DHEADER=${PROJECT_SOURCE_DIR}/src/io/embedded_file.hpp" -P "${GEOLOC_EMBED_SCRIPT}"
    DEPENDS ${_paths} "${GEOLOC_EMBED_SCRIPT}"
    VERBATIM)
  set_source_files_properties("${_source}" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  target_sources(${target} PRIVATE "${_source}")
endfunction()
