// Fuzzes `next_line` with arbitrary text. It must return lines of limited length, or throw Error.
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "dotpose/files/error.hpp"
#include "files/input_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::istringstream stream({reinterpret_cast<const char*>(data), size});
    std::string joined;
    try {
        for (std::string line; dotpose::files::next_line(stream, line);) {
            if (line.size() > 65536 || line.find('\n') != std::string::npos) std::abort();
            joined += line + '\n';
        }
    } catch (const dotpose::Error&) {
        return 0;
    }
    const std::string text(reinterpret_cast<const char*>(data), size);
    if (joined != text && joined != text + '\n') std::abort();
    return 0;
}
