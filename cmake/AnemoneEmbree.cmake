# The target embree: Embree 4, or Embree 3, which is what Debian 12 has.
find_package(embree 4 QUIET GLOBAL)
if(NOT embree_FOUND)
  find_package(embree 3 REQUIRED GLOBAL)
endif()
# The target embree_later: for code that loads it when it is needed (render/rays/embree_library.h).
if(NOT TARGET embree_later)
  add_library(embree_later INTERFACE)
  target_include_directories(embree_later SYSTEM INTERFACE $<TARGET_PROPERTY:embree,INTERFACE_INCLUDE_DIRECTORIES>)
  target_compile_definitions(embree_later INTERFACE EMBREE_LIBRARY="$<TARGET_SONAME_FILE_NAME:embree>")
endif()
