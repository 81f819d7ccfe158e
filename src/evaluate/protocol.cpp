// Repeats the experiment in section IV-A of the paper with a simulated printer and camera.
#include "evaluate/protocol.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dotpose/files/degrees.hpp"

namespace dotpose {
namespace {

using namespace evaluate_detail;

/// Cell at the centre of the measured area. The choice is arbitrary.
constexpr Cell kMiddle{10'000, 20'000};

/// Commanded pose of the device, and the page under it.
struct Stand {
    Vec2 place_mm;
    double theta_rad = 0;
    const PrintModel* print = nullptr;  ///< null for a perfect page
};

/// Sets the pose of the camera relative to the printed pattern. Point p of the page shows point p -
/// shift(p) of the pattern, because the printer shifts the ink. The gradient of the shift rotates
/// the pattern, and stretches it by at most 1 % over the 8.6 mm of a frame. This function neglects
/// the stretching.
void place(CameraPose& pose, const Stand& stand, double spacing_mm) {
    Vec2 pattern_mm = stand.place_mm;
    pose.theta_rad = stand.theta_rad;
    if (stand.print != nullptr) {
        const Vec2 shift_mm = stand.print->shift_mm(stand.place_mm);
        pattern_mm = {pattern_mm.x - shift_mm.x, pattern_mm.y - shift_mm.y};
        constexpr double kStep_mm = 0.5;
        const Vec2 along{std::cos(stand.theta_rad), std::sin(stand.theta_rad)};
        const Vec2 ahead = stand.print->shift_mm(
            {stand.place_mm.x + kStep_mm * along.x, stand.place_mm.y + kStep_mm * along.y});
        pose.theta_rad = std::atan2(along.y - (ahead.y - shift_mm.y) / kStep_mm,
                                    along.x - (ahead.x - shift_mm.x) / kStep_mm);
    }
    pose.cell = kMiddle;
    const double x = pattern_mm.x / spacing_mm;
    const double y = pattern_mm.y / spacing_mm;
    pose.cell.x += static_cast<std::uint32_t>(static_cast<std::int32_t>(std::floor(x)));
    pose.cell.y += static_cast<std::uint32_t>(static_cast<std::int32_t>(std::floor(y)));
    pose.fraction_x = x - std::floor(x);
    pose.fraction_y = y - std::floor(y);
}

/// Returns the commanded pose of the device, which is the true pose on a perfect page.
Truth sent_to(const Stand& stand, double spacing_mm) {
    Truth truth;
    truth.x_grid = kMiddle.x + stand.place_mm.x / spacing_mm;
    truth.y_grid = kMiddle.y + stand.place_mm.y / spacing_mm;
    truth.theta_rad = stand.theta_rad;
    return truth;
}

Station station_of(const Stand& stand, std::span<const Outcome> outcomes) {
    Station station;
    station.place_mm = stand.place_mm;
    station.theta_deg = stand.theta_rad * kDegrees;
    std::vector<double> x_mm;
    std::vector<double> y_mm;
    std::vector<double> theta_deg;
    for (const Outcome& outcome : outcomes) {
        ++station.samples;
        if (outcome.is_wrong()) ++station.wrong;
        if (!outcome.is_fix() || outcome.is_wrong()) continue;
        ++station.located;
        const double spacing_mm = outcome.truth.spacing_mm;
        // Wrong fixes are identified by comparing them with the printed pattern, but the accuracy
        // is measured relative to the commanded pose.
        const Deviation off = deviation_of(outcome.fix, sent_to(stand, spacing_mm));
        x_mm.push_back(off.x_grid * spacing_mm);
        y_mm.push_back(off.y_grid * spacing_mm);
        theta_deg.push_back(off.theta_rad * kDegrees);
    }
    station.x_mm = spread_of(x_mm);
    station.y_mm = spread_of(y_mm);
    station.theta = spread_of(theta_deg);
    return station;
}

std::vector<Stand> positions_on(const PrintModel* print) {
    constexpr double kPitch_mm = PrintModel::kSide_mm / (kPositionsPerSide - 1);
    std::vector<Stand> stands;
    for (const Step step : spiral(kPositionsPerSide))
        stands.push_back({{step.x * kPitch_mm, step.y * kPitch_mm}, 0, print});
    return stands;
}

std::vector<Stand> angles_on(const PrintModel* print) {
    std::vector<Stand> stands;
    for (int i = 0; i < kAngles; ++i) {
        const double angle_rad = 2 * std::numbers::pi * i / kAngles;
        stands.push_back({{0, 0}, std::remainder(angle_rad, 2 * std::numbers::pi), print});
    }
    return stands;
}

}  // namespace

namespace evaluate_detail {

std::vector<Step> spiral(int side) {
    if (side < 1 || side % 2 == 0) throw BadArgument("a spiral needs an odd side");
    const auto count = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    std::vector<Step> steps = {{0, 0}};
    Step at;
    Step ahead{1, 0};
    // The legs of the spiral are 1, 1, 2, 2, 3, 3, ... steps long.
    for (int leg = 2; steps.size() < count; ++leg) {
        for (int i = 0; i < leg / 2 && steps.size() < count; ++i) {
            at = {at.x + ahead.x, at.y + ahead.y};
            steps.push_back(at);
        }
        ahead = {-ahead.y, ahead.x};
    }
    return steps;
}

Spread spread_of(std::span<const double> values) {
    Spread spread;
    const auto count = static_cast<double>(values.size());
    if (values.empty()) return spread;
    for (const double value : values)
        spread.bias += value / count;
    double squares = 0;
    for (const double value : values)
        squares += (value - spread.bias) * (value - spread.bias);
    if (values.size() > 1) spread.sigma = std::sqrt(squares / (count - 1));
    return spread;
}

Summary summary_of(std::span<const Station> stations, const SpreadOf& spread) {
    Summary summary;
    for (const Station& station : stations) {
        if (station.located == 0) continue;
        const Spread here = spread(station);
        const double accuracy = std::abs(here.bias);
        summary.best = summary.stations == 0 ? accuracy : std::min(summary.best, accuracy);
        summary.worst = std::max(summary.worst, accuracy);
        summary.worst_sigma = std::max(summary.worst_sigma, here.sigma);
        summary.mean += accuracy;
        ++summary.stations;
    }
    if (summary.stations > 0) summary.mean /= summary.stations;
    return summary;
}

}  // namespace evaluate_detail

Protocol run_protocol(const ProtocolOptions& options) {
    if (options.samples < 1) throw BadArgument("the protocol needs at least one sample");
    const PrintModel print;
    Protocol protocol{options.samples, {}, {}};
    std::vector<Stand> stands;
    for (const PrintModel* model : {static_cast<const PrintModel*>(nullptr), &print}) {
        std::ranges::copy(positions_on(model), std::back_inserter(stands));
        std::ranges::copy(angles_on(model), std::back_inserter(stands));
    }
    Shot device = draw_shot(options.setup, 0);
    device.page.pattern.section = options.setup.pattern.section;
    device.imperfections.motion_px = {};  // the device is at rest
    device.imperfections.dirt_blobs = 0;
    device.imperfections.graphics = 0;  // the paper's sheets are "carrying only the pattern"
    device.pose.tilt_x_rad = device.pose.tilt_y_rad = 0;

    FrameRun run;
    run.frames = options.samples * static_cast<int>(stands.size());
    run.frame_at = [&](int index) {
        const Stand& stand = stands[static_cast<std::size_t>(index / options.samples)];
        Shot shot = device;
        place(shot.pose, stand, shot.page.pattern.spacing_mm);
        shot.seed = Rng(options.setup.seed, static_cast<std::uint64_t>(index)).bits();
        return KnownFrame{render(shot), truth_of(shot), shot.page.pattern.code, {}};
    };
    run.options = {options.locate};
    run.threads = options.threads;
    run.progress = options.progress;
    const std::vector<Outcome> outcomes = evaluate(run).front();

    constexpr std::size_t kPositions = kPositionsPerSide * kPositionsPerSide;
    const auto samples = static_cast<std::size_t>(options.samples);
    for (std::size_t i = 0; i < stands.size(); ++i) {
        ProtocolResult& result = stands[i].print ? protocol.printed : protocol.perfect;
        auto& stations = result.positions.size() < kPositions ? result.positions : result.angles;
        stations.push_back(
            station_of(stands[i], std::span(outcomes).subspan(i * samples, samples)));
    }
    return protocol;
}

}  // namespace dotpose
