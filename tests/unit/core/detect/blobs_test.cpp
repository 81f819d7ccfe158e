// Tests blobs and their centroids on drawn images.
#include "core/detect/blobs.hpp"

#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "../canvas.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core_test::blobs_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 22;

/// Maximum and rms error of a dot's centroid, in px. The error occurs because the threshold omits
/// whole pixels at the rim of the dot.
constexpr double kWorstShift_px = 0.25;
constexpr double kUsualShift_px = 0.11;

/// Returns an image drawn from text. Each character other than '.' is a 2 x 2 px square of ink. The
/// first character is at (u0, 30).
GreyImage drawn(std::initializer_list<std::string_view> picture, int u0 = 30) {
    GreyImage image = blank(96, 80);
    int v = 30;
    for (const std::string_view line : picture) {
        for (std::size_t i = 0; i < line.size(); ++i) {
            const int u = u0 + 2 * static_cast<int>(i);
            if (line[i] != '.') fill(image, u, v, u + 2, v + 2, 40);
        }
        v += 2;
    }
    return image;
}

TEST(Blobs, ABlurredDotIsFoundAtEverySubPixelPhase) {
    for (const double sigma : {0.6, 0.8, 1.0, 1.2, 2.5, 6.0}) {
        double squares = 0;
        for (int phase = 0; phase < 64; ++phase) {
            const Vec2 centre{40 + phase % 8 / 8.0, 33 + phase / 8 / 8.0};
            // Large dots occur only with a large spacing, so they are drawn in a larger image.
            GreyImage image = sigma < 4 ? blank(80, 64) : blank(256, 256);
            darken(image, centre, sigma, 0.7);
            const auto dots = blobs_of(image);
            ASSERT_EQ(dots.size(), 1u) << sigma << ", phase " << phase;
            const double shift = nearest_px(dots, centre);
            EXPECT_LT(shift, kWorstShift_px) << sigma << ", phase " << phase;
            squares += shift * shift;
        }
        EXPECT_LT(std::sqrt(squares / 64), kUsualShift_px) << sigma;
    }
}

TEST(Blobs, DotsThatTouchAreOneAndDotsThatDoNotAreTwo) {
    const auto side_by_side = blobs_of(drawn({"aabb", "aabb"}));
    ASSERT_EQ(side_by_side.size(), 1u);
    EXPECT_EQ(side_by_side[0].area_px, 32);
    EXPECT_LT(nearest_px(side_by_side, {33.5, 31.5}), 0.01);
    const auto corner_to_corner = blobs_of(drawn({"a.", ".b"}));
    ASSERT_EQ(corner_to_corner.size(), 1u);
    EXPECT_LT(nearest_px(corner_to_corner, {31.5, 31.5}), 0.01);
    const auto other_corners = blobs_of(drawn({".a", "b."}));
    ASSERT_EQ(other_corners.size(), 1u);
    EXPECT_EQ(other_corners[0].area_px, 8);

    GreyImage image = drawn({"aa.bb", ".....", ".cc.."});
    fill(image, 34, 30, 35, 32, 40);  // a gap of one pixel remains between a and b
    const auto apart = blobs_of(image);
    ASSERT_EQ(apart.size(), 3u);
    for (const Vec2 centre : {Vec2{32, 30.5}, Vec2{37.5, 30.5}, Vec2{33.5, 34.5}}) {
        EXPECT_LT(nearest_px(apart, centre), 0.01);
    }
}

/// Expects exactly one blob in the picture. Its area and centroid must be those of all ink in the
/// picture.
void expect_one(std::initializer_list<std::string_view> picture) {
    Vec2 sum;
    int area = 0;
    int v = 0;
    std::string shape;
    for (const std::string_view line : picture) {
        for (std::size_t u = 0; u < line.size(); ++u) {
            if (line[u] == '.') continue;
            sum = sum + Vec2{static_cast<double>(u), static_cast<double>(v)};
            ++area;
        }
        shape.append(line).append("\n");
        ++v;
    }
    // Depending on `u0`, the shape is inside one tile or crosses the border between two tiles.
    for (const int u0 : {24, 29, 33}) {
        const auto dots = blobs_of(drawn(picture, u0));
        ASSERT_EQ(dots.size(), 1u) << shape << "at " << u0;
        EXPECT_EQ(dots[0].area_px, 4 * area) << shape << "at " << u0;
        const Vec2 centre = Vec2{u0 + 0.5, 30.5} + 2.0 / area * sum;
        // The weights of the pixels differ by a few percent between tiles, so the centroid is not
        // exact.
        EXPECT_LT(nearest_px(dots, centre), 0.3) << shape << "at " << u0;
    }
}

