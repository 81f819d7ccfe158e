// Residuals of a lens calibration, summed in square parts of the image.
#pragma once

#include <vector>

#include "dotpose/tools/calibrate.hpp"

namespace dotpose::draw {

struct ResidualField {
    struct Part {
        PixelPoint before;  ///< sum of the residuals before the calibration, in px
        PixelPoint after;   ///< sum of the residuals after the calibration, in px
        int dots = 0;
    };

    double part_px = 0;  ///< side of a part
    int columns = 0;
    int rows = 0;
    std::vector<Part> parts;  ///< row by row
};

ResidualField residual_field(const LensCalibration& calibration);

}  // namespace dotpose::draw
