/// Host functions that a firmware program needs. Each target implements them.
#pragma once

#include <cstddef>

namespace host {

/// Opens the file for reading. Returns false on failure.
bool open(const char* path);

/// Reads `size` bytes. Returns false if fewer bytes are left in the file.
bool read(void* bytes, std::size_t size);

/// Prints to standard output.
void print(const char* text);

}  // namespace host
