# With ccache, unchanged sources are not compiled again in a second checkout or after `make clean`.
# Paths and precompiled headers are hashed relative to the checkout. Replaces a plain ccache
# launcher (CMAKE_CXX_COMPILER_LAUNCHER in the environment), because without these settings ccache
# does not cache sources that use precompiled headers. Comments are part of the hash. If a cached
# precompiled header were made from files with different comments, GCC would include the files again
# in spite of `#pragma once`.
find_program(DOTPOSE_CCACHE ccache)
if(DOTPOSE_CCACHE AND (NOT CMAKE_CXX_COMPILER_LAUNCHER OR CMAKE_CXX_COMPILER_LAUNCHER MATCHES "(^|/)ccache$"))
    set(launcher ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1
                 CCACHE_COMMENTS=1 CCACHE_SLOPPINESS=pch_defines,time_macros ${DOTPOSE_CCACHE})
    set(CMAKE_C_COMPILER_LAUNCHER ${launcher})
    set(CMAKE_CXX_COMPILER_LAUNCHER ${launcher})
    # Clang refuses precompiled headers from the cache if they contain file times.
    if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
        add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:SHELL:-Xclang -fno-pch-timestamp>")
    endif()
endif()

# mold links in a fifth of the time.
find_program(DOTPOSE_MOLD mold)
if(DOTPOSE_MOLD AND NOT CMAKE_CROSSCOMPILING AND NOT EMSCRIPTEN)
    include(CheckLinkerFlag)
    check_linker_flag(CXX -fuse-ld=mold DOTPOSE_LINKS_WITH_MOLD)
    if(DOTPOSE_LINKS_WITH_MOLD)
        add_link_options(-fuse-ld=mold)
    endif()
endif()

# By default, GCC starts to collect garbage at a heap size of 128 MB. A limit of 1 GB reduces the compile time
# of a source by a fifth.
cmake_host_system_information(RESULT memory_mb QUERY TOTAL_PHYSICAL_MEMORY)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND memory_mb GREATER 7000)
    add_compile_options(--param=ggc-min-heapsize=1000000)
endif()
