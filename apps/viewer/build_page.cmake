# Builds the page of `dda view` from its sources:
#   cmake -DESBUILD=<program> -DOUT=<page.html> -P build_page.cmake
set(here ${CMAKE_CURRENT_LIST_DIR})
foreach(source main.ts style.css)
  execute_process(COMMAND ${ESBUILD} ${here}/${source} --bundle --minify --target=es2020 --charset=utf8 --log-level=warning
    OUTPUT_VARIABLE ${source} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
file(READ ${here}/skeleton.html page)
string(REPLACE "@STYLE@" "${style.css}" page "${page}")
string(REPLACE "@SCRIPT@" "${main.ts}" page "${page}")
file(WRITE ${OUT} "${page}")
