# Promotions to double would link soft-float code into a core that must run without an FPU. Silent
# narrowing would break the bounds of fixed-point numbers. Both are reported as warnings, and as
# errors in the preset `dev`.
add_compile_options(
    -Wall -Wextra -Wpedantic
    -Wconversion -Wdouble-promotion -Wshadow
    -Wold-style-cast -Wcast-align -Wcast-qual
    -Wnon-virtual-dtor -Woverloaded-virtual -Wextra-semi
    -Wformat=2 -Wimplicit-fallthrough -Wundef -Wunused -Wvla)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options(-Wduplicated-cond -Wlogical-op)
endif()
