/// Functions that perform the measurements of the `tracked` command, and counters for the results.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "dotpose/code.hpp"
#include "table_run.hpp"

namespace dotpose::tables {

/// The true pose of the image centre.
struct TrueView {
    CameraPose pose;
    Section section;

    static TrueView of(const Shot& shot) { return {shot.pose, shot.page.pattern.section}; }

    double error_um(const Fix& fix) const {
        return 1000 * kDefaultSpacing_mm *
               std::hypot(fix.x_grid() - x_grid(pose), fix.y_grid() - y_grid(pose));
    }
    bool agrees(const Fix& fix) const {
        constexpr double kFarthest_um = 500 * kDefaultSpacing_mm;  // half a spacing
        constexpr double kFarthest_rad = 0.1;
        const double theta = std::remainder(fix.theta_rad() - pose.theta_rad, 2 * std::numbers::pi);
        return fix.section == section && error_um(fix) < kFarthest_um &&
               std::abs(theta) < kFarthest_rad;
    }
};

/// Returns the quantile of the values for the given probability (0.5 for the median), or 0 if
/// `values` is empty.
inline double quantile(std::vector<double> values, double probability) {
    if (values.empty()) return 0;
    const auto n = static_cast<std::ptrdiff_t>(probability * static_cast<double>(values.size()));
    const auto at = values.begin() + std::min(n, std::ssize(values) - 1);
    std::ranges::nth_element(values, at);
    return *at;
}

/// Results for one kind of prediction.
struct TrackedTally {
    std::uint64_t tracked = 0;        ///< number of correct fixes based on the prediction
    std::uint64_t afresh = 0;         ///< number of correct fixes not based on a prediction
    std::uint64_t none = 0;           ///< number of frames without a fix
    std::uint64_t tracked_wrong = 0;  ///< number of wrong fixes based on the prediction
    std::uint64_t afresh_wrong = 0;   ///< number of wrong fixes not based on a prediction
    /// Position errors of the fixes in `tracked` or, if no predictions were given, in `afresh`.
    std::vector<double> errors_um;

    /// Counts a fix. Without a true pose, every fix counts as wrong.
    void count(const Fix& fix, const std::optional<TrueView>& truth) {
        if (fix.status != Status::ok) {
            ++none;
            return;
        }
        const bool is_tracked = fix.attempt == Attempt::tracked;
        if (!truth || !truth->agrees(fix)) {
            ++(is_tracked ? tracked_wrong : afresh_wrong);
        } else {
            ++(is_tracked ? tracked : afresh);
            if (is_tracked) errors_um.push_back(truth->error_um(fix));
        }
    }

    /// Returns two table cells, with the median and the 95 % quantile of the errors. The cells are
    /// empty if `errors_um` is empty.
    std::string errors() const {
        if (errors_um.empty()) return " | ";
        return fmt::format("{:.2f} | {:.2f}", quantile(errors_um, 0.5), quantile(errors_um, 0.95));
    }
    std::uint64_t wrong() const { return tracked_wrong + afresh_wrong; }
    std::uint64_t all() const { return tracked + afresh + none + wrong(); }
    double percent(std::uint64_t part) const {
        return all() == 0 ? 0 : 100 * static_cast<double>(part) / static_cast<double>(all());
    }

    TrackedTally& operator+=(const TrackedTally& other) {
        tracked += other.tracked;
        afresh += other.afresh;
        none += other.none;
        tracked_wrong += other.tracked_wrong;
        afresh_wrong += other.afresh_wrong;
        errors_um.insert(errors_um.end(), other.errors_um.begin(), other.errors_um.end());
        return *this;
    }
};

struct TrackedTallies {
    std::vector<TrackedTally> kinds;

    TrackedTally& operator[](std::size_t kind) {
        if (kinds.size() <= kind) kinds.resize(kind + 1);
        return kinds[kind];
    }
    TrackedTallies& operator+=(const TrackedTallies& other) {
        for (std::size_t i = 0; i < other.kinds.size(); ++i)
            (*this)[i] += other.kinds[i];
        return *this;
    }
    std::uint64_t wrong() const {
        std::uint64_t sum = 0;
        for (const TrackedTally& tally : kinds)
            sum += tally.wrong();
        return sum;
    }
};

/// A table for a document, and the number of wrong fixes in the measurement.
struct TrackedTable {
    std::string text;
    std::uint64_t wrong = 0;
    bool is_complete = true;  ///< false if the measurement was interrupted
};

/// Returns the table for drives at several speeds and frame rates.
TrackedTable drives_table(const TableRun& run);

/// Returns the table for predictions of increasing error. The frames use the `nominal` preset.
TrackedTable offsets_table(const TableRun& run, std::uint64_t frames);

/// Returns the table for changes between two frames, such as different light, a lifted camera,
/// another sheet or covered dots. The fix of the frame before the change is the prediction for the
/// frame after the change.
TrackedTable changes_table(const TableRun& run, std::uint64_t frames);

/// Returns the table for predictions of wrong positions. All classes of predictions are tested
/// equally often.
TrackedTable wrong_predictions_table(const TableRun& run, std::uint64_t predictions);

/// Returns the wrong position that is hardest to distinguish from `place` in a view of `lines`
/// consecutive lines that begin at `place`. The lines are columns if `is_along_x` is true, and rows
/// otherwise. The wrong position has a different section and a different position in one secondary
/// sequence, and shares as many of the lines as possible with `place`. All perpendicular lines are
/// the same as at `place`.
Place worst_alternative(CodeVariant code, const Place& place, bool is_along_x, int lines);

}  // namespace dotpose::tables
