// Sweeps a condition, such as blur, over increasing values.
#include "evaluate/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>

#include <fmt/core.h>

#include "dotpose/files/option_names.hpp"
#include "dotpose/tools/draw.hpp"
#include "draw/svg.hpp"
#include "evaluate/raster.hpp"

namespace dotpose {
namespace evaluate_detail {

std::span<const double> sweep_values(SweepKind kind) {
    static constexpr double kNoise[] = {0, 3, 6, 9, 12, 15, 20, 25, 30, 35, 40, 50, 60};
    static constexpr double kBlur_px[] = {0, 0.25, 0.5, 0.75, 1, 1.25, 1.5, 1.75, 2, 2.25, 2.5};
    static constexpr double kMissing_percent[] = {0, 2, 5, 10, 15, 20, 25, 30, 40, 50, 60};
    static constexpr double kTilt_deg[] = {0, 2, 4, 6, 8, 10, 12, 15, 18, 22, 26, 30};
    static constexpr double kSpacing_px[] = {4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 18, 20};
    static constexpr double kCovered_percent[] = {0, 10, 20, 30, 40, 45, 50, 55, 60, 65, 70, 75};
    switch (kind) {
        case SweepKind::noise:
            return kNoise;
        case SweepKind::blur:
            return kBlur_px;
        case SweepKind::missing:
            return kMissing_percent;
        case SweepKind::tilt:
            return kTilt_deg;
        case SweepKind::spacing:
            return kSpacing_px;
        case SweepKind::occlusion:
            return kCovered_percent;
    }
    throw BadArgument("unknown sweep");
}

void cover(GreyImage& image, double fraction, double direction_rad) {
    constexpr std::uint8_t kLevel = 25;
    const double c = std::cos(direction_rad);
    const double s = std::sin(direction_rad);
    const auto along = [&](int u, int v) { return c * u + s * v; };
    std::vector<double> ranks;
    ranks.reserve(image.pixels.size());
    for (int v = 0; v < image.height_px; ++v) {
        for (int u = 0; u < image.width_px; ++u)
            ranks.push_back(along(u, v));
    }
    const auto count = static_cast<std::size_t>(fraction * static_cast<double>(ranks.size()));
    if (count == 0) return;
    std::vector<double> sorted = ranks;
    std::ranges::nth_element(sorted, sorted.begin() + static_cast<std::ptrdiff_t>(count - 1));
    const double edge = sorted[count - 1];
    for (std::size_t i = 0; i < ranks.size(); ++i) {
        if (ranks[i] <= edge) image.pixels[i] = kLevel;
    }
}

KnownFrame sweep_frame(SweepKind kind, double value, const Setup& setup, std::uint64_t index) {
    Shot shot = draw_shot(setup, index);
    // The random values of the condition come from a separate generator. If they came from the
    // generator of the shot, they would change the other random values of the shot.
    Rng rng(setup.seed ^ shot.seed);
    const double direction_rad = rng.uniform(-std::numbers::pi, std::numbers::pi);
    switch (kind) {
        case SweepKind::noise:
            shot.imperfections.noise_sigma = value;
            break;
        case SweepKind::blur:
            shot.imperfections.blur_sigma_px = value;
            break;
        case SweepKind::missing:
            shot.imperfections.missing = value / 100;
            break;
        case SweepKind::tilt: {
            const double tilt_rad = value * std::numbers::pi / 180;
            shot.pose.tilt_x_rad = tilt_rad * std::cos(direction_rad);
            shot.pose.tilt_y_rad = tilt_rad * std::sin(direction_rad);
            break;
        }
        case SweepKind::spacing:
            shot.camera.mm_per_px = shot.page.pattern.spacing_mm / value;
            break;
        case SweepKind::occlusion:
            break;
    }
    KnownFrame frame{render(shot), truth_of(shot), setup.pattern.code, {}};
    if (kind == SweepKind::occlusion) cover(frame.image, value / 100, direction_rad);
    return frame;
}

}  // namespace evaluate_detail

const char* name(SweepKind kind) {
    switch (kind) {
        case SweepKind::noise:
            return "noise";
        case SweepKind::blur:
            return "blur";
        case SweepKind::missing:
            return "missing";
        case SweepKind::tilt:
            return "tilt";
        case SweepKind::spacing:
            return "spacing";
        case SweepKind::occlusion:
            return "occlusion";
    }
    return "?";
}

Sweep run_sweep(SweepKind kind, const SweepOptions& options) {
    const std::span<const double> values = evaluate_detail::sweep_values(kind);
    const int per_value = options.frames_per_value;
    if (per_value < 1) throw BadArgument("a sweep needs at least one frame for each value");
    Sweep sweep{kind, options.setup.preset, per_value, {}};
    bool goes_on = true;
    FrameRun run;
    run.frames = per_value;
    run.options = {options.locate, options.locate};
    run.options[0].decoder = Decoder::window;
    run.options[1].decoder = Decoder::all;
    run.threads = options.threads;
    for (const double value : values) {
        run.frame_at = [&](int index) {
            return evaluate_detail::sweep_frame(kind, value, options.setup,
                                                static_cast<std::uint64_t>(index));
        };
        const int before = per_value * static_cast<int>(sweep.points.size());
        run.progress = [&](int done, int) {
            const int all = per_value * static_cast<int>(values.size());
            goes_on = !options.progress || options.progress(before + done, all);
            return goes_on;
        };
        try {
            const auto outcomes = evaluate(run);
            sweep.points.push_back({value, score_of(outcomes[0]), score_of(outcomes[1])});
        } catch (const Error&) {
            // If the sweep is interrupted, the completed values are kept, provided there are at
            // least two.
            if (goes_on || sweep.points.size() < 2) throw;
            break;
        }
    }
    return sweep;
}

void write_sweep_csv(std::ostream& out, const Sweep& sweep) {
    out << name(sweep.kind)
        << ",decoder,frames,located,wrong,position_median_um,position_p95_um,position_max_um,"
           "angle_median_deg,angle_p95_deg,angle_max_deg\n";
    const auto cell = [](double value, int decimals) {
        return std::isfinite(value) ? fmt::format(",{:.{}f}", value, decimals) : std::string(",");
    };
    for (const SweepPoint& point : sweep.points) {
        for (const Decoder decoder : kDecoders) {
            const Score& score = decoder == Decoder::window ? point.window : point.all;
            out << fmt::format("{:g},{},{},{},{}", point.value, name(decoder), score.frames,
                               score.located, score.wrong)
                << cell(score.position_um.median, 3) << cell(score.position_um.p95, 3)
                << cell(score.position_um.max, 3) << cell(score.angle_deg.median, 5)
                << cell(score.angle_deg.p95, 5) << cell(score.angle_deg.max, 5) << '\n';
        }
    }
}

void write_sweep(const std::filesystem::path& folder, const Sweep& sweep) {
    const std::string stem = fmt::format("sweep-{}", name(sweep.kind));
    draw::write_file(folder / (stem + ".csv"),
                     [&](std::ostream& out) { write_sweep_csv(out, sweep); });
    draw::write_figure(folder, stem, [&](std::ostream& out) { draw_sweep(out, sweep); });
}

}  // namespace dotpose
