/// Simulates a printer and a flatbed scanner, independently of src/simulate. Dots are discs at
/// their true positions, drawn with anti-aliasing, blur and noise.
#pragma once

#include <cstdint>
#include <span>

#include "dotpose/files/sheet.hpp"
#include "dotpose/tools/grey_image.hpp"

namespace dotpose::test {

struct ScanSettings {
    double dpi = 600;
    double scale_x = 1;  ///< scale of the print
    double scale_y = 1;
    double rotation_rad = 0;  ///< rotation of the page in the scan, clockwise
    double skew_rad = 0;      ///< deviation of the angle between the page's axes from a right angle
    double dot_growth = 1;    ///< factor by which the diameters of the dots are multiplied
    double missing = 0;       ///< fraction of missing dots
    double jitter_mm = 0.004;  ///< standard deviation of the dot positions, per axis
    double wave_mm = 0;  ///< amplitude of uneven paper feed: a sine along y with a period of 100 mm
    double blur_sigma_px = 0.6;
    double noise_sigma = 2;
    double paper_level = 230;
    double ink_level = 34.5;  ///< 15 % of the paper level
    std::uint32_t seed = 1;
};

/// Returns a scan of a page that contains the given sheets. All sheets have the same page size.
GreyImage scan_page(std::span<const Sheet> sheets, const ScanSettings& settings);

inline GreyImage scan_page(const Sheet& sheet, const ScanSettings& settings) {
    return scan_page(std::span(&sheet, 1), settings);
}

}  // namespace dotpose::test
