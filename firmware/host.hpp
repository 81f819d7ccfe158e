/// What a firmware program needs of the machine it runs on: one implementation for each target.
#pragma once

#include <cstddef>

namespace host {

/// Opens the file to read; false where there is none.
bool open(const char* path);

/// Reads `size` bytes; false where fewer are left.
bool read(void* bytes, std::size_t size);

/// Prints to standard output.
void print(const char* text);

}  // namespace host
