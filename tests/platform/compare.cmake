# Runs PROGRAM, a list of a program and its arguments, and compares its output with the file EXPECTED.
execute_process(COMMAND ${PROGRAM} OUTPUT_VARIABLE lines COMMAND_ERROR_IS_FATAL ANY)
# Windows ends lines with CR LF.
string(REPLACE "\r" "" lines "${lines}")
file(READ ${EXPECTED} expected)
if(NOT lines STREQUAL expected)
    message(FATAL_ERROR "The lines differ from ${EXPECTED}")
endif()
