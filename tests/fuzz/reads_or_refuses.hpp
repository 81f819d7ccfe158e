/// What holds for every reader of files: it returns, or throws Error with words.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string>

#include "dotpose/files/error.hpp"
#include "memory_file.hpp"

namespace dotpose::fuzz {

/// Hands `read` the path of a file with these bytes. What it throws otherwise ends the fuzzer.
template <typename Read>
int reads_or_refuses(const std::uint8_t* data, std::size_t size, Read read) {
    static MemoryFile file;
    file.set(data, size);
    try {
        read(file.path());
    } catch (const Error& error) {
        if (std::string(error.what()).empty()) std::abort();
    }
    return 0;
}

}  // namespace dotpose::fuzz
