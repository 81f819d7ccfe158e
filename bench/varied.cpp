// Measures the time for each of many different frames, to show how much the time varies between
// frames.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <dotpose/locate.hpp>
#include <dotpose/tools/random.hpp>

#include "apriltag.hpp"
#include "benchmarks.hpp"
#include "floor.hpp"
#include "frames.hpp"
#include "locate/first.hpp"
#include "locate/workspace.hpp"

namespace dotpose::bench {
namespace {

/// A method of locating frames, the frames that it processes, and its results.
struct Subject {
    std::vector<const GreyImage*> frames;
    int found = 0;
    std::function<void(std::size_t, GreyImage&)> run;
    std::vector<double> fastest_us;
};

template <typename Frame>
Subject subject_on(const std::vector<Frame>& frames,
                   std::function<void(std::size_t, GreyImage&)> run) {
    Subject subject;
    for (const Frame& frame : frames)
        subject.frames.push_back(&frame.image);
    subject.run = std::move(run);
    subject.fastest_us.assign(frames.size(), std::numeric_limits<double>::max());
    return subject;
}

Subject locating(const std::vector<KnownFrame>& frames, Effort effort, SmallMemory& memory) {
    DeviceOptions options;
    options.effort = effort;
    Subject subject = subject_on(frames, [options, &memory](std::size_t, GreyImage& image) {
        benchmark::DoNotOptimize(Locator(memory, options).locate(image.view()));
    });
    for (const KnownFrame& frame : frames) {
        const Fix fix = Locator(memory, options).locate(frame.image.view());
        if (fix.status != Status::ok) continue;
        if (!is_right(fix, frame.truth)) throw Error("a frame was located wrongly");
        ++subject.found;
    }
    return subject;
}

/// Returns the method that uses only the first attempt, without AVX2 instructions.
Subject locating_narrowly(const std::vector<KnownFrame>& frames) {
    static core::SmallWorkspace workspace;
    const auto locates = [](const GreyImage& image) {
        workspace.fix = {};
        return core::locate_first(workspace.frame(core::wide_kernels(), image.view(), {}),
                                  workspace);
    };
    Subject subject = subject_on(frames, [locates](std::size_t, GreyImage& image) {
        benchmark::DoNotOptimize(locates(image));
    });
    for (const KnownFrame& frame : frames)
        subject.found += locates(frame.image) && is_right(workspace.fix, frame.truth) ? 1 : 0;
    return subject;
}

/// Returns a prediction for a frame: the frame's own fix, moved and rotated by a random error.
Prediction prediction_for(const KnownFrame& frame, Rng& rng, SmallMemory& memory) {
    const Fix fix = Locator(memory, DeviceOptions{}).locate(frame.image.view());
    const double direction_rad = rng.uniform(0, 2 * std::numbers::pi);
    const double way = rng.uniform(0, 0.35);
    constexpr double kTurn = 4294967296.0;
    const auto q16 = [](double spacings) { return static_cast<std::int32_t>(spacings * 65536); };
    return moved(Prediction::like(fix), CodeVariant::anoto,
                 {q16(way * std::cos(direction_rad)), q16(way * std::sin(direction_rad))},
                 static_cast<std::int32_t>(rng.uniform(-2, 2) / 360 * kTurn),
                 fix.pattern_from_image.centre_q8);
}

Subject tracking(const std::vector<KnownFrame>& frames, SmallMemory& memory) {
    Rng rng(kSeed);
    std::vector<Prediction> predictions;
    for (const KnownFrame& frame : frames)
        predictions.push_back(prediction_for(frame, rng, memory));
    Subject subject = subject_on(frames, [predictions, &memory](std::size_t i, GreyImage& image) {
        benchmark::DoNotOptimize(
            Locator(memory, DeviceOptions{}).locate(image.view(), predictions[i]));
    });
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const Fix fix =
            Locator(memory, DeviceOptions{}).locate(frames[i].image.view(), predictions[i]);
        if (fix.status != Status::ok) continue;
        if (!is_right(fix, frames[i].truth)) throw Error("a frame was located wrongly");
        subject.found += fix.attempt == Attempt::tracked ? 1 : 0;
    }
    return subject;
}

Subject passing_over(const std::vector<KnownFrame>& frames) {
    constexpr std::uint8_t kLevel = 128;
    return subject_on(frames, [](std::size_t, GreyImage& image) {
        benchmark::DoNotOptimize(count_dark(image.pixels, kLevel));
    });
}

Subject detecting(std::vector<TagFrame>& frames, TagDetector& detector) {
    Subject subject = subject_on(frames, [&detector](std::size_t, GreyImage& image) {
        benchmark::DoNotOptimize(detector.detect(image));
    });
    for (TagFrame& frame : frames)
        subject.found += detector.is_right(frame) ? 1 : 0;
    return subject;
}

/// Measures the time of every frame once. Each frame is first copied to the same buffer, as if a
/// real camera had written it there. Between two measurements of a frame, all other frames are
/// processed, so caches and branch prediction do not adapt to the frame.
void pass(Subject& subject) {
    using Clock = std::chrono::steady_clock;
    GreyImage camera = *subject.frames.front();
    for (std::size_t i = 0; i < subject.frames.size(); ++i) {
        std::ranges::copy(subject.frames[i]->pixels, camera.pixels.begin());
        const auto start = Clock::now();
        subject.run(i, camera);
        const std::chrono::duration<double, std::micro> time = Clock::now() - start;
        subject.fastest_us[i] = std::min(subject.fastest_us[i], time.count());
    }
}

FrameSpread spread_of(const Subject& subject) {
    std::vector<double> us = subject.fastest_us;
    std::ranges::sort(us);
    return {static_cast<int>(us.size()), subject.found, quantile(us, 0.5), quantile(us, 0.99),
            us.back()};
}

}  // namespace

