# Runs the tool of another platform (TOOL, a list) and the tool of this machine (NATIVE) with the same arguments in two
# empty folders. Compares their output lines, exit codes and files.

# run(PROGRAM NAME ARGUMENT...): sets NAME_lines and NAME_code. If `input` is set, the program reads this file as
# standard input.
function(run program name)
    set(from)
    if(input)
        set(from INPUT_FILE ${FOLDER}/${input})
    endif()
    execute_process(COMMAND ${program} ${ARGN} WORKING_DIRECTORY ${FOLDER}/${name} ${from}
                    OUTPUT_VARIABLE lines RESULT_VARIABLE code ERROR_VARIABLE notes)
    # Removes the only field that differs from run to run.
    string(REGEX REPLACE "\"elapsed_us\":[0-9.]+" "" lines "${lines}")
    set(${name}_lines "${lines}" PARENT_SCOPE)
    set(${name}_code "${code}" PARENT_SCOPE)
    set(${name}_notes "${notes}" PARENT_SCOPE)
endfunction()

# compare(ARGUMENT...): fails unless both tools print the same lines and succeed.
function(compare)
    run("${TOOL}" tool ${ARGN})
    run("${NATIVE}" native ${ARGN})
    if(NOT tool_code EQUAL 0 OR NOT tool_lines STREQUAL native_lines OR NOT tool_code STREQUAL native_code)
        message(SEND_ERROR "dotpose ${ARGN}\n-- here, exit code ${native_code}:\n${native_lines}${native_notes}\n"
                           "-- there, exit code ${tool_code}:\n${tool_lines}${tool_notes}")
    endif()
endfunction()

# compare_files(NAME...): fails unless both tools have written files with the same bytes.
function(compare_files)
    foreach(name IN LISTS ARGN)
        execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files tool/${name} native/${name}
                        WORKING_DIRECTORY ${FOLDER} RESULT_VARIABLE code)
        if(NOT code EQUAL 0)
            message(SEND_ERROR "${name} differs")
        endif()
    endforeach()
endfunction()

file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER}/tool ${FOLDER}/native)

compare(version)
compare(print -o sheet.pdf)
compare(print -o Prüfblatt.pdf)
compare(print -o 方格.pdf)
compare(print -o 方格.png --dpi 300)
compare(print -o ü.svg)
compare(print --sheets 紙.json --name Übung -o Übung.png)
compare_files(方格.png ü.svg 紙.json Übung.png)

compare(simulate -o Bilder-画 --frames 6 --seed 3)
compare_files(Bilder-画/truth.csv Bilder-画/frame_000000.pgm Bilder-画/frame_000005.pgm)
compare(locate Bilder-画)
compare(locate Bilder-画/frame_000000.pgm Bilder-画/frame_000001.pgm --format csv)
compare(locate Bilder-画/*2.pgm --draw Zeichnung-図.svg)
compare(locate 方格.png --format text)
compare(simulate -o Fahrt-走 --drive --sheets 紙.json --frames 6)
compare(locate --sheets 紙.json Fahrt-走)
compare(sheets list --sheets 紙.json)
compare(sheets rename Übung 机 --sheets 紙.json)
compare_files(紙.json)
compare_files(Zeichnung-図.svg)

# Passes three raw frames through standard input. `tail` removes the 15-byte header of each frame.
execute_process(COMMAND sh -c "for i in 0 1 2; do tail -c +16 native/Bilder-画/frame_00000$i.pgm; done >frames.raw"
                WORKING_DIRECTORY ${FOLDER} COMMAND_ERROR_IS_FATAL ANY)
set(input frames.raw)
compare(locate - --size 188x120 --fps 50)
unset(input)

# The tool reports functions that Windows lacks.
run("${TOOL}" tool watch 0)
if(tool_code EQUAL 0 OR NOT tool_notes MATCHES "does not exist for Windows")
    message(SEND_ERROR "dotpose watch 0, exit code ${tool_code}:\n${tool_notes}")
endif()
