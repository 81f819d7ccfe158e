/// Opens the sources of `dotpose listen`.
#pragma once

#include <string>

namespace dotpose::cli {

/// An open file, pipe or serial device.
struct ByteInput {
    int descriptor = -1;
    bool is_line = false;  ///< true for a serial device, which has no end
};

/// Opens a file, a pipe or a serial device. `baud` is the rate of a serial device, a standard rate
/// from 9,600 to 2,000,000, and is ignored for files and pipes. Throws Error if the source cannot
/// be opened.
ByteInput open_input(const std::string& name, int baud);

}  // namespace dotpose::cli
