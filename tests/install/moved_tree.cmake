# Installs, and moves what was installed: no file of it may know where it was.
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")
set(prefix "${WORK_DIR}/prefix")
file(REMOVE_RECURSE "${prefix}" "${tree}")
run("${CMAKE_COMMAND}" --install "${BUILD_DIR}" --prefix "${prefix}")
file(RENAME "${prefix}" "${tree}")