TEST(Blobs, ArmsThatMeetLaterAreOneBlob) {
    expect_one({"x...x", "x...x", "xxxxx"});
    expect_one({"x.x.x.x", "x.x.x.x", ".x.x.x."});
    expect_one({"x......x", "x.x..x.x", "x.xxxx.x", "x..x...x", "xxxxxxxx"});
    expect_one({"....x", "...x.", "x.x..", ".x..."});
    expect_one({"xxxxxxx", "x.....x", "x.xxx.x", "x...x.x", "xxxxx.x", "......x"});
    expect_one({"..x..", ".x.x.", "x...x", ".x.x.", "..x.."});
    expect_one({"x.x", ".x.", "x.x"});
    expect_one({"x..x..x", "x..x..x", "x..xxxx", "x..x...", "xxxx..."});
}

TEST(Blobs, WhatTouchesTheBorderIsNoDot) {
    constexpr int kWidth = 83;
    constexpr int kHeight = 69;
    for (int away = 0; away <= 1; ++away) {
        const int right = kWidth - 3 - away;
        const int bottom = kHeight - 3 - away;
        const std::vector<FixedVec> corners{{away, 30},    {right, 30},   {40, away},
                                            {40, bottom},  {away, away},  {right, bottom},
                                            {right, away}, {away, bottom}};
        for (const FixedVec corner : corners) {
            GreyImage image = blank(kWidth, kHeight);
            fill(image, corner.x, corner.y, corner.x + 3, corner.y + 3, 40);
            const auto dots = blobs_of(image);
            ASSERT_EQ(dots.size(), static_cast<std::size_t>(away)) << corner.x << ", " << corner.y;
            if (away == 1) {
                EXPECT_LT(nearest_px(dots, {corner.x + 1.0, corner.y + 1.0}), 0.01);
            }
        }
    }
}

TEST(Blobs, FoundInUnevenLight) {
    // The dots are 9.3 px apart. The brightness decreases to a third from one corner to the
    // opposite corner.
    GreyImage image = blank(190, 120);
    std::vector<Vec2> centres;
    for (double y = 7.2; y < 113; y += 9.3) {
        for (double x = 6.9; x < 183; x += 9.3) {
            centres.push_back({x, y});
            darken(image, centres.back(), 0.9, 0.7);
        }
    }
    for (int v = 0; v < image.height_px; ++v) {
        for (int u = 0; u < image.width_px; ++u) {
            const double light = 1.2 - 0.8 * (u + v) / (image.width_px + image.height_px);
            std::uint8_t& level = pixel(image, u, v);
            level = static_cast<std::uint8_t>(std::lround(level * light));
        }
    }
    const auto dots = blobs_of(image);
    EXPECT_EQ(dots.size(), centres.size());
    for (const Vec2 centre : centres) {
        EXPECT_LT(nearest_px(dots, centre), kWorstShift_px) << centre.x << ", " << centre.y;
    }
}

TEST(Blobs, TheSameInAnyWidthAndHeight) {
    const std::vector<Vec2> centres{{10.3, 12.6}, {55.5, 11.1}, {58.2, 52.4}, {31.8, 47.9}};
    for (int extra = 0; extra < 34; ++extra) {
        for (const bool is_wider : {true, false}) {
            GreyImage image = is_wider ? blank(64 + extra, 64) : blank(64, 64 + extra);
            for (const Vec2 centre : centres)
                darken(image, centre, 0.9, 0.7);
            const auto dots = blobs_of(image);
            EXPECT_EQ(dots.size(), centres.size()) << image.width_px << " x " << image.height_px;
            for (const Vec2 centre : centres)
                EXPECT_LT(nearest_px(dots, centre), kWorstShift_px);
        }
    }
}

TEST(Blobs, BigGraphicsAreNoDotsAndHideNone) {
    GreyImage image = blank(188, 120);
    std::vector<Vec2> beside;
    for (double y = 8; y < 113; y += 11) {
        for (double x = 8; x < 181; x += 11) {
            darken(image, {x, y}, 0.9, 0.7);
            if (x < 80 || x > 112) beside.push_back({x, y});
        }
    }
    fill(image, 84, 4, 108, 116, 50);   // a stroke
    fill(image, 90, 40, 102, 80, 200);  // a hole in the stroke
    const auto dots = blobs_of(image);
    EXPECT_EQ(dots.size(), beside.size());
    // The stroke changes the thresholds of all tiles in its band. If a dot crosses the border of
    // this band, its two parts have different thresholds, which shifts its centroid.
    constexpr double kShiftBesideGraphics_px = 0.3;
    for (const Vec2 centre : beside) {
        EXPECT_LT(nearest_px(dots, centre), kShiftBesideGraphics_px)
            << centre.x << ", " << centre.y;
    }
}

