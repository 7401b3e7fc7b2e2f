# Builds the page anew and compares it with the one that the repository keeps. Other versions of esbuild shorten
# names otherwise.
execute_process(COMMAND ${ESBUILD} --version OUTPUT_VARIABLE version OUTPUT_STRIP_TRAILING_WHITESPACE)
if(NOT version MATCHES "^0\\.17\\.")
  message("skipped: esbuild is ${version}, the page is built by 0.17")
  return()
endif()
execute_process(COMMAND ${CMAKE_COMMAND} -DESBUILD=${ESBUILD} -DOUT=${OUT} -P ${SOURCE}/build_page.cmake
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${OUT} ${SOURCE}/page.html RESULT_VARIABLE differs)
if(differs)
  message(FATAL_ERROR "apps/viewer/page.html is not what its sources give: "
    "cmake -DESBUILD=esbuild -DOUT=apps/viewer/page.html -P apps/viewer/build_page.cmake")
endif()
