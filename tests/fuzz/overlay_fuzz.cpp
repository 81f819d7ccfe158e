// Fuzzes `overlay_pdf` with arbitrary documents, with and without conversion of their colours. It
// must write the document with dots, or throw Error.
#include <filesystem>

#include "dotpose/tools/overlay.hpp"
#include "reads_or_refuses.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace dotpose;
    static const std::filesystem::path kOut =
        std::filesystem::temp_directory_path() / ("overlay_fuzz-" + std::to_string(getpid()));
    OverlayOptions options;
    // These options produce few dots, and set limits that short inputs can reach.
    options.pattern.spacing_mm = 8;
    options.max_content_mb = 1;
    for (const bool changes_colours : {false, true}) {
        options.black_to_cmy = changes_colours;
        options.under = changes_colours;
        fuzz::reads_or_refuses(data, size,
                               [&](const std::string& path) { overlay_pdf(path, kOut, options); });
    }
    std::filesystem::remove(kOut);
    return 0;
}