TEST(Blobs, AFullListKeepsTheDotsNearestTheCentre) {
    GreyImage image = blank(188, 120);
    std::vector<Vec2> centres;
    for (int v = 4; v < 116; v += 6) {
        for (int u = 4; u < 184; u += 6) {
            fill(image, u, v, u + 2, v + 2, 40);
            centres.push_back({u + 0.5, v + 0.5});
        }
    }
    const auto check = [&](Workspace& w, std::size_t capacity) {
        const auto dots = blobs_of(image, w);
        EXPECT_LE(dots.size(), capacity);
        EXPECT_GE(dots.size(), capacity / 2);
        std::size_t near = 0;
        for (const Vec2 centre : centres) {
            const double away = std::max(std::abs(centre.x - 93.5), std::abs(centre.y - 59.5));
            const bool is_kept = nearest_px(dots, centre) < 0.1;
            EXPECT_EQ(is_kept, away <= w.dots_kept_within_px) << centre.x << ", " << centre.y;
            near += away <= w.dots_kept_within_px ? 1 : 0;
        }
        EXPECT_EQ(dots.size(), near);
    };
    WorkspaceOf<188, 64, 16> tiny;
    check(tiny, 64);
    WorkspaceOf<188, 300, 16> small;
    check(small, 300);
    LargeWorkspace large;
    EXPECT_EQ(blobs_of(image, large).size(), centres.size());
}

TEST(Blobs, NoMoreRunsAreLookedAtThanTheWorkspaceSays) {
    // The image has seven rows of ten dots. Each dot has two runs.
    GreyImage image = blank(188, 120);
    for (int v = 10; v < 80; v += 10) {
        for (int u = 10; u < 110; u += 10)
            fill(image, u, v, u + 2, v + 2, 40);
    }
    LargeWorkspace w;
    for (const int rows : {0, 3, 7}) {
        w.open.max_runs = rows * 20;
        EXPECT_EQ(static_cast<int>(blobs_of(image, w).size()), rows * 10);
    }
    // The first three rows of dots have 60 runs. The remaining five runs are the top halves of five
    // dots in the fourth row.
    w.open.max_runs = 3 * 20 + 5;
    EXPECT_EQ(blobs_of(image, w).size(), 35u);
}

/// An 8-connected set of dark pixels, found by a flood fill.
struct Flood {
    Vec2 centre;
    int area = 0;
    int left, top, right, bottom;
};

Flood flood(GreyImage& image, int u, int v) {
    Flood found{{}, 0, u, v, u, v};
    std::vector<FixedVec> open{{u, v}};
    pixel(image, u, v) = 255;
    while (!open.empty()) {
        const FixedVec p = open.back();
        open.pop_back();
        found.centre = found.centre + Vec2{static_cast<double>(p.x), static_cast<double>(p.y)};
        ++found.area;
        found.left = std::min(found.left, p.x);
        found.right = std::max(found.right, p.x);
        found.top = std::min(found.top, p.y);
        found.bottom = std::max(found.bottom, p.y);
        for (int y = std::max(p.y - 1, 0); y <= std::min(p.y + 1, image.height_px - 1); ++y) {
            for (int x = std::max(p.x - 1, 0); x <= std::min(p.x + 1, image.width_px - 1); ++x) {
                if (pixel(image, x, y) != 40) continue;
                pixel(image, x, y) = 255;
                open.push_back({x, y});
            }
        }
    }
    found.centre = 1.0 / found.area * found.centre;
    return found;
}

bool is_at(const DetectedDot& dot, const Flood& blob) {
    // The weight of a pixel depends on the threshold of its tile. The differences between tiles
    // move the centroid by at most a tenth of the size of the blob.
    const double size = std::max(blob.right - blob.left, blob.bottom - blob.top) + 1;
    return dot.area_px == blob.area && length(real(dot.centre_q8, 8) - blob.centre) <= 0.1 * size;
}

void compare_with_flooding(GreyImage image) {
    const auto dots = blobs_of(image);
    const auto contains = [&](const Flood& blob) {
        return std::any_of(dots.begin(), dots.end(),
                           [&](const DetectedDot& dot) { return is_at(dot, blob); });
    };
    std::size_t all = 0;
    std::size_t least = 0;
    for (int v = 0; v < image.height_px; ++v) {
        for (int u = 0; u < image.width_px; ++u) {
            if (pixel(image, u, v) != 40) continue;
            const Flood blob = flood(image, u, v);
            if (blob.left == 0 || blob.top == 0 || blob.right == image.width_px - 1 ||
                blob.bottom == image.height_px - 1) {
                continue;
            }
            ++all;
            // Dots are always smaller than 30 px, so the detector may reject blobs that are wider
            // or taller.
            if (blob.right - blob.left > 30 || blob.bottom - blob.top > 30) continue;
            ++least;
            ASSERT_TRUE(contains(blob))
                << blob.area << " px at " << blob.centre.x << ", " << blob.centre.y;
        }
    }
    EXPECT_GE(dots.size(), least);
    EXPECT_LE(dots.size(), all);
}

