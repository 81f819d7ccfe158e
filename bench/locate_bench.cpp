// Benchmarks whole frames: dotpose, libapriltag, and a single pass over the pixels.
#include <algorithm>
#include <map>
#include <memory>

#include <fmt/core.h>

#include <dotpose/locate.hpp>

#include "apriltag.hpp"
#include "benchmarks.hpp"
#include "floor.hpp"
#include "frames.hpp"

namespace dotpose::bench {
namespace {

/// Returns the camera model from the paper, with the given image size.
CameraModel camera_of(int width_px, int height_px) {
    CameraModel camera;
    camera.width_px = width_px;
    camera.height_px = height_px;
    return camera;
}

/// Returns a 12-megapixel phone camera that photographs a whole page.
CameraModel phone_camera() {
    CameraModel camera = camera_of(4000, 3000);
    camera.mm_per_px = kDefaultSpacing_mm / 6;
    return camera;
}

/// Maximum number of pixels per frame for which libapriltag, the slowest method, is measured.
constexpr int kMaxTagPixels = 1280 * 800;

const std::vector<CameraModel>& sizes() {
    static const std::vector all = {
        camera_of(188, 120),   camera_of(320, 240), camera_of(640, 480),  camera_of(1280, 800),
        camera_of(2048, 2048), phone_camera(),      camera_of(4096, 4096)};
    return all;
}

/// Returns cameras with the same image size and decreasing spacings. Their frames therefore contain
/// increasing numbers of dots.
const std::vector<CameraModel>& spacings() {
    static const std::vector<CameraModel> all = [] {
        std::vector<CameraModel> cameras;
        for (const double spacing_px : {40.0, 28.0, 20.0, 14.0, 10.0, 7.0}) {
            cameras.push_back(camera_of(640, 480));
            cameras.back().mm_per_px = kDefaultSpacing_mm / spacing_px;
        }
        return cameras;
    }();
    return all;
}

std::string name_of(const char* what, const CameraModel& camera) {
    return fmt::format("{}/{}x{}/{:.0f}", what, camera.width_px, camera.height_px,
                       kDefaultSpacing_mm / camera.mm_per_px);
}

/// Returns the locator with the smallest memory that is large enough for the camera's frames.
Locator& locator_for(const CameraModel& camera, Effort effort) {
    static const auto small = std::make_unique<SmallMemory>();
    static const auto large = std::make_unique<LargeMemory>();
    static Locator for_small(*small, DeviceOptions{});
    static Locator for_large(*large, DeviceOptions{});
    constexpr int kSmall_px = 188;
    Locator& locator = camera.width_px <= kSmall_px ? for_small : for_large;
    DeviceOptions options;
    options.effort = effort;
    locator.set_options(options);
    return locator;
}

void locate_frames(benchmark::State& state, const CameraModel& camera, Effort effort) {
    Locator& locator = locator_for(camera, effort);
    const std::vector<KnownFrame>& frames = nominal_frames(camera);
    double dots = 0;
    for (const KnownFrame& frame : frames) {
        const Fix fix = locator.locate(frame.image.view());
        if (!is_right(fix, frame.truth)) {
            return state.SkipWithError("a frame was not located rightly");
        }
        dots += fix.dots_seen;
    }
    std::size_t next = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(locator.locate(frames[next].image.view()));
        next = (next + 1) % frames.size();
    }
    state.counters["dots"] = dots / static_cast<double>(frames.size());
}

/// Benchmarks tracking. The prediction for each frame is the frame's own fix.
void track_frames(benchmark::State& state, const CameraModel& camera) {
    Locator& locator = locator_for(camera, DeviceOptions{}.effort);
    const std::vector<KnownFrame>& frames = nominal_frames(camera);
    std::vector<Prediction> predictions;
    for (const KnownFrame& frame : frames) {
        const auto like = Prediction::like(locator.locate(frame.image.view()));
        const Fix fix = locator.locate(frame.image.view(), like);
        if (fix.attempt != Attempt::tracked || !is_right(fix, frame.truth)) {
            return state.SkipWithError("a frame was not tracked rightly");
        }
        predictions.push_back(like);
    }
    std::size_t next = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(locator.locate(frames[next].image.view(), predictions[next]));
        next = (next + 1) % frames.size();
    }
}

void count_pixels(benchmark::State& state, const CameraModel& camera) {
    constexpr std::uint8_t kLevel = 128;
    const std::vector<KnownFrame>& frames = nominal_frames(camera);
    for (const KnownFrame& frame : frames) {
        const auto& pixels = frame.image.pixels;
        const auto dark = std::ranges::count_if(pixels, [](int grey) { return grey < kLevel; });
        if (count_dark(pixels, kLevel) != dark) return state.SkipWithError("miscounted");
    }
    std::size_t next = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(count_dark(frames[next].image.pixels, kLevel));
        next = (next + 1) % frames.size();
    }
}

