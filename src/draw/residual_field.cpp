#include <algorithm>
#include <cmath>
#include <cstddef>

#include "dotpose/tools/calibrate.hpp"
#include "dotpose/tools/draw.hpp"

namespace dotpose {
namespace {

/// Number of parts into which the longer side of the image is divided.
constexpr int kFieldParts = 22;

void add_residual(PixelPoint& sum, PixelPoint residual) {
    sum.u += residual.u;
    sum.v += residual.v;
}

}  // namespace

ResidualField residual_field(const LensCalibration& calibration) {
    const int width_px = calibration.camera.width_px;
    const int height_px = calibration.camera.height_px;
    ResidualField field;
    field.part_px = static_cast<double>(std::max(width_px, height_px)) / kFieldParts;
    field.columns = static_cast<int>(std::ceil(width_px / field.part_px));
    field.rows = static_cast<int>(std::ceil(height_px / field.part_px));
    field.parts.resize(static_cast<std::size_t>(field.columns * field.rows));
    for (const CalibrationDot& dot : calibration.seen) {
        const int i = static_cast<int>((dot.pixel.u + 0.5) / field.part_px);
        const int j = static_cast<int>((dot.pixel.v + 0.5) / field.part_px);
        ResidualField::Part& part =
            field.parts[static_cast<std::size_t>(std::clamp(j, 0, field.rows - 1) * field.columns +
                                                 std::clamp(i, 0, field.columns - 1))];
        add_residual(part.before, dot.before);
        add_residual(part.after, dot.after);
        ++part.dots;
    }
    return field;
}

}  // namespace dotpose
