# A probed variable goes to its file instead of the screen.
file(MAKE_DIRECTORY ${FOLDER})
file(REMOVE ${FOLDER}/x.csv)
execute_process(COMMAND ${SLTEST} ${INPUT} -g 3 1 --probe watched.sl:31:x -o x ${FOLDER}/x.csv
  OUTPUT_VARIABLE out RESULT_VARIABLE status)
file(READ ${FOLDER}/x.csv table)
if(NOT status EQUAL 0 OR NOT out STREQUAL "" OR NOT table MATCHES "2")
  message(FATAL_ERROR "status ${status}, printed '${out}', stored '${table}'")
endif()
message("the file is right")
