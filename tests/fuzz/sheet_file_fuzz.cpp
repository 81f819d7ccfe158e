// Fuzzes `read_sheets` with arbitrary files. It must return sheets that can be printed, or throw
// Error.
#include <cstdlib>

#include "dotpose/files/sheet_file.hpp"
#include "reads_or_refuses.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace dotpose;
    return fuzz::reads_or_refuses(data, size, [](const std::string& path) {
        for (const SheetEntry& entry : read_sheets(path)) {
            if (entry.sheet.columns < 1 || entry.sheet.rows < 1) std::abort();
            if (!(entry.sheet.pattern.spacing_mm > 0)) std::abort();
        }
    });
}
