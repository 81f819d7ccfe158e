# Registers a GoogleTest program with CTest, with one test per suite. With one test per case, the
# libraries of the program would be loaded a thousand times.

# dotpose_discover_suites(TARGET PREFIX [FILTER filter] [LABELS label...] [FIXTURE name]): adds the
# tests PREFIX.SUITE. The suites are listed when ctest runs, because a program that crashes while it
# lists them must not fail the build. Suites in DOTPOSE_SLOW_SUITES also have the label `slow`.
# Suites named ...AtLength have the label `nightly`, because they take a long time. Shorter suites
# test the same code in daily builds. The longest suites run first, to keep all cores busy until the
# end.
function(dotpose_discover_suites target prefix)
    cmake_parse_arguments(PARSE_ARGV 2 arg "" "FILTER;FIXTURE" "LABELS")
    set(script ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
    file(GENERATE OUTPUT ${script} CONTENT "
set(program [==[$<TARGET_FILE:${target}>]==])
set(prefix [==[${prefix}]==])
set(filter [==[${arg_FILTER}]==])
set(directory [==[${PROJECT_SOURCE_DIR}]==])
set(labels [==[${arg_LABELS}]==])
set(fixture [==[${arg_FIXTURE}]==])
set(slow [==[${DOTPOSE_SLOW_SUITES}]==])
set(first [==[Dds;Watch;Recording;Mqtt;FleetScale;Hostile;GstreamerDrive]==])
include([==[${PROJECT_SOURCE_DIR}/cmake/list_suites.cmake]==])
")
    set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${script})
endfunction()
