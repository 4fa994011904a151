# find_package(slplugin): compiles functions for shaders, plug-ins of slc, sltest and slrender (docs/plugins.md).
#
#   slplugin(NAME sources... [LIBS libraries...])
#
# makes the shared library NAME.so of C or C++ sources that include shadeop.h or RslPlugin.h. Its folder, as of any
# module the target property LIBRARY_OUTPUT_DIRECTORY, is what --dso or ANEMONE_DSO_PATH name.
if(NOT DEFINED SLPLUGIN_INCLUDE_DIR)
  get_filename_component(SLPLUGIN_INCLUDE_DIR "${CMAKE_CURRENT_LIST_DIR}/@SLPLUGIN_RELATIVE@" ABSOLUTE)
endif()
set(SLPLUGIN_INCLUDE_DIR "${SLPLUGIN_INCLUDE_DIR}" CACHE INTERNAL "Headers of plug-ins for shaders")

function(slplugin name)
  cmake_parse_arguments(arg "" "" "LIBS" ${ARGN})
  add_library(${name} MODULE ${arg_UNPARSED_ARGUMENTS})
  set_target_properties(${name} PROPERTIES PREFIX "" SUFFIX .so)
  target_include_directories(${name} SYSTEM PRIVATE ${SLPLUGIN_INCLUDE_DIR})
  target_link_libraries(${name} PRIVATE ${arg_LIBS})
endfunction()
