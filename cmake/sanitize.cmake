if(DOTPOSE_SANITIZE)
    # Disables recovery, because a report that does not fail the test would go unnoticed.
    add_compile_options(-fsanitize=${DOTPOSE_SANITIZE} -fno-sanitize-recover=all
                        -fno-omit-frame-pointer)
    # fuzzer-no-link only instruments. Each fuzz target links libFuzzer's main itself.
    add_link_options(-fsanitize=${DOTPOSE_SANITIZE})
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        # Suppresses false alarms in the standard library, which GCC's manual mentions for
        # instrumented code.
        add_compile_options(-Wno-maybe-uninitialized)
    endif()
    # Makes std::span check its index.
    add_compile_definitions(_GLIBCXX_ASSERTIONS)
endif()
