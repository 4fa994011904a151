# sl_shader_tests(PREFIX files...): one CTest for each test file of sltest.
function(sl_shader_tests prefix)
  foreach(file IN LISTS ARGN)
    get_filename_component(name ${file} NAME_WE)
    add_test(NAME ${prefix}.${name} COMMAND sltest ${file})
    set_tests_properties(${prefix}.${name} PROPERTIES LABELS fast)
  endforeach()
endfunction()
