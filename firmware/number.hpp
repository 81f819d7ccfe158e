#pragma once

#include <cstdint>

/// Prints a blank and the number in decimal.
void print_number(std::int64_t number);
