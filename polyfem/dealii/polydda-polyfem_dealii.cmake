# What polydda::polyfem_dealii needs beside polyfem, and the target.
find_dependency(DealIIRelease)
include(${CMAKE_CURRENT_LIST_DIR}/polydda-polyfem_dealii-targets.cmake)
