# Finds the library fmt. Python wheels compile fmt from its headers, because not every system has
# the library.
option(DOTPOSE_FMT_HEADER_ONLY "Compile fmt from its headers, so nothing needs libfmt at run time")
if(DOTPOSE_FMT_HEADER_ONLY)
    find_path(DOTPOSE_FMT_HEADERS fmt/core.h)
    if(DOTPOSE_FMT_HEADERS)
        add_library(fmt::fmt INTERFACE IMPORTED GLOBAL)
        target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY=1)
        target_include_directories(fmt::fmt SYSTEM INTERFACE ${DOTPOSE_FMT_HEADERS})
    endif()
else()
    find_package(fmt QUIET)
endif()