TEST(Blobs, RandomPixelsFormTheSetsThatFloodingFinds) {
    Rng rng(kSeed);
    for (int i = 0; i < 60; ++i) {
        GreyImage image =
            blank(64 + static_cast<int>(rng.below(220)), 64 + static_cast<int>(rng.below(220)));
        // The density is high enough that even the tiles near the corners contain ink in one of
        // their four measured rows.
        const double density = rng.uniform(0.2, 0.42);
        const int side = density < 0.3 ? 2 : 1;
        for (int v = 0; v + side <= image.height_px; v += side) {
            for (int u = 0; u + side <= image.width_px; u += side) {
                if (rng.uniform() < density) fill(image, u, v, u + side, v + side, 40);
            }
        }
        SCOPED_TRACE(testing::Message()
                     << "image " << i << ", seed " << kSeed << ", density " << density << ", "
                     << image.width_px << " x " << image.height_px);
        compare_with_flooding(image);
        if (testing::Test::HasFatalFailure()) return;
    }
}

/// Result of the size filter. The first `count` dots are kept, and the other dots are rejected.
struct Sifted {
    std::vector<DetectedDot> dots;
    int count = 0;
};

Sifted sift(std::vector<DetectedDot> dots, const BlobOptions& options) {
    int count = static_cast<int>(dots.size());
    int kept_within_px = 1000;
    sift_dots(options, {dots, count, kept_within_px});
    return {dots, count};
}

TEST(Blobs, TheSizeFilterIsRelativeToTheUpperQuartile) {
    for (const int scale : {1, 6}) {
        std::vector<DetectedDot> dots;
        for (int i = 0; i < 300; ++i)
            dots.push_back(dot_at({i * 1.0, 50}, 1000 * scale, 8 * scale));
        BlobOptions options;
        options.min_mass_q8 = 64;  // a quarter of the upper quartile
        options.max_area_ratio = 3;
        dots[10] = dot_at({10, 50}, 240 * scale, 8 * scale);
        dots[20] = dot_at({20, 50}, 260 * scale, 8 * scale);
        dots[30] = dot_at({30, 50}, 1000 * scale, 23 * scale);
        dots[40] = dot_at({40, 50}, 1000 * scale, 25 * scale);
        dots[50] = dot_at({50, 50}, 1000 * scale, 1);
        const Sifted sifted = sift(dots, options);
        EXPECT_EQ(sifted.count, 297);
        for (int i = 0; i < sifted.count; ++i) {
            const double x = real(sifted.dots[static_cast<std::size_t>(i)].centre_q8, 8).x;
            EXPECT_TRUE(x != 10 && x != 40 && x != 50) << x;
        }
    }
    EXPECT_EQ(sift({}, {}).count, 0);
}

TEST(Blobs, SaltAndPepperIsSiftedOut) {
    // Each dot consists of about nine pixels. About 0.3 % of the pixels are isolated black pixels
    // between the dots.
    Rng rng(kSeed);
    GreyImage image = blank(188, 120);
    std::vector<Vec2> centres;
    for (double y = 8; y < 113; y += 11) {
        for (double x = 8; x < 181; x += 11) {
            centres.push_back({x, y});
            darken(image, centres.back(), 1.0, 0.8);
        }
    }
    std::size_t specks = 0;
    for (int v = 2; v < 118; v += 5) {
        for (int u = 2; u < 186; u += 5) {
            const int near_u = u % 11;
            const int near_v = v % 11;
            const bool is_beside_dots = (near_u < 4 || near_u > 12) && (near_v < 4 || near_v > 12);
            if (!is_beside_dots || rng.uniform() > 0.5) continue;
            pixel(image, u, v) = 0;
            ++specks;
        }
    }
    ASSERT_GT(specks, 30u);
    auto dots = blobs_of(image);
    EXPECT_GT(dots.size(), centres.size() + specks / 2) << "seed " << kSeed;
    Sifted sifted = sift(dots, {});
    sifted.dots.resize(static_cast<std::size_t>(sifted.count));
    EXPECT_EQ(sifted.dots.size(), centres.size()) << "seed " << kSeed;
    for (const Vec2 centre : centres)
        EXPECT_LT(nearest_px(sifted.dots, centre), 0.3);
}

}  // namespace
}  // namespace dotpose::core_test::blobs_test
