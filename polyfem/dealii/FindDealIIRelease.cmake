# Finds deal.II's release library and defines the imported target DealII::release. Only paths are taken from deal.II's own
# package: its flags would override those of a project, and its list of libraries names more than two hundred. Those its
# headers call are found through its library instead.
find_package(deal.II 9.4 QUIET)
if(deal.II_FOUND)
  find_library(DEAL_II_RELEASE_LIBRARY deal.ii deal_II HINTS ${DEAL_II_PATH}/${DEAL_II_LIBRARY_RELDIR})
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(DealIIRelease
  REQUIRED_VARS DEAL_II_RELEASE_LIBRARY DEAL_II_INCLUDE_DIRS
  REASON_FAILURE_MESSAGE "deal.II 9.4 or newer with its release library is needed. deal.II_DIR may say where it is.")
if(DealIIRelease_FOUND AND NOT TARGET DealII::release)
  add_library(DealII::release UNKNOWN IMPORTED)
  set_target_properties(DealII::release PROPERTIES
    IMPORTED_LOCATION ${DEAL_II_RELEASE_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES "${DEAL_II_INCLUDE_DIRS}"
    INTERFACE_LINK_OPTIONS LINKER:--copy-dt-needed-entries)
endif()
mark_as_advanced(DEAL_II_RELEASE_LIBRARY)
