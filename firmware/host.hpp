/// The functions of the machine that a firmware program needs; each target implements them.
#pragma once

#include <cstddef>

namespace host {

/// Opens the file to read. Returns false if there is none.
bool open(const char* path);

/// Reads `size` bytes. Returns false if fewer are left.
bool read(void* bytes, std::size_t size);

/// Prints to standard output.
void print(const char* text);

}  // namespace host
