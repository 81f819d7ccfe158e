/// A printer and a flatbed scanner, made independently of src/simulate: discs at true places on a
/// page, anti-aliased, blurred, with noise.
#pragma once

#include <cstdint>
#include <span>

#include "dotpose/files/sheet.hpp"
#include "dotpose/tools/grey_image.hpp"

namespace dotpose::test {

struct ScanSettings {
    double dpi = 600;
    double scale_x = 1;  ///< of the print
    double scale_y = 1;
    double rotation_rad = 0;   ///< of the page in the scan, clockwise as seen
    double skew_rad = 0;       ///< the page's y axis turned away from its x axis
    double dot_growth = 1;     ///< of the dots' diameters
    double missing = 0;        ///< share of the dots
    double jitter_mm = 0.004;  ///< of each dot, per axis
    double wave_mm = 0;        ///< the carriage runs unevenly: sine along y, over 100 mm
    double blur_sigma_px = 0.6;
    double noise_sigma = 2;
    double paper_level = 230;
    double ink_level = 34.5;  ///< 15 % of the paper
    std::uint32_t seed = 1;
};

/// A scan of a page that shows these sheets, all of one page size.
GreyImage scan_page(std::span<const Sheet> sheets, const ScanSettings& settings);

inline GreyImage scan_page(const Sheet& sheet, const ScanSettings& settings) {
    return scan_page(std::span(&sheet, 1), settings);
}

}  // namespace dotpose::test
