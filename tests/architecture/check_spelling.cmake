# Fails where codespell knows a misspelling in pages, sources and scenes; tests misspell on purpose.
#   cmake -DCODESPELL=<program> -DROOT=<source directory> -P check_spelling.cmake
# "statics" is a subject, "to and fro" a way, "tread" what a step has, "Numer." a journal's.
execute_process(COMMAND ${CODESPELL} --ignore-words-list statics,fro,tread,numer --skip *.html,*.svg,*.json,*.csv,*.geojson,*.msh,*.vtu
  README.md polyfem ddacontact apps doc examples WORKING_DIRECTORY ${ROOT} COMMAND_ERROR_IS_FATAL ANY)