Varied time_varied_frames(int frame_count, int passes) {
    Setup setup;
    setup.seed = kSeed;
    const std::vector<KnownFrame> frames = render_frames(frame_count, frames_of_setup(setup));
    std::vector<TagFrame> tags = render_tags({}, frame_count / 10);
    const auto memory = std::make_unique<SmallMemory>();
    TagDetector detector_1(1);
    TagDetector detector_2(2);
    std::array<Subject, kWays> subjects = {
        locating(frames, Effort::twice, *memory),
        locating(frames, Effort::once, *memory),
        locating_narrowly(frames),
        tracking(frames, *memory),
        locating(frames, Effort::device, *memory),
        passing_over(frames),
        detecting(tags, detector_1),
        detecting(tags, detector_2),
    };
    for (int i = 0; i < passes; ++i) {
        for (Subject& subject : subjects)
            pass(subject);
    }
    Varied varied;
    std::ranges::transform(subjects, varied.spreads.begin(), spread_of);
    return varied;
}

std::string varied_table(const Varied& varied) {
    constexpr std::array<const char*, kWays> kNames = {
        "`locate`, default",       "`locate`, `--effort once`",   "the same without AVX2",
        "`locate`, tracked",       "`locate`, `--effort device`", "one pass",
        "libapriltag, decimate 1", "libapriltag, decimate 2",
    };
    std::string table =
        "| | frames | found | median, µs | 99 %, µs | longest, µs | longest / median |\n"
        "|---|--:|--:|--:|--:|--:|--:|\n";
    for (std::size_t i = 0; i < kWays; ++i) {
        const FrameSpread& s = varied.spreads[i];
        const bool finds = i != static_cast<std::size_t>(Way::floor);
        table += fmt::format("| {} | {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |\n", kNames[i],
                             s.frames, finds ? std::to_string(s.found) : "-", s.median_us, s.p99_us,
                             s.longest_us, s.longest_over_median());
    }
    return table;
}

}  // namespace dotpose::bench
