/// Checks file readers: a reader must either return normally, or throw Error with a message.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string>

#include "dotpose/files/error.hpp"
#include "memory_file.hpp"

namespace dotpose::fuzz {

/// Calls `read` with the path of a file that contains these bytes. An exception other than Error
/// terminates the fuzzer.
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
