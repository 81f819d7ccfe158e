// Computes pen strokes: smooths the path of the tip, and splits the path where the pen is lifted.
#include "dotpose/tools/ink.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "dotpose/tools/pen.hpp"
#include "follow/smoother.hpp"

namespace dotpose {
namespace {

using follow::AxisPlace;
using follow::AxisSample;

/// Height limit, in mm, for samples adjacent to a lift. Such a sample belongs to the lift if its
/// smoothed height exceeds the limit by more than two standard deviations.
constexpr double kRest_mm = 0.02;

/// Consecutive samples on the same page. The time from each sample to the next is at most
/// kMaxInkGap_s.
using Run = std::span<const InkSample>;

std::vector<Run> runs_of(std::span<const InkSample> samples) {
    std::vector<Run> runs;
    std::size_t begin = 0;
    for (std::size_t i = 1; i <= samples.size(); ++i) {
        const bool goes_on = i < samples.size() && samples[i].page == samples[i - 1].page &&
                             samples[i].t_s - samples[i - 1].t_s <= kMaxInkGap_s;
        if (goes_on) continue;
        runs.push_back(samples.subspan(begin, i - begin));
        begin = i;
    }
    return runs;
}

/// Members of InkSample for one coordinate: the value and its standard deviation.
struct Axis {
    double InkSample::*place_mm;
    double InkSample::*sigma_mm;
};
constexpr Axis kX{&InkSample::x_mm, &InkSample::sigma_x_mm};
constexpr Axis kY{&InkSample::y_mm, &InkSample::sigma_y_mm};
constexpr Axis kHeight{&InkSample::height_mm, &InkSample::sigma_height_mm};

std::vector<AxisSample> along(const Axis& axis, Run run) {
    std::vector<AxisSample> result;
    for (const InkSample& sample : run) {
        const double sigma_mm = sample.*axis.sigma_mm;
        result.push_back({sample.t_s, sample.*axis.place_mm, sigma_mm * sigma_mm});
    }
    return result;
}

/// Returns the acceleration noise that maximises the likelihood of the samples of all runs.
double fitted_noise(const std::vector<Run>& runs, std::initializer_list<Axis> axes) {
    double best = 0;
    double best_likelihood = -std::numeric_limits<double>::infinity();
    // Tries noise levels that range from those of a resting pen to those of a very fast pen. The
    // steps are coarse, because a factor of 3 in the noise hardly changes the result.
    for (double noise = 1e3; noise < 1e13; noise *= std::sqrt(10)) {
        double likelihood = 0;
        for (const Run& run : runs) {
            for (const Axis& axis : axes)
                likelihood += follow::log_likelihood(along(axis, run), noise);
        }
        if (likelihood <= best_likelihood) continue;
        best_likelihood = likelihood;
        best = noise;
    }
    return best;
}

/// Determines for each sample whether the pen is on the paper.
std::vector<bool> contacts_of(Run run, double noise) {
    PenContact contact;
    std::vector<bool> is_down;
    for (const InkSample& sample : run)
        is_down.push_back(contact.take(sample.height_mm, sample.sigma_height_mm));
    const std::vector<AxisPlace> heights = follow::smoothed(along(kHeight, run), noise);
    const auto is_above = [&](std::size_t i) {
        return heights[i].place_mm > kRest_mm + 2 * std::sqrt(heights[i].variance_mm2);
    };
    // Extends each lift to the adjacent samples that are above the paper.
    for (std::size_t i = run.size(); i-- > 1;) {
        if (!is_down[i] && is_above(i - 1)) is_down[i - 1] = false;
    }
    for (std::size_t i = 1; i < run.size(); ++i) {
        if (!is_down[i - 1] && is_above(i)) is_down[i] = false;
    }
    return is_down;
}

InkPage& page_of(const std::string& name, std::vector<InkPage>& pages) {
    const auto found = std::ranges::find(pages, name, &InkPage::name);
    if (found != pages.end()) return *found;
    pages.push_back({});
    pages.back().name = name;
    return pages.back();
}

}  // namespace

std::vector<InkPage> ink_of(std::span<const InkSample> samples) {
    const std::vector<Run> runs = runs_of(samples);
    const double noise = fitted_noise(runs, {kX, kY});
    const double height_noise = fitted_noise(runs, {kHeight});
    std::vector<InkPage> pages;
    for (const Run& run : runs) {
        const std::vector<AxisPlace> x = follow::smoothed(along(kX, run), noise);
        const std::vector<AxisPlace> y = follow::smoothed(along(kY, run), noise);
        const std::vector<bool> is_down = contacts_of(run, height_noise);
        for (std::size_t i = 0; i < run.size(); ++i) {
            if (!is_down[i]) continue;
            std::vector<InkStroke>& strokes = page_of(run[i].page, pages).strokes;
            if (i == 0 || !is_down[i - 1]) strokes.emplace_back();
            strokes.back().push_back(
                {run[i].t_s, x[i].place_mm, y[i].place_mm, run[i].tilt_rad, run[i].azimuth_rad});
        }
    }
    return pages;
}

}  // namespace dotpose
