# dotpose_layer(NAME [PURE] [SOURCES file...] [EXCEPT file...] [USES target...])
#
# Defines a layer: one directory of src/, compiled to the object library dotpose_NAME_layer.
# src/CMakeLists.txt combines the layers into the installed libraries. SOURCES: compiles only these sources of
# the directory. EXCEPT: compiles all sources except these. PURE: the layer must not use the heap, exceptions,
# RTTI or dependencies (scripts/check-core-symbols proves it).
function(dotpose_layer name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "PURE" "" "SOURCES;EXCEPT;USES")
    dotpose_sources(sources)
    set(target dotpose_${name}_layer)
    add_library(${target} OBJECT ${sources})
    target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR}/include
                                                ${PROJECT_SOURCE_DIR}/src)
    if(NOT DOTPOSE_FIRMWARE AND NOT EMSCRIPTEN)
        # Shared libraries, and modules that link the static libraries, need position-independent code. Only
        # names declared in include/dotpose are visible, so internal calls are direct.
        set_target_properties(${target} PROPERTIES
            POSITION_INDEPENDENT_CODE ON
            CXX_VISIBILITY_PRESET hidden
            VISIBILITY_INLINES_HIDDEN ON)
        target_compile_options(${target} PRIVATE -fno-semantic-interposition)
    endif()
    foreach(used IN LISTS arg_USES)
        target_link_libraries(${target} PUBLIC $<TARGET_NAME_IF_EXISTS:${used}>)
    endforeach()
    if(arg_PURE)
        # A unity build would recompile several sources after a change to one source.
        set_target_properties(${target} PROPERTIES UNITY_BUILD OFF)
        target_compile_options(${target} PRIVATE -fno-exceptions -fno-rtti -fno-threadsafe-statics
                                                 -ffunction-sections -fdata-sections)
        if(DOTPOSE_SANITIZE MATCHES "fuzzer")
            # Tracing every comparison of numbers makes the core ten times slower and does not find any
            # faults.
            target_compile_options(${target} PRIVATE -fno-sanitize-coverage=trace-cmp)
        endif()
    else()
        dotpose_allow_promotion(${target})
        if(TARGET dotpose_base_layer AND NOT name STREQUAL "base")
            dotpose_share_headers(${target} dotpose_base_layer)
            # The precompiled headers include fmt.
            target_link_libraries(${target} PRIVATE fmt::fmt)
        endif()
        if(NOT EMSCRIPTEN)
            # librsvg requires -pthread, and all layers share the precompiled headers.
            target_compile_options(${target} PRIVATE -pthread)
        endif()
    endif()
endfunction()

