/// Opens the input for `dotpose listen`.
#pragma once

#include <string>

namespace dotpose::cli {

/// An open file, pipe or serial device.
struct ByteInput {
    int descriptor = -1;
    bool is_line = false;  ///< true for a serial device, whose input never ends
};

/// Opens a file, a pipe or a serial device. `baud` is one of the standard rates from 9,600 to
/// 2,000,000 and is used only for serial devices. Throws Error if the input cannot be opened.
ByteInput open_input(const std::string& name, int baud);

}  // namespace dotpose::cli
