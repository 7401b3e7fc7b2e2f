# The target polydda::ddacontact; it needs nothing beside polyfem.
include(${CMAKE_CURRENT_LIST_DIR}/polydda-ddacontact-targets.cmake)
