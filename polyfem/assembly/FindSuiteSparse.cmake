# Finds CHOLMOD and UMFPACK and defines the imported targets SuiteSparse::CHOLMOD and SuiteSparse::UMFPACK.
find_path(SUITESPARSE_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
find_library(CHOLMOD_LIBRARY cholmod)
find_library(UMFPACK_LIBRARY umfpack)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(SuiteSparse REQUIRED_VARS CHOLMOD_LIBRARY UMFPACK_LIBRARY SUITESPARSE_INCLUDE_DIR)
foreach(part IN ITEMS CHOLMOD UMFPACK)
  if(SuiteSparse_FOUND AND NOT TARGET SuiteSparse::${part})
    add_library(SuiteSparse::${part} UNKNOWN IMPORTED)
    set_target_properties(SuiteSparse::${part} PROPERTIES
      IMPORTED_LOCATION ${${part}_LIBRARY}
      INTERFACE_INCLUDE_DIRECTORIES ${SUITESPARSE_INCLUDE_DIR})
  endif()
endforeach()
mark_as_advanced(SUITESPARSE_INCLUDE_DIR CHOLMOD_LIBRARY UMFPACK_LIBRARY)