# dotpose_library(NAME LAYERS layer... [PUBLIC target...] [PRIVATE target...]): defines the installed
# library NAME, which is shared if BUILD_SHARED_LIBS is set. Users link dotpose_print as dotpose::print,
# both in this tree and installed. The project's own programs, which use internals, link NAME_inside,
# which is always static because a shared library hides its internals.
function(dotpose_library name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "LAYERS;PUBLIC;PRIVATE")
    set(objects)
    foreach(layer IN LISTS arg_LAYERS)
        list(APPEND objects $<TARGET_OBJECTS:dotpose_${layer}_layer>)
    endforeach()
    add_library(${name} ${objects})
    dotpose_set_up_library(${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
    string(REGEX REPLACE "^dotpose_" "" short ${name})
    add_library(dotpose::${short} ALIAS ${name})
    set_target_properties(${name} PROPERTIES EXPORT_NAME ${short})
    if(BUILD_SHARED_LIBS)
        set_target_properties(${name} PROPERTIES
            VERSION ${DOTPOSE_INTERFACE}.${PROJECT_VERSION}
            SOVERSION ${DOTPOSE_INTERFACE})
        add_library(${name}_inside STATIC EXCLUDE_FROM_ALL ${objects})
        list(TRANSFORM arg_PUBLIC APPEND _inside)
        dotpose_set_up_library(${name}_inside PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
    else()
        add_library(${name}_inside ALIAS ${name})
    endif()
endfunction()

function(dotpose_set_up_library name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "PUBLIC;PRIVATE")
    target_compile_features(${name} PUBLIC cxx_std_20)
    target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                              $<INSTALL_INTERFACE:include>)
    target_link_libraries(${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
    # The library consists of objects only, so CMake cannot deduce the linker language.
    set_target_properties(${name} PROPERTIES LINKER_LANGUAGE CXX)
endfunction()

# dotpose_sources(RESULT): for functions with the arguments SOURCES and EXCEPT. Sets RESULT to SOURCES or, if
# SOURCES is not given, to all sources of the directory that are not in EXCEPT and not for another operating
# system (*_posix.cpp, *_windows.cpp).
macro(dotpose_sources result)
    set(${result} ${arg_SOURCES})
    if(NOT ${result})
        file(GLOB_RECURSE ${result} CONFIGURE_DEPENDS *.cpp)
        list(TRANSFORM arg_EXCEPT PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
        list(REMOVE_ITEM ${result} ${arg_EXCEPT})
        if(WIN32)
            list(FILTER ${result} EXCLUDE REGEX "_posix[.]cpp$")
        else()
            list(FILTER ${result} EXCLUDE REGEX "_windows[.]cpp$")
        endif()
    endif()
endmacro()

# dotpose_program(NAME [LIGHT] [SOURCES file...] [EXCEPT file...] [LIBRARIES part...] [USES target...]
# [HEADERS_OF target]): defines a program from the given sources, or from all sources of the
# directory that are not in EXCEPT. LIGHT: see dotpose_compile_light. LIBRARIES: see
# dotpose_use_internals. HEADERS_OF: see dotpose_share_headers.
function(dotpose_program name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "LIGHT" "HEADERS_OF" "SOURCES;EXCEPT;LIBRARIES;USES")
    dotpose_sources(sources)
    add_executable(${name} ${sources})
    dotpose_use_internals(${name} ${arg_LIBRARIES})
    if(arg_LIGHT OR DOTPOSE_SANITIZE)
        dotpose_compile_light(${name})
    endif()
    target_link_libraries(${name} PRIVATE ${arg_USES})
    if(arg_HEADERS_OF)
        dotpose_share_headers(${name} ${arg_HEADERS_OF})
    endif()
endfunction()

# dotpose_objects(NAME [SOURCES file...] [EXCEPT file...] [USES target...] [HEADERS_OF target]): defines
# an object library of sources that several programs share, compiled once with
# dotpose_compile_light. A program lists all object libraries that it needs, directly or indirectly.
# HEADERS_OF: see dotpose_share_headers.
function(dotpose_objects name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "HEADERS_OF" "SOURCES;EXCEPT;USES")
    dotpose_sources(sources)
    add_library(${name} OBJECT ${sources})
    dotpose_use_internals(${name})
    dotpose_compile_light(${name})
    target_include_directories(${name} PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
    target_link_libraries(${name} PUBLIC ${arg_USES})
    if(arg_HEADERS_OF)
        dotpose_share_headers(${name} ${arg_HEADERS_OF})
    endif()
endfunction()

# dotpose_precompile(TARGET header...): precompiles headers of libraries, which take most of the compile
# time of most sources, and headers of the standard library. A source must still include what it uses,
# because the preset `asan` builds without precompiled headers.
function(dotpose_precompile target)
    target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <filesystem> <functional>
        <map> <memory> <numbers> <optional> <span> <string> <vector> ${ARGN})
    dotpose_allow_array_bounds(${target})
endfunction()

# dotpose_share_headers(TARGET OWNER): uses the headers that were precompiled for OWNER, which must have the
# same compiler options.
function(dotpose_share_headers target owner)
    target_precompile_headers(${target} REUSE_FROM ${owner})
    dotpose_allow_array_bounds(${target})
endfunction()

function(dotpose_allow_array_bounds target)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
        # GCC 12 reports false positives for the standard library if its headers are precompiled.
        target_compile_options(${target} PRIVATE -Wno-array-bounds)
    endif()
endfunction()

# dotpose_compile_light(TARGET): compiles a target with less optimization, which halves the compile
# time. Intended for programs that spend most of their run time in the libraries.
function(dotpose_compile_light target)
    if(DOTPOSE_SANITIZE)
        target_compile_options(${target} PRIVATE -O0)
    else()
        target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
    endif()
endfunction()

# dotpose_use_internals(TARGET [LIBRARY...]): lets tests, benchmarks and the tool include headers of src/ as
# well as include/, and links the libraries of the given parts. Without arguments, links the
# libraries of all parts.
function(dotpose_use_internals name)
    target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/include
                                               ${PROJECT_SOURCE_DIR}/src)
    if(ARGN)
        list(TRANSFORM ARGN REPLACE "(.+)" "dotpose_\\1_inside" OUTPUT_VARIABLE libraries)
        target_link_libraries(${name} PRIVATE ${libraries})
    else()
        target_link_libraries(${name} PRIVATE $<TARGET_NAME_IF_EXISTS:dotpose_tools_inside>)
    endif()
    target_link_libraries(${name} PRIVATE dotpose_inside)
    dotpose_allow_promotion(${name})
endfunction()

# dotpose_allow_promotion(TARGET): disables clang's warning about promotions to double, which are
# harmless outside the core. GCC warns only about unintended promotions, but clang warns about all
# promotions.
function(dotpose_allow_promotion target)
    if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
        target_compile_options(${target} PRIVATE -Wno-double-promotion)
    endif()
endfunction()
