/// Pages of a PDF document, rendered by open-source programs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dotpose::roundtrip {

/// The grey levels of a page, row by row. 0 is black.
struct GreyPage {
    int width_px = 0;
    int height_px = 0;
    std::vector<std::uint8_t> grey;

    std::uint8_t at(int u, int v) const {
        return grey[static_cast<std::size_t>(v) * static_cast<std::size_t>(width_px) +
                    static_cast<std::size_t>(u)];
    }
};

inline constexpr const char* kRenderers[] = {"pdftoppm", "gs", "mutool"};

/// Renders a page, numbered from 1, with anti-aliasing. Throws std::runtime_error if the renderer
/// fails.
GreyPage render(const std::string& renderer, const std::filesystem::path& pdf, int dpi,
                int page = 1);

/// Renders only the black ink of a page with Ghostscript. An infrared camera sees this image,
/// because cyan, magenta and yellow are transparent to infrared light.
GreyPage render_black(const std::filesystem::path& pdf, int dpi, int page);

/// Runs a shell command, and returns its output. If the exit status is not 0, throws
/// std::runtime_error with the output.
std::string run(const std::string& command);

}  // namespace dotpose::roundtrip
