# The JUnit report of a run with failures and a missing file. SLTEST, HERE and FILE are given.
execute_process(COMMAND ${SLTEST} failing.toml nowhere.toml --quick --junit ${FILE} WORKING_DIRECTORY ${HERE}
  OUTPUT_QUIET ERROR_QUIET)
file(READ ${FILE} text)
foreach(part "<testsuite name=\"failing.toml\" tests=\"4\" failures=\"3\" errors=\"0\" time="
    "<testcase name=\"passes\" classname=\"failing.toml\" file=\"failing.toml\" line=\"21\" time="
    "<failure message=\"predicate 'result &lt; 0.7' fails at 1 of 3 points"
    "<testsuite name=\"nowhere.toml\" tests=\"1\" failures=\"0\" errors=\"1\""
    "<testcase name=\"file\" classname=\"nowhere.toml\"><error message=\"missing or wrong\"/></testcase>")
  string(FIND "${text}" "${part}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "'${part}' is missing in:\n${text}")
  endif()
endforeach()
message("the report is right")
