# Fails where codespell knows a misspelling in pages, sources and scenes; tests misspell on purpose.
#   cmake -DROOT=<source directory> -P check_spelling.cmake
find_program(CODESPELL codespell)
if(NOT CODESPELL)
  message("skipped: codespell is not installed")
  return()
endif()
# "statics" is a subject, "to and fro" a way, "tread" what a step has, "Numer." a journal's.
execute_process(COMMAND ${CODESPELL} --ignore-words-list statics,fro,tread,numer --skip *.html,*.svg,*.json,*.csv,*.geojson,*.msh,*.vtu
  README.md polyfem ddacontact apps doc examples WORKING_DIRECTORY ${ROOT} COMMAND_ERROR_IS_FATAL ANY)
