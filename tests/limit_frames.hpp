/// The conditions in docs/limits.md. Each condition sets one property of nominal frames to its
/// worst permitted value. A frame is determined by its condition, seed and index.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "dotpose/device_options.hpp"
#include "dotpose/tools/simulate.hpp"

namespace dotpose::test {

struct Limit {
    std::string condition;
    std::function<void(Shot&)> worsen;
    CameraModel camera = {};
    /// True if limits_test.cpp requires all frames of this condition to be located.
    bool is_held = true;
    FixedLens lens = {};  ///< lens passed to `locate`
    bool is_white_on_black = false;
};

namespace detail {

inline CameraModel camera_of(int width_px, int height_px, double spacing_px) {
    CameraModel camera;
    camera.width_px = width_px;
    camera.height_px = height_px;
    camera.mm_per_px = kDefaultSpacing_mm / spacing_px;
    return camera;
}

/// Returns a random direction in the image. It depends only on the seed of the shot.
inline Vec2 direction_of(const Shot& shot) {
    const double angle_rad = Rng(shot.seed, 1).uniform(-std::numbers::pi, std::numbers::pi);
    return {std::cos(angle_rad), std::sin(angle_rad)};
}

/// Returns the fraction of the frame that dirt and graphics cover.
inline double covered_fraction(Shot shot) {
    constexpr double kPaper = 255;
    // The threshold is half-way between the paper and the lightest dirt.
    constexpr double kDark = 0.8 * kPaper;
    const Imperfections worse = shot.imperfections;
    shot.imperfections = {};
    shot.imperfections.paper_level = kPaper;
    shot.imperfections.dirt_blobs = worse.dirt_blobs;
    shot.imperfections.graphics = worse.graphics;
    shot.page.columns = shot.page.rows = 1;  // one dot, far outside the view
    const GreyImage image = render(shot);
    const auto dark = std::ranges::count_if(image.pixels, [](int grey) { return grey < kDark; });
    return static_cast<double>(dark) / static_cast<double>(image.pixels.size());
}

/// Adds dirt or graphics in steps of `step` until the covered fraction of the frame is between
/// `from` and `to`. If the fraction exceeds `to`, starts again with another seed.
inline void cover(Shot& shot, int Imperfections::*count, int step, double from, double to) {
    for (std::uint64_t trial = 0;; ++trial) {
        shot.seed = Rng(shot.seed, trial).bits();
        shot.imperfections.*count = 0;
        double fraction = 0;
        while (fraction < from) {
            shot.imperfections.*count += step;
            fraction = covered_fraction(shot);
        }
        if (fraction < to) return;
    }
}

inline void add_light(std::vector<Limit>& limits) {
    for (const double vignetting : {0.0, 0.2}) {
        limits.push_back({vignetting > 0 ? "the same, and by 20 % more in the corners"
                                         : "light falls by 70 % from one side to the other",
                          [=](Shot& shot) {
                              constexpr double kLeft = 0.3;
                              Imperfections& worse = shot.imperfections;
                              worse.fall = 2 * (1 - kLeft) / (1 + kLeft);
                              // The brighter side keeps the paper level of the original shot.
                              worse.paper_level /= 1 + worse.fall / 2;
                              worse.vignetting = vignetting;
                          }});
    }
    for (const int contrast : {40, 25}) {
        limits.push_back(
            {"ink " + std::to_string(contrast) + " grey levels darker than paper", [=](Shot& shot) {
                 Imperfections& worse = shot.imperfections;
                 worse.ink_reflectance = 1 - contrast / worse.paper_level;
             }});
    }
    limits.push_back({"white dots on black paper, inverted", [](Shot&) {}});
    limits.back().is_white_on_black = true;
}

inline void add_dots(std::vector<Limit>& limits) {
    struct Dots {
        const char* diameter;
        double fraction;
    };
    struct Seen {
        CameraModel camera;
        const char* spacing;
    };
    const CameraModel device;
    for (const auto& [diameter, fraction] :
         {Dots{"0.10", 0.10}, {"0.25", 0.25}, {"0.35", 0.35}, {"0.40", 0.40}}) {
        for (const auto& [camera, spacing] :
             {Seen{camera_of(device.width_px, device.height_px, 8), "8 px"},
              {camera_of(device.width_px, device.height_px, 11), "11 px"},
              {camera_of(640, 480, 20), "20 px, 640 x 480"},
              {camera_of(640, 480, 40), "40 px, 640 x 480"}}) {
            limits.push_back({std::string("dots of ") + diameter + " of the spacing of " + spacing,
                              [fraction = fraction](Shot& shot) {
                                  shot.page.pattern.dot_mm = fraction * kDefaultSpacing_mm;
                              },
                              camera});
        }
    }
    for (const auto& [length, fraction] :
         {Dots{"0.12", 0.12}, {"0.20", 0.20}, {"0.28", 0.28}, {"0.30", 0.30}}) {
        limits.push_back({std::string("dots displaced by ") + length + " of the spacing",
                          [fraction = fraction](Shot& shot) {
                              shot.page.pattern.displacement_mm = fraction * kDefaultSpacing_mm;
                          }});
        limits.back().is_held = fraction < 0.30;
    }
    limits.push_back({"one ink for each direction, the palest with 0.4 of the contrast",
                      [](Shot& shot) { shot.imperfections.palest_ink = 0.4; }});
    for (const int percent : {10, 20, 25}) {
        limits.push_back({std::to_string(percent) + " % of the dots missing",
                          [=](Shot& shot) { shot.imperfections.missing = percent / 100.0; }});
        limits.back().is_held = percent <= 20;
    }
}

inline void add_covered(std::vector<Limit>& limits) {
    constexpr double kSomething = 0.001;
    for (const int percent : {1, 2, 5, 10}) {
        constexpr int kSpecks = 5;
        limits.push_back(
            {"specks of dirt over " + std::to_string(percent) + " % of the area", [=](Shot& shot) {
                 cover(shot, &Imperfections::dirt_blobs, kSpecks, percent / 100.0, 1);
             }});
        limits.back().is_held = percent <= 2;
    }
    for (const int percent : {0, 10, 20, 30}) {
        const double from = std::max(percent / 100.0, kSomething);
        const double to = (percent + 10) / 100.0;
        limits.push_back({"graphics over " + std::to_string(percent) + " to " +
                              std::to_string(percent + 10) + " % of the area",
                          [=](Shot& shot) { cover(shot, &Imperfections::graphics, 1, from, to); }});
        limits.back().is_held = percent < 20;
    }
}

inline void add_camera_faults(std::vector<Limit>& limits) {
    for (const int percent : {50, 100}) {
        limits.push_back(
            {"motion by " + std::to_string(percent) + " % of the displacement", [=](Shot& shot) {
                 const double length_px =
                     percent / 100.0 * shot.page.pattern.displacement_mm / shot.camera.mm_per_px;
                 const Vec2 along = direction_of(shot);
                 shot.imperfections.motion_px = {length_px * along.x, length_px * along.y};
             }});
    }
    const CameraModel device;
    const CameraModel larger = camera_of(640, 480, 20);
    for (const CameraModel& camera : {device, larger}) {
        const bool is_device = camera.width_px == device.width_px;
        for (const int percent : {10, 30, 60}) {
            limits.push_back(
                {"rolling shutter, moved by " + std::to_string(percent) +
                     " % of the image height while it reads the rows" +
                     (is_device ? "" : ", 640 x 480 at 20 px"),
                 [=](Shot& shot) {
                     const double length_px = percent / 100.0 * camera.height_px;
                     const Vec2 along = direction_of(shot);
                     shot.camera.readout_px = {length_px * along.x, length_px * along.y};
                 },
                 camera});
            // If the scene moves in the direction of the readout, the image contains fewer rows of
            // cells. The small frames of devices may then contain too few rows. For devices, the
            // test therefore requires all frames to be located only if the motion is at most 30 %.
            limits.back().is_held = percent <= 30 || !is_device;
        }
        for (const int degrees : {2, 10, 20, 40, 60}) {
            limits.push_back(
                {"rolling shutter, turned by " + std::to_string(degrees) +
                     " degrees while it reads the rows" + (is_device ? "" : ", 640 x 480 at 20 px"),
                 [=](Shot& shot) {
                     const double sign = direction_of(shot).x < 0 ? -1 : 1;
                     shot.camera.readout_turn_rad = sign * degrees * std::numbers::pi / 180;
                 },
                 camera});
        }
        limits.push_back({std::string("rolling shutter, moved by 30 % of the image height and "
                                      "turned by 10 degrees while it reads the rows") +
                              (is_device ? "" : ", 640 x 480 at 20 px"),
                          [=](Shot& shot) {
                              const double length_px = 0.3 * camera.height_px;
                              const Vec2 along = direction_of(shot);
                              shot.camera.readout_px = {length_px * along.x, length_px * along.y};
                              shot.camera.readout_turn_rad = 10 * std::numbers::pi / 180;
                          },
                          camera});
        limits.back().is_held = !is_device;
        for (const int degrees : {10, 20, 25, 30}) {
            limits.push_back({"tilt " + std::to_string(degrees) + " degrees" +
                                  (is_device ? "" : ", 640 x 480 at 20 px"),
                              [=](Shot& shot) {
                                  const double tilt_rad = degrees * std::numbers::pi / 180;
                                  const Vec2 about = direction_of(shot);
                                  shot.pose.tilt_x_rad = tilt_rad * about.x;
                                  shot.pose.tilt_y_rad = tilt_rad * about.y;
                              },
                              camera});
        }
    }
    const double corner_px = std::hypot(device.width_px, device.height_px) / 2;
    for (const auto& [percent, is_known] :
         {std::pair{-12, true}, {12, true}, {-3, false}, {3, false}, {-5, false}, {5, false}}) {
        CameraModel camera;
        camera.k = percent / 100.0 / (corner_px * corner_px);
        limits.push_back({std::string(percent < 0 ? "barrel" : "pincushion") + " lens, " +
                              std::to_string(std::abs(percent)) + " % in the corners, " +
                              (is_known ? "known" : "unknown"),
                          [](Shot&) {}, camera});
        if (is_known) limits.back().lens = FixedLens::from_k(camera.k);
    }
}

inline void add_sizes(std::vector<Limit>& limits) {
    struct Size {
        int width_px, height_px, spacing_px;
        bool is_held = true;
    };
    for (const auto& [width_px, height_px, spacing_px, is_held] : {Size{64, 64, 6, false},
                                                                   {64, 64, 8, false},
                                                                   {96, 96, 6},
                                                                   {96, 96, 8},
                                                                   {188, 120, 6},
                                                                   {188, 120, 8},
                                                                   {188, 120, 13, false},
                                                                   {188, 120, 15, false},
                                                                   {640, 480, 6},
                                                                   {640, 480, 30},
                                                                   {640, 480, 45},
                                                                   {640, 480, 60, false},
                                                                   {1280, 960, 60},
                                                                   {4096, 4096, 6},
                                                                   {4096, 4096, 30},
                                                                   {4096, 4096, 60}}) {
        limits.push_back({std::to_string(width_px) + " x " + std::to_string(height_px) +
                              " px, spacing " + std::to_string(spacing_px) + " px",
                          [](Shot&) {}, camera_of(width_px, height_px, spacing_px)});
        limits.back().is_held = is_held;
    }
}

inline void add_partial(std::vector<Limit>& limits) {
    for (const int spacing_px : {11, 14, 20}) {
        const std::string seen = ", 640 x 480 at " + std::to_string(spacing_px) + " px";
        const CameraModel camera = camera_of(640, 480, spacing_px);
        const auto part = [&](const std::string& condition, const PartialView& view) {
            limits.push_back(
                {condition + seen, [view](Shot& shot) { cover_partly(shot, view); }, camera});
        };
        PartialView on_table;
        on_table.on_table = true;
        PartialView islands;
        islands.islands = 3;
        part("dots on 15 to 45 % of the area, the rest paper", {});
        // At a spacing of 20 px, some strips have only seven rows, which is not enough for a
        // certain fix.
        limits.back().is_held = spacing_px < 20;
        part("the same, the rest a dark table", on_table);
        part("three islands of 60 dots and more", islands);
    }
}

/// Returns the image of a sheet with inverted contrast. The dots have the grey level of the paper
/// of `shot`, and the paper has the grey level of the ink.
inline GreyImage white_on_black(const Shot& shot) {
    Shot blank = shot;
    blank.page.columns = blank.page.rows = 1;  // one dot, far outside the view
    Imperfections& perfect = blank.imperfections;
    perfect.noise_sigma = perfect.salt_and_pepper = 0;
    perfect.dirt_blobs = perfect.graphics = 0;
    const GreyImage light = render(blank);
    GreyImage image = render(shot);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const double both = (1 + shot.imperfections.ink_reflectance) * light.pixels[i];
        image.pixels[i] =
            static_cast<std::uint8_t>(std::clamp(std::lround(both) - image.pixels[i], 0L, 255L));
    }
    return image;
}

}  // namespace detail

/// Returns all conditions, in the same order as in the table in docs/limits.md.
inline std::vector<Limit> all_limits() {
    std::vector<Limit> limits{{"nominal", [](Shot&) {}}};
    detail::add_light(limits);
    detail::add_dots(limits);
    detail::add_covered(limits);
    detail::add_partial(limits);
    detail::add_camera_faults(limits);
    detail::add_sizes(limits);
    return limits;
}

inline Shot shot_at(const Limit& limit, std::uint64_t seed, std::uint64_t index) {
    Setup setup;
    setup.camera = limit.camera;
    setup.seed = seed;
    Shot shot = draw_shot(setup, index);
    limit.worsen(shot);
    return shot;
}

/// Returns the image to be located. If the sheet is white on black, the image is inverted.
inline GreyImage picture_of(const Limit& limit, const Shot& shot) {
    if (!limit.is_white_on_black) return render(shot);
    GreyImage image = detail::white_on_black(shot);
    for (std::uint8_t& grey : image.pixels)
        grey = static_cast<std::uint8_t>(255 - grey);
    return image;
}

inline DeviceOptions options_of(const Limit& limit) {
    DeviceOptions options;
    options.lens = limit.lens;
    return options;
}

}  // namespace dotpose::test
