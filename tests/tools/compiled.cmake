# Watching a .slo, of which there is no source: prints what sltest says. SLC, SLTEST, INPUT and FOLDER are given.
file(MAKE_DIRECTORY ${FOLDER})
execute_process(COMMAND ${SLC} -o ${FOLDER}/watched.slo ${INPUT} COMMAND_ERROR_IS_FATAL ANY)
foreach(option --debuguninit --coverage --probe=watched.sl:10:sum)
  execute_process(COMMAND ${SLTEST} ${FOLDER}/watched.slo -g 3 1 -o result null ${option} RESULT_VARIABLE status
    OUTPUT_VARIABLE out ERROR_VARIABLE out)
  message("${status}: ${out}")
  if(option STREQUAL "--coverage" AND NOT out MATCHES "no source file of a shader was run")
    message(FATAL_ERROR "coverage of a compiled shader")
  endif()
endforeach()
message(FATAL_ERROR "done")
