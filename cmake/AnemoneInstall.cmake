# What `cmake --install` puts where, beside programs and shaders: the libraries with their headers, CMake packages
# `slvm`, `slc` and `ri`, RSL headers. Included last, when all targets exist.
include(CMakePackageConfigHelpers)

# sl_package(NAME targets...): exports targets as NAME::..., with NAME-config.cmake from cmake/.
function(sl_package package)
  set(folder ${CMAKE_INSTALL_LIBDIR}/cmake/${package})
  foreach(target IN LISTS ARGN)
    string(REGEX REPLACE "^${package}_" "" name ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  endforeach()
  install(TARGETS ${ARGN} EXPORT ${package}-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/anemone)
  install(EXPORT ${package}-targets NAMESPACE ${package}:: DESTINATION ${folder})
  configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/${package}-config.cmake.in
    ${PROJECT_BINARY_DIR}/cmake/${package}-config.cmake INSTALL_DESTINATION ${folder})
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/cmake/${package}-config-version.cmake
    COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/cmake/${package}-config.cmake
    ${PROJECT_BINARY_DIR}/cmake/${package}-config-version.cmake DESTINATION ${folder})
endfunction()

sl_package(slvm slvm slvm_plugin slvm_ir slvm_kernels slvm_wide slvm_format slvm_support)
sl_package(slc slc)
if(ANEMONE_RENDER)
  sl_package(ri ri render_setup render render_texture render_rib sl_scattering sl_subsurface)
  install(FILES ${PROJECT_SOURCE_DIR}/render/ri/ri.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/anemone)
endif()

install(CODE "set(SOURCE \"${PROJECT_SOURCE_DIR}\")
set(DESTINATION \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}/anemone\")")
install(SCRIPT ${PROJECT_SOURCE_DIR}/cmake/install_headers.cmake)

# For plug-ins: their headers, and package `slplugin` with the function of that name.
install(DIRECTORY slvm/plugin/sdk/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/anemone/plugin)
set(slplugin_folder ${CMAKE_INSTALL_LIBDIR}/cmake/slplugin)
file(RELATIVE_PATH SLPLUGIN_RELATIVE ${CMAKE_INSTALL_PREFIX}/${slplugin_folder}
  ${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}/anemone/plugin)
configure_file(cmake/slplugin-config.cmake ${PROJECT_BINARY_DIR}/cmake/slplugin-config.cmake @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/cmake/slplugin-config.cmake DESTINATION ${slplugin_folder})

# For reading: the compiler has them built in.
install(DIRECTORY stdlib/include/ DESTINATION ${CMAKE_INSTALL_DATADIR}/anemone/include)
