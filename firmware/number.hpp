#pragma once

#include <cstdint>

/// Prints a space, followed by the number in decimal.
void print_number(std::int64_t number);
