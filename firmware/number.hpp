#pragma once

#include <cstdint>

/// Prints a blank, followed by the number in decimal.
void print_number(std::int64_t number);
