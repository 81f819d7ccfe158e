// Tests the computation of ink from the positions of a pen tip. The paths come from
// simulate_handwriting. The positions are the points of a path with added noise, or are measured in
// rendered frames.
#include "dotpose/tools/ink.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "../../pen_frames.hpp"
#include "dotpose/tools/follower.hpp"

namespace dotpose {
namespace {

constexpr double kRate_hz = 200;

/// Returns ink samples for a path, with independent errors.
std::vector<InkSample> noisy(const std::vector<PenSample>& path, double sigma_mm) {
    Rng rng(3);
    std::vector<InkSample> samples;
    for (const PenSample& point : path) {
        InkSample sample;
        sample.t_s = point.t_s;
        sample.x_mm = point.pose.x_mm + sigma_mm * rng.normal();
        sample.y_mm = point.pose.y_mm + sigma_mm * rng.normal();
        sample.height_mm = point.pose.height_mm + sigma_mm * rng.normal();
        sample.sigma_x_mm = sample.sigma_y_mm = sample.sigma_height_mm = sigma_mm;
        samples.push_back(sample);
    }
    return samples;
}

std::size_t frame_of(const InkPoint& point) {
    return static_cast<std::size_t>(std::llround(point.t_s * kRate_hz));
}

double rms_mm(const InkPage& page, const std::vector<PenSample>& path) {
    double squares = 0;
    int count = 0;
    for (const InkStroke& stroke : page.strokes) {
        for (const InkPoint& point : stroke) {
            const PenPose& pose = path[frame_of(point)].pose;
            squares += std::pow(point.x_mm - pose.x_mm, 2) + std::pow(point.y_mm - pose.y_mm, 2);
            ++count;
        }
    }
    return std::sqrt(squares / count);
}

/// Expects that the page contains the strokes of the path. Each end of a stroke may be off by one
/// frame.
void expect_strokes(const InkPage& page, const std::vector<PenSample>& path) {
    std::vector<std::pair<std::size_t, std::size_t>> truth;
    for (std::size_t i = 0; i < path.size(); ++i) {
        if (!path[i].is_down) continue;
        if (i == 0 || !path[i - 1].is_down) truth.emplace_back(i, i);
        truth.back().second = i;
    }
    ASSERT_EQ(page.strokes.size(), truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i) {
        EXPECT_NEAR(double(frame_of(page.strokes[i].front())), double(truth[i].first), 1);
        EXPECT_NEAR(double(frame_of(page.strokes[i].back())), double(truth[i].second), 1);
    }
}

TEST(Ink, SmoothsStrokesAndFindsTheirEnds) {
    const std::vector<PenSample> path = simulate_handwriting({100, 200, 8, kRate_hz, 5});
    constexpr double kSigma_mm = 0.01;
    const std::vector<InkPage> pages = ink_of(noisy(path, kSigma_mm));
    ASSERT_EQ(pages.size(), 1U);
    expect_strokes(pages[0], path);
    // The noisy samples have an rms distance of sqrt(2) kSigma_mm from the path. The strokes are
    // smoothed, so their error must be smaller.
    EXPECT_LT(rms_mm(pages[0], path), 0.8 * std::sqrt(2) * kSigma_mm);
}

TEST(Ink, OfRenderedFramesIsWithin10Micrometres) {
    FollowerOptions options;
    options.camera = test::pen_camera();
    options.camera->tip = test::kTip;
    options.spacing_mm = test::kPenSpacing_mm;
    options.fits_space_pose = true;
    Follower follower(options);
    const std::vector<PenSample> path = simulate_handwriting({900, 600, 1, kRate_hz, 2});
    std::vector<InkSample> samples;
    std::size_t wrong_contacts = 0;
    for (std::size_t i = 0; i < path.size(); ++i) {
        Shot shot = test::pen_shot(11, i);
        shot.page.seed = 11;
        const GreyImage image = render(shot_of_pen(shot, test::kTip, path[i].pose));
        const Located now = follower.follow(image.view(), std::llround(path[i].t_s * 1e6)).located;
        ASSERT_TRUE(now.tip) << i;
        const TipPose& tip = *now.tip;
        samples.push_back({path[i].t_s, "", tip.x_mm, tip.y_mm, tip.height_mm, tip.sigma_mm(0),
                           tip.sigma_mm(1), tip.sigma_mm(2)});
        wrong_contacts += now.is_pen_down != path[i].is_down ? 1 : 0;
    }
    const std::vector<InkPage> pages = ink_of(samples);
    ASSERT_EQ(pages.size(), 1U);
    expect_strokes(pages[0], path);
    EXPECT_LT(rms_mm(pages[0], path), 0.01);
    EXPECT_LE(wrong_contacts, 2U);  // one at each end of the lift
}

TEST(Ink, IsDividedByPagesAndGaps) {
    std::vector<InkSample> samples = noisy(simulate_handwriting({10, 20, 1, kRate_hz, 6}), 0.01);
    std::erase_if(samples, [](const InkSample& s) { return s.t_s > 0.2; });
    for (InkSample& sample : samples)
        sample.page = sample.t_s < 0.1 ? "a" : "b";
    samples.push_back(samples.back());
    samples.back().t_s += 1.5 * kMaxInkGap_s;
    const std::vector<InkPage> pages = ink_of(samples);
    ASSERT_EQ(pages.size(), 2U);
    EXPECT_EQ(pages[0].name, "a");
    EXPECT_EQ(pages[0].strokes.size(), 1U);
    EXPECT_EQ(pages[1].name, "b");
    EXPECT_EQ(pages[1].strokes.size(), 2U);
    EXPECT_TRUE(ink_of({}).empty());
}

}  // namespace
}  // namespace dotpose
