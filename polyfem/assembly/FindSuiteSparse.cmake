# Finds CHOLMOD and UMFPACK and the BLAS that they use, and defines the imported targets SuiteSparse::CHOLMOD,
# SuiteSparse::UMFPACK and SuiteSparse::BLAS.
find_path(SUITESPARSE_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
find_library(CHOLMOD_LIBRARY cholmod)
find_library(UMFPACK_LIBRARY umfpack)
find_library(BLAS_LIBRARY blas)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(SuiteSparse REQUIRED_VARS CHOLMOD_LIBRARY UMFPACK_LIBRARY BLAS_LIBRARY
  SUITESPARSE_INCLUDE_DIR)
foreach(part IN ITEMS CHOLMOD UMFPACK BLAS)
  if(SuiteSparse_FOUND AND NOT TARGET SuiteSparse::${part})
    add_library(SuiteSparse::${part} UNKNOWN IMPORTED)
    set_target_properties(SuiteSparse::${part} PROPERTIES
      IMPORTED_LOCATION ${${part}_LIBRARY}
      INTERFACE_INCLUDE_DIRECTORIES ${SUITESPARSE_INCLUDE_DIR})
  endif()
endforeach()
mark_as_advanced(SUITESPARSE_INCLUDE_DIR CHOLMOD_LIBRARY UMFPACK_LIBRARY BLAS_LIBRARY)
