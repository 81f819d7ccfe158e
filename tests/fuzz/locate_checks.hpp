// Checks that every fix must pass, for any image and any options.
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "dotpose/locate.hpp"

namespace dotpose::fuzz {

inline void require(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "fix: %s\n", what);
    std::abort();
}

inline void check(const Fix& fix, const DeviceOptions& options) {
    require(static_cast<int>(fix.status) < kStatusCount, "status");
    require(message(fix.status)[0] != '\0', "message");
    if (fix.status != Status::ok) return;
    require(fix.cell.x < kPositionsPerAxis && fix.cell.y < kPositionsPerAxis, "cell");
    require(fix.section.u < kSections && fix.section.v < kSections, "section");
    require(fix.p_wrong_log2 <= options.integrity.max_p_wrong_log2 && fix.p_wrong_log2 <= 0,
            "p_wrong_log2");
    require(fix.dots_seen >= 0 && fix.dots_used > 0, "dots");
    require(fix.bit_errors >= 0, "bit_errors");
    require(fix.spacing_px_q16 > 0, "spacing");
    require(std::isfinite(fix.residual_px) && fix.residual_px >= 0, "residual");
    for (int i = 0; i < 3; ++i) {
        require(fix.covariance[i][i] >= 0, "variance");
        for (int j = 0; j < 3; ++j) {
            require(std::isfinite(fix.covariance[i][j]), "covariance");
            require(fix.covariance[i][j] == fix.covariance[j][i], "symmetric covariance");
        }
    }
}

/// Pushes the rows of an image to a locator whose memory still contains data from other frames.
inline Fix push_rows(const ImageView& image, Locator& locator) {
    static_cast<void>(locator.begin(image.width_px, image.height_px));
    for (int v = 0; v < image.height_px; ++v)
        locator.push_row(image.row(v));
    return locator.finish();
}

}  // namespace dotpose::fuzz
