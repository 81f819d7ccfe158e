// Tests the ink of a pen. Paths come from simulate_handwriting, with noise or with rendered frames.
#include "dotpose/tools/ink.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../pen_frames.hpp"
#include "../../xml_check.hpp"
#include "dotpose/tools/follower.hpp"

namespace dotpose {
namespace {

using ::testing::HasSubstr;

constexpr double kRate_hz = 200;

/// Returns the samples of a path, with independent errors.
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

/// Expects the strokes of the path, with ends that are wrong by at most one frame.
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
    // Both axes of the noise contribute to the distance.
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
    EXPECT_LE(wrong_contacts, 2U);  // one frame at each end of the lift
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

/// Returns a page with a stroke from (1, 2) to (3, 5) mm, and a dot.
InkPage small_page() {
    InkPage page;
    page.name = "A & B";
    page.width_mm = 210;
    page.height_mm = 297;
    page.strokes = {{{0.5, 1, 2, 0, 0}, {0.505, 3, 5, 0, 0}}, {{1, 7, 8, 0.5, 0}}};
    return page;
}

TEST(InkSvg, HasTheSizeOfThePage) {
    const std::string svg = ink_svg(small_page());
    EXPECT_EQ(test::XmlCheck(svg).problem(), "");
    EXPECT_THAT(svg, HasSubstr(R"(width="210mm" height="297mm" viewBox="0 0 210 297")"));
    EXPECT_THAT(svg, HasSubstr(R"(d="M1.0000 2.0000 L3.0000 5.0000")"));
    EXPECT_THAT(svg, HasSubstr("A &amp; B"));
}

TEST(InkSvg, WithoutAPageContainsAllStrokes) {
    InkPage page = small_page();
    page.width_mm = 0;
    for (InkStroke& stroke : page.strokes) {
        for (InkPoint& point : stroke)
            point.x_mm += 1e8;
    }
    const std::string svg = ink_svg(page);
    // The strokes are 6 mm x 6 mm, and the margin is 5 mm.
    EXPECT_THAT(svg, HasSubstr(R"(width="16mm" height="16mm")"));
    EXPECT_THAT(svg, HasSubstr(R"(d="M5.0000 5.0000 L7.0000 8.0000")"));
}

TEST(InkMl, HasTracesInTheNamespace) {
    const std::string ink = ink_ml(small_page());
    EXPECT_EQ(test::XmlCheck(ink).problem(), "");
    EXPECT_THAT(ink, HasSubstr(R"(<ink xmlns="http://www.w3.org/2003/InkML">)"));
    EXPECT_THAT(ink, HasSubstr(R"(<trace contextRef="#page">1.0000 2.0000 500.000 0.00 0.00, )"
                               R"(3.0000 5.0000 505.000 0.00 0.00</trace>)"));
    // A lean of 0.5 rad towards +x.
    EXPECT_THAT(ink, HasSubstr("7.0000 8.0000 1000.000 28.65 0.00</trace>"));
}

}  // namespace
}  // namespace dotpose
