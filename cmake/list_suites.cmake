# ctest runs this script for each program of dotpose_discover_suites. It adds a test for each suite that the
# program lists.
cmake_policy(VERSION 3.25)
if(NOT EXISTS ${program})
    add_test(${prefix}_NOT_BUILT ${program})
    return()
endif()
execute_process(COMMAND ${program} --gtest_list_tests "--gtest_filter=*${filter}"
                OUTPUT_VARIABLE lines RESULT_VARIABLE status)
if(NOT status EQUAL 0)
    message(FATAL_ERROR "${program} cannot list its tests")
endif()
# A line that is not indented is the name of a suite. The cases of the suite are indented.
string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+\\." suites "${lines}")
list(TRANSFORM suites STRIP)
list(REMOVE_DUPLICATES suites)
# The exclusions in the filter also apply to the cases of each suite.
string(REGEX MATCH "-.*" excluded "${filter}")
foreach(suite IN LISTS suites)
    string(REPLACE "." "" name ${suite})
    set(all_labels ${labels})
    if(name IN_LIST slow)
        list(APPEND all_labels slow)
    endif()
    if(name MATCHES "AtLength$")
        list(APPEND all_labels nightly)
    endif()
    add_test(${prefix}.${name} ${program} "--gtest_filter=${suite}*${excluded}")
    set_tests_properties(${prefix}.${name} PROPERTIES WORKING_DIRECTORY ${directory} LABELS "${all_labels}"
                         FIXTURES_REQUIRED "${fixture}")
    if(name IN_LIST first)
        set_tests_properties(${prefix}.${name} PROPERTIES COST 100)
    endif()
endforeach()
