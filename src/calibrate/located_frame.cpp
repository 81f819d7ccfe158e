#include "calibrate/located_frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace dotpose::calibrate {
namespace {

/// Lens distortions to try if the lens is unknown, as values of k r^2 at the image corners.
constexpr std::array kCornerStretches = {0.0, -0.06, -0.12, -0.18, -0.25, 0.06, 0.12};

/// Returns the half width of the dots, in spacings. This is the radius at which the mean radial
/// profile of all dots is halfway between its values at the centre and at kReach.
double half_width(const ImageView& image, const std::vector<LocatedDot>& dots, double spacing_px) {
    constexpr int kBins = 10;
    // Radius of the profile, in spacings. The nearest other dot is at least 2/3 of a spacing away.
    constexpr double kReach = 0.35;
    std::array<double, kBins> sums{};
    std::array<double, kBins> counts{};
    const int reach_px = static_cast<int>(std::ceil(kReach * spacing_px));
    for (const LocatedDot& dot : dots) {
        const int u0 = static_cast<int>(std::lround(dot.pixel.u));
        const int v0 = static_cast<int>(std::lround(dot.pixel.v));
        for (int v = std::max(v0 - reach_px, 0); v <= std::min(v0 + reach_px, image.height_px - 1);
             ++v) {
            for (int u = std::max(u0 - reach_px, 0);
                 u <= std::min(u0 + reach_px, image.width_px - 1); ++u) {
                const double r = std::hypot(u - dot.pixel.u, v - dot.pixel.v) / spacing_px;
                if (r >= kReach) continue;
                const auto bin = static_cast<std::size_t>(r / kReach * kBins);
                sums[bin] += image.row(v)[u];
                counts[bin] += 1;
            }
        }
    }
    std::array<double, kBins> levels{};
    for (std::size_t i = 0; i < kBins; ++i) {
        if (counts[i] == 0) return kReach;
        levels[i] = sums[i] / counts[i];
    }
    const double half = (levels.front() + levels.back()) / 2;
    for (std::size_t i = 1; i < kBins; ++i) {
        if (levels[i] < half) continue;
        const double fraction = (half - levels[i - 1]) / (levels[i] - levels[i - 1]);
        return (static_cast<double>(i) - 0.5 + fraction) * kReach / kBins;
    }
    return kReach;
}

}  // namespace

std::vector<LocatedDot> dots_read(const Trace& trace) {
    const CodeVariant code = trace.options.code;
    const GridRegion& grid = trace.grid.region;
    std::vector<LocatedDot> result;
    for (int j = grid.j0; j < grid.j0 + grid.rows; ++j) {
        for (int i = grid.i0; i < grid.i0 + grid.columns; ++i) {
            const GridCell& cell = trace.grid.at(i, j);
            if (!cell.has_dot()) continue;
            const FixedVec centre_q8 = trace.dots[cell.dot].centre_q8;
            const FixedVec step = trace.decoding.pattern_from_grid({i, j});
            const Place place = moved(code, trace.decoding.place, step.x, step.y);
            result.push_back({{centre_q8.x / 256.0, centre_q8.y / 256.0},
                              step,
                              symbol_at(code, place.cell, place.section)});
        }
    }
    return result;
}

FrameReader::FrameReader(std::optional<CodeVariant> code) : reader_(code) {
    DeviceOptions options;
    options.show_stages = true;
    locator_.set_options(options);
}

std::optional<LocatedFrame> FrameReader::read(const ImageView& image) {
    if (locate_with(image, lens_)) return read_trace(image);
    if (is_known_) return std::nullopt;
    const double reach_px = std::hypot(image.width_px, image.height_px) / 2;
    for (const double stretch : kCornerStretches) {
        const FixedLens lens = FixedLens::from_k(stretch / (reach_px * reach_px));
        if (!locate_with(image, lens)) continue;
        lens_ = lens;  // this lens will be tried first in the next frame
        return read_trace(image);
    }
    return std::nullopt;
}

bool FrameReader::locate_with(const ImageView& image, const FixedLens& lens) {
    DeviceOptions options = locator_.options();
    options.lens = lens;
    locator_.set_options(options);
    return reader_.locate(image, locator_).status == Status::ok;
}

LocatedFrame FrameReader::read_trace(const ImageView& image) const {
    const Trace trace = locator_.trace();
    const FixedLens& lens = trace.options.lens;
    // The lens as used by `locate`, that is, rounded to fixed point.
    Camera used;
    used.k_per_px2 = lens.k_q40 * 0x1p-40;
    used.centre_px = {(image.width_px - 1) / 2.0 + lens.centre_dx_q8 / 256.0,
                      (image.height_px - 1) / 2.0 + lens.centre_dy_q8 / 256.0};
    LocatedFrame located;
    located.place = trace.decoding.place;
    located.spacing_px = trace.fix.spacing_px();
    located.dots = dots_read(trace);
    for (LocatedDot& dot : located.dots)
        dot.pixel = distorted(used, dot.pixel);
    for (const DetectedDot& dot : trace.dots)
        located.blobs.push_back(
            distorted(used, {dot.centre_q8.x / 256.0, dot.centre_q8.y / 256.0}));
    located.dot_width = 2 * half_width(image, located.dots, located.spacing_px);
    return located;
}

}  // namespace dotpose::calibrate
