# What polydda::ddascene needs beside ddacontact, and the target. toml++ is needed for linking only: some systems have it as
# a library.
find_dependency(tomlplusplus 3.3)
include(${CMAKE_CURRENT_LIST_DIR}/polydda-ddacontact-targets.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/polydda-ddascene-targets.cmake)
