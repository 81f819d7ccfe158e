if(DOTPOSE_SANITIZE)
    # No recovery: a report that lets the test pass would not be seen.
    add_compile_options(-fsanitize=${DOTPOSE_SANITIZE} -fno-sanitize-recover=all
                        -fno-omit-frame-pointer)
    # fuzzer-no-link only instruments; each fuzz target links libFuzzer's main itself.
    add_link_options(-fsanitize=${DOTPOSE_SANITIZE})
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        # False alarms in the standard library; GCC's manual says so of instrumented code.
        add_compile_options(-Wno-maybe-uninitialized)
    endif()
    # std::span does not check its index otherwise.
    add_compile_definitions(_GLIBCXX_ASSERTIONS)
endif()
