# What polydda::ddacontact needs beside polyfem, and the target. toml++ is needed for linking only: some systems have it as
# a library.
find_dependency(tomlplusplus 3.3)
include(${CMAKE_CURRENT_LIST_DIR}/polydda-ddacontact-targets.cmake)
