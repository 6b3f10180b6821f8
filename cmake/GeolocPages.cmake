# Pages of the manual and completions for the shells, made from what the programs say with --help, as packages have them.
set(_pages "${PROJECT_SOURCE_DIR}/packaging/pages")
set(_pages_made "${PROJECT_BINARY_DIR}/share/man/man1/geoloc_app.1.gz")
add_custom_command(OUTPUT "${_pages_made}"
  COMMAND "${Python3_EXECUTABLE}" -B "${_pages}/make_pages.py" "${PROJECT_VERSION}" "${PROJECT_BINARY_DIR}/share" ${_program_files}
    --emulator ${CMAKE_CROSSCOMPILING_EMULATOR}
  DEPENDS
    "${_pages}/completions.py" "${_pages}/make_pages.py" "${_pages}/man_page.py" "${_pages}/program_help.py" ${_programs}
  VERBATIM)
add_custom_target(geoloc_pages ALL DEPENDS "${_pages_made}")
foreach(_folder IN ITEMS man bash-completion zsh fish)
  install(DIRECTORY "${PROJECT_BINARY_DIR}/share/${_folder}" DESTINATION "${CMAKE_INSTALL_DATADIR}" COMPONENT programs)
endforeach()
