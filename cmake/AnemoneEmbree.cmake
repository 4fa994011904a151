# The target embree: Embree 4, or Embree 3, which is what Debian 12 has.
find_package(embree 4 QUIET)
if(NOT embree_FOUND)
  find_package(embree 3 REQUIRED)
endif()
