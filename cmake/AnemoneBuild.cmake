# Build conventions shared by every folder: language level, warnings, sanitizers, ccache,
# and the few helper functions that keep each CMakeLists.txt a list of sources.
include(GNUInstallDirs)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
# Build types beside CMake's own: optimised with assertions, and for sanitizers.
set(CMAKE_CXX_FLAGS_RELASSERT "-O2 -g1")
set(CMAKE_CXX_FLAGS_SANITIZE "-O1 -g1")
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
set(ANEMONE_PLUGIN_FOLDER "${PROJECT_BINARY_DIR}/dso") # slvm::standard_plugin_folder()

find_program(ANEMONE_CCACHE ccache)
if(ANEMONE_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${ANEMONE_CCACHE}")
endif()

add_library(anemone_flags INTERFACE)
target_compile_options(anemone_flags INTERFACE -Wall -Wextra -Wshadow -Wconversion
  -Wno-sign-conversion -Wnon-virtual-dtor -Woverloaded-virtual
  $<$<CXX_COMPILER_ID:GNU>:-Werror> # the daily compiler; others only build the fuzzers
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> # GCC 12 warns of assigning text to a std::string (its bug 105651)
  $<$<CXX_COMPILER_ID:Clang>:-fconstexpr-steps=100000000>) # the table of shadeops is parsed at compile time
# Results must not depend on which operations a compiler chose to contract, and infinities and
# NaNs follow IEEE 754: shaders rely on both.
target_compile_options(anemone_flags INTERFACE -ffp-contract=off -fno-math-errno)
set(instrumentation "")
if(ANEMONE_SANITIZE)
  list(APPEND instrumentation -fsanitize=${ANEMONE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all
    -Wno-maybe-uninitialized -Wno-clobbered) # instrumented code of the standard library looks so to GCC
  target_link_options(anemone_flags INTERFACE -fsanitize=${ANEMONE_SANITIZE})
endif()
if(ANEMONE_FUZZ)
  list(APPEND instrumentation -fsanitize=fuzzer-no-link) # feedback for the fuzzer
  # Not the kernels: input does not steer them, and clang takes minutes for each.
  list(TRANSFORM instrumentation REPLACE "(.+)" "$<$<NOT:$<STREQUAL:$<TARGET_PROPERTY:NAME>,slvm_kernels>>:\\1>")
endif()
target_compile_options(anemone_flags INTERFACE ${instrumentation})

# sl_library(NAME sources... [PUBLIC libs...] [PRIVATE libs...]): a static library whose headers
# are included from the repository root ("slvm/machine.h").
function(sl_library name)
  cmake_parse_arguments(arg "" "" "PUBLIC;PRIVATE" ${ARGN})
  add_library(${name} STATIC ${arg_UNPARSED_ARGUMENTS})
  target_include_directories(${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/anemone>)
  target_compile_features(${name} PUBLIC cxx_std_20)
  target_link_libraries(${name} PUBLIC ${arg_PUBLIC} PRIVATE $<BUILD_INTERFACE:anemone_flags> ${arg_PRIVATE})
endfunction()

# sl_archived(OUT "shared libraries" names...): what a library links to get these. Programs with the property SL_ARCHIVED
# take the archives of those names first, and of the shared libraries only what these leave open: fewer are loaded at
# each start. Where an archive is missing, or needs more than is named, all get the shared libraries.
include(CheckCXXSourceCompiles)
function(sl_archived out shared)
  set(${out} ${shared} PARENT_SCOPE)
  foreach(name ${ARGN})
    find_library(ANEMONE_ARCHIVE_${name} NAMES lib${name}.a)
    if(NOT ANEMONE_ARCHIVE_${name})
      return()
    endif()
    list(APPEND archives "${ANEMONE_ARCHIVE_${name}}")
  endforeach()
  list(GET archives 0 whole)
  set(CMAKE_REQUIRED_LIBRARIES "-Wl,--whole-archive" ${whole} "-Wl,--no-whole-archive" ${archives} ${shared})
  list(GET ARGN 0 first)
  check_cxx_source_compiles("int main() { return 0; }" ANEMONE_ARCHIVED_${first})
  if(NOT ANEMONE_ARCHIVED_${first})
    return()
  endif()
  set(archived "$<BOOL:$<TARGET_PROPERTY:SL_ARCHIVED>>")
  foreach(library ${archives} "-Wl,--as-needed")
    list(APPEND libraries "$<${archived}:${library}>")
  endforeach()
  set(${out} ${libraries} ${shared} PARENT_SCOPE)
endfunction()

# All programs that are installed, without tests and benchmarks.
add_custom_target(tools)

# sl_tool(NAME sources... LIBS libs...): a command-line program, installed.
function(sl_tool name)
  cmake_parse_arguments(arg "" "" "LIBS" ${ARGN})
  add_executable(${name} ${arg_UNPARSED_ARGUMENTS})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE anemone_flags ${arg_LIBS})
  # The standard library first: most symbols are looked up there, and each library before it is searched in
  # vain, for a tenth of the time a program takes to start. (Sanitizers have to be first themselves.)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT ANEMONE_SANITIZE)
    target_link_options(${name} PRIVATE LINKER:--push-state,--no-as-needed -lstdc++ LINKER:--pop-state)
  endif()
  install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  add_dependencies(tools ${name})
endfunction()

# sl_module(NAME sources... LIBS libs...): NAME.so beside the programs, which they load when they need it; installed.
function(sl_module name)
  cmake_parse_arguments(arg "" "" "LIBS" ${ARGN})
  add_library(${name} MODULE ${arg_UNPARSED_ARGUMENTS})
  set_target_properties(${name} PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${CMAKE_RUNTIME_OUTPUT_DIRECTORY})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE anemone_flags ${arg_LIBS})
  install(TARGETS ${name} LIBRARY DESTINATION lib/anemone)
endfunction()

# sl_standard_plugin(NAME sources... LIBS libs...): functions for shaders in NAME.so, in the folder that programs know;
# the target is dso_NAME.
function(sl_standard_plugin name)
  cmake_parse_arguments(arg "" "" "LIBS" ${ARGN})
  slplugin(dso_${name} ${arg_UNPARSED_ARGUMENTS} LIBS anemone_flags ${arg_LIBS})
  set_target_properties(dso_${name} PROPERTIES OUTPUT_NAME ${name} LIBRARY_OUTPUT_DIRECTORY ${ANEMONE_PLUGIN_FOLDER})
  target_include_directories(dso_${name} PRIVATE ${PROJECT_SOURCE_DIR})
  install(TARGETS dso_${name} LIBRARY DESTINATION lib/anemone/dso)
  add_dependencies(tools dso_${name})
endfunction()

# sl_unit_test(NAME sources... LIBS libs... [LABEL slow]): a GoogleTest binary whose cases CTest lists one by one.
function(sl_unit_test name)
  cmake_parse_arguments(arg "" "LABEL" "LIBS" ${ARGN})
  if(NOT arg_LABEL)
    set(arg_LABEL fast)
  endif()
  find_package(GTest REQUIRED)
  include(GoogleTest)
  add_executable(${name} ${arg_UNPARSED_ARGUMENTS})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE anemone_flags ${arg_LIBS} GTest::gtest_main GTest::gmock)
  set(timeout 120)
  if(ANEMONE_SANITIZE) # many times slower
    set(timeout 900)
  endif()
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES LABELS ${arg_LABEL} TIMEOUT ${timeout})
endfunction()

# sl_embed(TARGET HEADER FUNCTION PREFIX PATTERN): the files that match, as texts in the library: FUNCTION, declared in
# HEADER, gives them, each named PREFIX and its file name.
function(sl_embed target header function prefix pattern)
  file(GLOB files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${pattern})
  string(REPLACE ";" "|" list "${files}")
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${function}.cpp)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DHEADER=${header} -DNAMESPACE=${target} -DFUNCTION=${function}
      -DPREFIX=${prefix} -DFILES=${list} -P ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
    DEPENDS ${files} ${PROJECT_SOURCE_DIR}/cmake/embed.cmake VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
