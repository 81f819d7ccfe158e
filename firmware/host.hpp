/// Host functions that a firmware program needs. Each target implements them.
#pragma once

#include <cstddef>

namespace host {

/// Opens the file for reading. Returns false if this fails.
bool open(const char* path);

/// Reads `size` bytes. Returns false if the file has fewer bytes left.
bool read(void* bytes, std::size_t size);

/// Prints to standard output.
void print(const char* text);

}  // namespace host
