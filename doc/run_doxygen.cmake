# Runs DOXYGEN on doc/Doxyfile of SOURCE, pages go to OUTPUT/html. Every warning is an error but one: members of classes
# need a sentence only where their name does not say it (types and free functions always do).
execute_process(COMMAND ${CMAKE_COMMAND} -E env POLYDDA_DOC_DIRECTORY=${OUTPUT} ${DOXYGEN} doc/Doxyfile
  WORKING_DIRECTORY ${SOURCE} RESULT_VARIABLE result ERROR_VARIABLE warnings OUTPUT_QUIET)
string(REGEX REPLACE "[^\n]*: warning: Member [^\n]* of (class|struct|union) [^\n]* is not documented\\.\n" ""
  warnings "${warnings}")
if(NOT result EQUAL 0 OR NOT warnings STREQUAL "")
  message("${warnings}")
  message(FATAL_ERROR "Doxygen complains")
endif()
if(NOT EXISTS ${OUTPUT}/html/classddacontact_1_1Stepper.html)
  message(FATAL_ERROR "Doxygen wrote no page on Stepper")
endif()
