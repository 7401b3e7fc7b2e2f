# Fails when a file below ROOT includes what its place does not allow:
#   cmake -DROOT=<source directory> -P check_includes.cmake
# Folders of a library include themselves and what stands before them; polyfem knows nothing of ddacontact, the
# libraries nothing of apps, and each third-party library has its place.
set(polyfem_folders core geometry quadrature basis material element mesh assembly io dealii testing)
set(ddacontact_folders core block detection contact solver equations classic time domain output picture page scene study)

# What may include it, as a pattern of paths, for each third-party header.
set(third_party
  "deal\\.II/"                            "^polyfem/dealii/"
  "toml\\+\\+|toml\\.hpp"                 "^ddacontact/scene/"
  "nlohmann/"                             "^ddacontact/(output/|page/|scene/json_(parser|schema)\\.cpp$|study/safety_files\\.cpp$)"
  "fmt/|spdlog/|CLI11|CLI/"               "^apps/"
  "cholmod|umfpack|suitesparse/|cblas|openblas"  "^polyfem/assembly/"
  "libdeflate|pugixml"                    "^polyfem/io/"
  "gtest/|gmock/"                         "^polyfem/testing/"
  "librsvg/|cairo"                        "^apps/dda/rendered_svg\\.cpp$"
  "pybind11/"                             "^apps/python/"
  "geos_c\\.h|geos/"                      "^polyfem/mesh/(.*\\.cpp|geos_context\\.hpp)$")

set(violations "")
file(GLOB_RECURSE files RELATIVE ${ROOT}
  ${ROOT}/polyfem/*.hpp ${ROOT}/polyfem/*.cpp ${ROOT}/ddacontact/*.hpp ${ROOT}/ddacontact/*.cpp
  ${ROOT}/apps/*.hpp ${ROOT}/apps/*.cpp)
foreach(file IN LISTS files)
  string(REGEX MATCH "^([^/]+)/([^/]+)/" place ${file})
  set(library ${CMAKE_MATCH_1})
  set(folder ${CMAKE_MATCH_2})
  if(file STREQUAL "polyfem/polyfem.hpp")  # all of the library in one header: above its folders, for users alone
    set(library polyfem)
    set(rank 1000)
  elseif(NOT library STREQUAL apps)
    list(FIND ${library}_folders "${folder}" rank)
    if(rank EQUAL -1)
      list(APPEND violations "${file}: is in no folder of ${library} that has a place in the order")
    endif()
  endif()

  file(STRINGS ${ROOT}/${file} includes REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"]")
  foreach(line IN LISTS includes)
    string(REGEX REPLACE "^[^<\"]*[<\"]([^>\"]*)[>\"].*$" "\\1" header "${line}")
    if(header MATCHES "^(polyfem|ddacontact|apps)/([^/]+)/")
      set(from ${CMAKE_MATCH_1})
      set(from_folder ${CMAKE_MATCH_2})
      if(library STREQUAL from AND NOT library STREQUAL apps)
        list(FIND ${from}_folders "${from_folder}" from_rank)
        if(from_rank EQUAL -1 OR from_rank GREATER rank)
          list(APPEND violations "${file}: includes upward, <${header}>")
        endif()
        if(folder STREQUAL solver AND from_folder STREQUAL block)
          list(APPEND violations "${file}: solvers see a contact problem and no blocks, <${header}>")
        endif()
      elseif(library STREQUAL polyfem OR (library STREQUAL ddacontact AND from STREQUAL apps))
        list(APPEND violations "${file}: ${library} must not know of <${header}>")
      endif()
    elseif(header STREQUAL "polyfem/polyfem.hpp" AND NOT library STREQUAL apps)
      list(APPEND violations "${file}: <${header}> is for users of the library")
    elseif(header MATCHES "^\\.\\.?/" OR header MATCHES "/\\.\\./")
      list(APPEND violations "${file}: includes by a relative path, \"${header}\"")
    endif()

    set(rules ${third_party})
    while(rules)
      list(POP_FRONT rules pattern allowed)
      if(header MATCHES "^(${pattern})" AND NOT file MATCHES "${allowed}")
        list(APPEND violations "${file}: <${header}> does not belong here")
      endif()
    endwhile()
  endforeach()
endforeach()

list(LENGTH files n_files)
if(n_files EQUAL 0)
  message(FATAL_ERROR "no source files below ${ROOT}")
endif()
if(violations)
  list(JOIN violations "\n  " text)
  message(FATAL_ERROR "includes against the architecture:\n  ${text}")
endif()
message(STATUS "${n_files} files include what they may")
