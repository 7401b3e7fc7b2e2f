# What polydda::polyfem needs, and the target. The others are needed for linking only.
find_dependency(Eigen3 3.4 NO_MODULE)
find_dependency(SuiteSparse)
find_dependency(GEOS)
find_dependency(Threads)
find_dependency(OpenMP COMPONENTS CXX)
find_dependency(LibDeflate)
find_dependency(pugixml)
include(${CMAKE_CURRENT_LIST_DIR}/polydda-polyfem-targets.cmake)
