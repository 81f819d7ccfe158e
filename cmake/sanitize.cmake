if(DOTPOSE_SANITIZE)
    # Disables recovery, because a report that does not fail the test would go unnoticed.
    add_compile_options(-fsanitize=${DOTPOSE_SANITIZE} -fno-sanitize-recover=all
                        -fno-omit-frame-pointer)
    # fuzzer-no-link only instruments the code. Each fuzz target links libFuzzer's main itself.
    add_link_options(-fsanitize=${DOTPOSE_SANITIZE})
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        # Suppresses false positives in the standard library. According to GCC's manual, they are to
        # be expected in instrumented code.
        add_compile_options(-Wno-maybe-uninitialized)
    endif()
    # Enables the index checks of std::span.
    add_compile_definitions(_GLIBCXX_ASSERTIONS)
endif()
