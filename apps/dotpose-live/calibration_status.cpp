#include "calibration_status.hpp"

#include <algorithm>

#include <fmt/core.h>

namespace dotpose::cli {
namespace {

bool is_missing(const CalibrationStatus& status, CalibrationNeed::Kind kind) {
    return std::ranges::find(status.needs, kind, &CalibrationNeed::kind) != status.needs.end();
}

}  // namespace

std::vector<video::Gauge> gauges_of(const CalibrationStatus& status) {
    using Kind = CalibrationNeed::Kind;
    const CalibrationCoverage& coverage = status.coverage;
    const auto count = [&](const char* label, int seen, int wanted, Kind kind) {
        return video::Gauge{
            label, seen < wanted ? fmt::format("{} of {}", seen, wanted) : fmt::format("{}", seen),
            std::min(1.0, static_cast<double>(seen) / wanted),
            !is_missing(status, kind) && seen >= wanted};
    };
    const double fraction = coverage.image().fraction();
    std::vector<video::Gauge> gauges = {
        {"image", fmt::format("{:.0f} %", 100 * fraction), fraction,
         coverage.frames() > 0 && !is_missing(status, Kind::image)},
        count("places", coverage.places(), kWantedPlaces, Kind::places),
        count("directions", coverage.directions(), kWantedDirections, Kind::directions),
        {"lens", "not known yet", 0, false},
    };
    if (const auto sigma_px = status.corner_sigma_px) {
        gauges.back() = {"lens", fmt::format("+- {:.3f} px", *sigma_px),
                         std::min(1.0, kWantedCornerSigma_px / std::max(*sigma_px, 1e-9)),
                         *sigma_px <= kWantedCornerSigma_px};
    }
    return gauges;
}

std::string taken_text(const CalibrationStatus& status) {
    const int frames = status.coverage.frames();
    return fmt::format("{} frame{} taken", frames, frames == 1 ? "" : "s");
}

std::string next_text(const CalibrationStatus& status) {
    return status.needs.empty() ? "nothing is missing" : status.needs.front().advice;
}

}  // namespace dotpose::cli
