# FLANN's headers. Its pkg-config file asks for HDF5 and MPI, which the templates that are used here do not need; they
# need LZ4. Gives Flann::flann.
find_path(Flann_INCLUDE_DIR flann/algorithms/kdtree_single_index.h)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Flann REQUIRED_VARS Flann_INCLUDE_DIR)
if(Flann_FOUND AND NOT TARGET Flann::flann)
  add_library(Flann::flann INTERFACE IMPORTED)
  set_target_properties(Flann::flann PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${Flann_INCLUDE_DIR}")
endif()
mark_as_advanced(Flann_INCLUDE_DIR)
