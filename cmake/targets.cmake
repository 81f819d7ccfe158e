# dotpose_layer(NAME [PURE] [SOURCES file...] [EXCEPT file...] [USES target...])
#
# One directory of src/ is one layer and one object library dotpose_NAME_layer. The layers are put together
# into the installed libraries in src/CMakeLists.txt. SOURCES: these only, and not all of the directory;
# EXCEPT: all but these.
# PURE: may use no heap, exceptions, RTTI or dependency (scripts/check-core-symbols proves it).
function(dotpose_layer name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "PURE" "" "SOURCES;EXCEPT;USES")
    dotpose_sources(sources)
    set(target dotpose_${name}_layer)
    add_library(${target} OBJECT ${sources})
    target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR}/include
                                                ${PROJECT_SOURCE_DIR}/src)
    if(NOT DOTPOSE_FIRMWARE AND NOT EMSCRIPTEN)
        # For shared libraries, and for modules that others link the static ones into. They show what
        # include/dotpose declares; calls within them are direct.
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
        # One source is compiled again in seconds, after a change to it.
        set_target_properties(${target} PROPERTIES UNITY_BUILD OFF)
        target_compile_options(${target} PRIVATE -fno-exceptions -fno-rtti -fno-threadsafe-statics
                                                 -ffunction-sections -fdata-sections)
        if(DOTPOSE_SANITIZE MATCHES "fuzzer")
            # Tracing every comparison of numbers makes the core ten times slower and finds nothing.
            target_compile_options(${target} PRIVATE -fno-sanitize-coverage=trace-cmp)
        endif()
    else()
        dotpose_allow_promotion(${target})
        if(TARGET dotpose_base_layer AND NOT name STREQUAL "base")
            dotpose_share_headers(${target} dotpose_base_layer)
            # It is among these headers.
            target_link_libraries(${target} PRIVATE fmt::fmt)
        endif()
        if(NOT EMSCRIPTEN)
            # librsvg asks for it, and the headers are precompiled for all layers alike.
            target_compile_options(${target} PRIVATE -pthread)
        endif()
    endif()
endfunction()

# dotpose_library(NAME LAYERS layer... [PUBLIC target...] [PRIVATE target...]): the installed library
# NAME, a shared one with BUILD_SHARED_LIBS. Users know dotpose_print as dotpose::print, in this tree and
# installed. NAME_inside is what the project's own programs link, which look inside: static, as a shared
# library hides its internals.
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
    # The library holds objects only; without a language of its own CMake could not link it.
    set_target_properties(${name} PROPERTIES LINKER_LANGUAGE CXX)
endfunction()

# dotpose_sources(RESULT): within a function with the arguments SOURCES and EXCEPT, the sources named, or
# all of the directory but some.
macro(dotpose_sources result)
    set(${result} ${arg_SOURCES})
    if(NOT ${result})
        file(GLOB_RECURSE ${result} CONFIGURE_DEPENDS *.cpp)
        list(TRANSFORM arg_EXCEPT PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
        list(REMOVE_ITEM ${result} ${arg_EXCEPT})
    endif()
endmacro()

# dotpose_program(NAME [LIGHT] [SOURCES file...] [EXCEPT file...] [LIBRARIES part...] [USES target...]
# [HEADERS_OF target]): one program from the sources named, or from all of the directory but some. LIGHT: see
# dotpose_compile_light. LIBRARIES: see dotpose_use_internals. HEADERS_OF: see dotpose_share_headers.
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

# dotpose_objects(NAME [SOURCES file...] [EXCEPT file...] [USES target...] [HEADERS_OF target]): sources
# that several programs share, compiled once and light. A program names all such targets it needs, also
# those that another one of them uses. HEADERS_OF: see dotpose_share_headers.
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

# dotpose_precompile(TARGET header...): most of the time of most sources goes into headers of libraries,
# which are read once for a target instead, beside those of the standard library. A source includes what
# it uses nevertheless: the preset `asan` builds without.
function(dotpose_precompile target)
    target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <filesystem> <functional>
        <map> <memory> <numbers> <optional> <span> <string> <vector> ${ARGN})
    dotpose_allow_array_bounds(${target})
endfunction()

# dotpose_share_headers(TARGET OWNER): the headers that were precompiled for OWNER, which has the same options.
function(dotpose_share_headers target owner)
    target_precompile_headers(${target} REUSE_FROM ${owner})
    dotpose_allow_array_bounds(${target})
endfunction()

function(dotpose_allow_array_bounds target)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
        # False alarms in the standard library, which GCC 12 keeps silent only outside of such headers.
        target_compile_options(${target} PRIVATE -Wno-array-bounds)
    endif()
endfunction()

# What takes the time of most programs is in the libraries: their own sources are compiled in half
# the time with less care.
function(dotpose_compile_light target)
    if(DOTPOSE_SANITIZE)
        target_compile_options(${target} PRIVATE -O0)
    else()
        target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
    endif()
endfunction()

# dotpose_use_internals(TARGET [LIBRARY...]): tests, benchmarks and the tool may look inside: they see src/ as
# well as include/. They link the libraries of the parts named; without any, those of all parts.
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

# Promotions to double are harmless outside of the core. GCC sees those that might not be meant; clang
# sees them all.
function(dotpose_allow_promotion target)
    if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
        target_compile_options(${target} PRIVATE -Wno-double-promotion)
    endif()
endfunction()
