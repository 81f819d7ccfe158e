#include "calibrate/all_dots.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace dotpose::calibrate {
namespace {

/// Maximum distance between a dot and its expected position: kReach_sigmas times the rms residual
/// of the fit, clamped to [kMinReach, kMaxReach] spacings. The limit exceeds the errors of the
/// print and of the fit. It is smaller than the distance to any other dot, which is at least 2/3 of
/// a spacing. The subsequent fit rejects outliers.
constexpr double kReach_sigmas = 6;
constexpr double kMinReach = 0.1;
constexpr double kMaxReach = 1.0 / 3;

struct Candidate {
    double off;  ///< distance from the expected position, in spacings
    LocatedDot dot;
};

/// Returns the candidate that assigns the blob at `pixel` to the nearest intersection. (`x`, `y`)
/// is the position of the blob on the paper, in spacings from `start`.
Candidate candidate(PixelPoint pixel, const Place& start, double x, double y, double displacement,
                    CodeVariant code) {
    const FixedVec step{static_cast<std::int32_t>(std::lround(x)),
                        static_cast<std::int32_t>(std::lround(y))};
    const Place place = moved(code, start, step.x, step.y);
    const Symbol symbol = symbol_at(code, place.cell, place.section);
    const double off =
        std::hypot(x - step.x - displacement * dx(symbol), y - step.y - displacement * dy(symbol));
    return {off, {pixel, step, symbol}};
}

}  // namespace

void take_all_dots(const LensFit& fit, const FitSetting& setting, CodeVariant code,
                   std::vector<LocatedFrame>& frames) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
        LocatedFrame& frame = frames[i];
        const double reach =
            std::clamp(kReach_sigmas * fit.residual_px / frame.spacing_px, kMinReach, kMaxReach);
        std::map<std::pair<int, int>, Candidate> nearest;
        for (const PixelPoint& blob : frame.blobs) {
            const auto [x_mm, y_mm] = place_on_paper(fit, i, blob, setting);
            const Candidate found =
                candidate(blob, frame.place, x_mm / setting.spacing_mm, y_mm / setting.spacing_mm,
                          fit.camera.displacement, code);
            if (found.off > reach) continue;
            const auto [entry, is_new] =
                nearest.try_emplace({found.dot.step.x, found.dot.step.y}, found);
            if (!is_new && found.off < entry->second.off) entry->second = found;
        }
        // If there are fewer than half as many candidates as dots read by `locate`, the frame keeps
        // the dots read by `locate`.
        if (2 * nearest.size() < frame.dots.size()) continue;
        frame.dots.clear();
        for (const auto& [step, found] : nearest)
            frame.dots.push_back(found.dot);
    }
}

}  // namespace dotpose::calibrate