std::vector<TagFrame>& tag_frames(const CameraModel& camera) {
    static std::map<int, std::vector<TagFrame>> rendered;
    std::vector<TagFrame>& frames = rendered[camera.width_px];
    if (frames.empty()) {
        frames = render_tags(camera, static_cast<int>(nominal_frames(camera).size()));
    }
    return frames;
}

void detect_tags(benchmark::State& state, const CameraModel& camera, int decimate) {
    TagDetector detector(decimate);
    std::vector<TagFrame>& frames = tag_frames(camera);
    for (TagFrame& frame : frames) {
        if (!detector.is_right(frame)) return state.SkipWithError("a tag was not found rightly");
    }
    std::size_t next = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(detector.detect(frames[next].image));
        next = (next + 1) % frames.size();
    }
}

bool has_tags(const CameraModel& camera) {
    return camera.width_px * camera.height_px <= kMaxTagPixels;
}

template <typename Function>
void add(const std::string& name, Function function) {
    benchmark::RegisterBenchmark(name.c_str(), function)->Unit(benchmark::kMicrosecond);
}

FrameTimes times_of(const CameraModel& camera, const Results& results) {
    const Result& located = results.of(name_of("locate", camera));
    FrameTimes times{camera, located.dots, located.us};
    times.once_us = results.of(name_of("locate_once", camera)).us;
    times.tracked_us = results.of(name_of("locate_tracked", camera)).us;
    times.device_us = results.of(name_of("locate_device", camera)).us;
    return times;
}

}  // namespace

void add_frame_benchmarks() {
    for (const auto* cameras : {&sizes(), &spacings()}) {
        for (const CameraModel& camera : *cameras) {
            add(name_of("locate", camera),
                [=](benchmark::State& state) { locate_frames(state, camera, Effort::twice); });
            add(name_of("locate_once", camera),
                [=](benchmark::State& state) { locate_frames(state, camera, Effort::once); });
            add(name_of("locate_tracked", camera),
                [=](benchmark::State& state) { track_frames(state, camera); });
            add(name_of("locate_device", camera),
                [=](benchmark::State& state) { locate_frames(state, camera, Effort::device); });
        }
    }
    for (const CameraModel& camera : sizes()) {
        add(name_of("floor", camera),
            [=](benchmark::State& state) { count_pixels(state, camera); });
        if (!has_tags(camera)) continue;
        for (const int decimate : {1, 2}) {
            add(name_of(decimate == 1 ? "apriltag_1" : "apriltag_2", camera),
                [=](benchmark::State& state) { detect_tags(state, camera, decimate); });
        }
    }
}

std::vector<FrameTimes> times_by_size(const Results& results) {
    std::vector<FrameTimes> all;
    for (const CameraModel& camera : sizes()) {
        FrameTimes times = times_of(camera, results);
        times.floor_us = results.of(name_of("floor", camera)).us;
        if (has_tags(camera)) {
            times.tag_us[0] = results.of(name_of("apriltag_1", camera)).us;
            times.tag_us[1] = results.of(name_of("apriltag_2", camera)).us;
        }
        all.push_back(times);
    }
    return all;
}

std::vector<FrameTimes> times_by_dots(const Results& results) {
    std::vector<FrameTimes> all;
    for (const CameraModel& camera : spacings())
        all.push_back(times_of(camera, results));
    return all;
}

std::string size_table(const std::vector<FrameTimes>& all) {
    std::string table =
        "| frame, px | spacing, px | dots | locate, µs | tracked, µs | `--effort device`, µs "
        "| one pass, µs | apriltag 1, µs | apriltag 2, µs | locate / one pass "
        "| apriltag 2 / locate |\n"
        "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n";
    for (const FrameTimes& t : all) {
        const auto tag = [&](double us, int decimals) {
            return us > 0 ? fmt::format("{:.{}f}", us, decimals) : std::string("-");
        };
        table += fmt::format(
            "| {} x {} | {:.0f} | {:.0f} | {:.1f} | {:.1f} | {:.1f} | {:.2f} | {} | {} | {:.0f} | "
            "{} |\n",
            t.camera.width_px, t.camera.height_px, kDefaultSpacing_mm / t.camera.mm_per_px, t.dots,
            t.locate_us, t.tracked_us, t.device_us, t.floor_us, tag(t.tag_us[0], 0),
            tag(t.tag_us[1], 0), t.locate_us / t.floor_us, tag(t.tag_us[1] / t.locate_us, 1));
    }
    return table;
}

std::string dots_table(const std::vector<FrameTimes>& all) {
    std::string table =
        "| spacing, px | dots | locate, µs | `--effort once`, µs | tracked, µs "
        "| `--effort device`, µs |\n"
        "|--:|--:|--:|--:|--:|--:|\n";
    for (const FrameTimes& t : all) {
        table += fmt::format("| {:.0f} | {:.0f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} |\n",
                             kDefaultSpacing_mm / t.camera.mm_per_px, t.dots, t.locate_us,
                             t.once_us, t.tracked_us, t.device_us);
    }
    return table;
}

}  // namespace dotpose::bench
