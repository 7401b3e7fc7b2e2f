# Fails when clang does not take what the build takes, with its flags and warnings; looks at the syntax alone:
#   cmake -DCLANG=<clang++> -DCOMMANDS=<compile_commands.json> -DROOT=<source directory> -DSCRATCH=<directory> -DOF=<what> -P check_clang.cmake
# OF=headers: all headers of the libraries, in one file; OF=sources: every source of the libraries and the program.

# Runs clang on `source` with the flags of a line of compile_commands.json.
function(check line source)
  string(REGEX REPLACE ",$" "" line "${line}")
  string(JSON command GET "{${line}}" command)
  separate_arguments(flags UNIX_COMMAND "${command}")
  list(POP_FRONT flags compiler)
  list(FILTER flags EXCLUDE REGEX "^(--param=|-Wno-subobject-linkage)")  # what GCC alone knows
  foreach(flag -o -c -include)  # go with the file named behind; the last names headers that GCC has precompiled
    list(FIND flags ${flag} place)
    if(NOT place EQUAL -1)
      list(REMOVE_AT flags ${place})
      list(REMOVE_AT flags ${place})
    endif()
  endforeach()
  execute_process(COMMAND ${CLANG} ${flags} -fsyntax-only ${source} RESULT_VARIABLE result ERROR_VARIABLE messages)
  if(NOT result EQUAL 0)
    message(SEND_ERROR "clang does not compile ${source}:\n${messages}")
  endif()
endfunction()

file(STRINGS ${COMMANDS} lines REGEX "\"command\": .* -c [^ ]*/(polyfem|ddacontact|apps)/[^ ]*\\.cpp\"")
list(FILTER lines EXCLUDE REGEX " -c [^ ]*/(tests|polyfem/dealii)/")
list(FILTER lines EXCLUDE REGEX " -o tests/")  # the same sources with the flags of a test
if(NOT lines)
  message(SEND_ERROR "${COMMANDS} has no source of the libraries")
elseif(OF STREQUAL "sources")
  foreach(line IN LISTS lines)
    string(REGEX MATCH " -c ([^ ]*\\.cpp)\"" found "${line}")
    check("${line}" ${CMAKE_MATCH_1})
  endforeach()
else()
  file(GLOB_RECURSE headers RELATIVE ${ROOT} ${ROOT}/polyfem/*.hpp ${ROOT}/ddacontact/*.hpp)
  list(FILTER headers EXCLUDE REGEX "^polyfem/dealii/")
  list(TRANSFORM headers REPLACE "(.+)" "#include <\\1>\n")
  string(JOIN "" text ${headers})
  file(WRITE ${SCRATCH}/all_headers.cpp "${text}")
  list(FILTER lines INCLUDE REGEX " -c [^ ]*/ddacontact/scene/builder\\.cpp\"")  # sees all that headers include
  check("${lines}" ${SCRATCH}/all_headers.cpp)
endif()
