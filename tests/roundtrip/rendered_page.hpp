/// Pages of a PDF as free renderers paint them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dotpose::roundtrip {

/// A grey page: 0 is black, row by row.
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

/// One page, from 1, with smooth edges. Throws std::runtime_error if the renderer fails.
GreyPage render(const std::string& renderer, const std::filesystem::path& pdf, int dpi,
                int page = 1);

/// Its black ink alone, by Ghostscript: what infrared light shows, which passes through cyan,
/// magenta and yellow.
GreyPage render_black(const std::filesystem::path& pdf, int dpi, int page);

/// Runs a shell command; throws std::runtime_error with its output unless it ends with status 0.
/// Returns what it printed.
std::string run(const std::string& command);

}  // namespace dotpose::roundtrip
