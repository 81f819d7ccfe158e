// Converts the results for a frame to metres with y up. Results in the pattern frame are in mm with
// y down. Results in the world frame are already in metres with y up.
#include <cmath>
#include <cstdio>
#include <utility>

#include "dotpose/tools/robot_messages.hpp"
#include "dotpose/tools/track_names.hpp"

namespace dotpose::ros {
namespace {

/// Signs that convert (x, y, angle) to axes with y up. If y points down in the plane, y and the
/// angle change sign.
struct Axes {
    bool is_y_up = true;

    double sign(std::size_t i) const { return is_y_up || i % 3 == 0 ? 1 : -1; }
};

std::optional<PlanarCovariance> covariance_in_m(const PoseCovariance& covariance, double unit_m,
                                                Axes axes) {
    if (!(covariance[0][0] > 0)) return std::nullopt;
    const std::array factors = {unit_m, axes.sign(1) * unit_m, axes.sign(2)};
    PlanarCovariance result{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            result[i][j] = factors[i] * factors[j] * double{covariance[i][j]};
    }
    return result;
}

std::optional<PlanarFix> fix_in_world(const Located& located) {
    const auto world = located.place ? world_place(*located.place) : std::nullopt;
    if (!world) return std::nullopt;
    return PlanarFix{{world->x_m, world->y_m, world->yaw_rad},
                     covariance_in_m(world->covariance, 1, {true})};
}

std::optional<PlanarFix> fix_in_pattern(const Located& located) {
    const Fix& fix = located.fix;
    if (!std::isfinite(located.spacing_mm)) return std::nullopt;
    const double spacing_m = located.spacing_mm / 1000;
    PoseCovariance covariance{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            covariance[i][j] = fix.covariance[i][j];
    }
    return PlanarFix{{fix.x_grid() * spacing_m, -fix.y_grid() * spacing_m, -fix.theta_rad()},
                     covariance_in_m(covariance, spacing_m, {false})};
}

/// Returns the pose of the camera in space, or nullopt if the pose is unknown or ambiguous. If
/// `is_in_world` is true, also returns nullopt if the position in the world is unknown.
std::optional<CameraInWorld> camera_of(const Located& located, bool is_in_world) {
    if (is_in_world) return certain_in_world(located.space, located.place);
    if (!located.space || located.space->is_ambiguous()) return std::nullopt;
    return in_world(located.space->camera, located.space->covariance, WorldPose{});
}

PlanarMotion motion_of(const TrackedPose& pose, Axes axes) {
    const double up = axes.sign(1);
    PlanarMotion motion;
    motion.pose = {pose.x_mm() / 1000, up * pose.y_mm() / 1000, up * pose.theta_rad()};
    motion.vx_m_s = double{pose.vx_mm_s} / 1000;
    motion.vy_m_s = up * double{pose.vy_mm_s} / 1000;
    motion.turn_rad_s = up * double{pose.turn_rad_s};
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j) {
            const double unit = (i % 3 == 2 ? 1 : 1e-3) * (j % 3 == 2 ? 1 : 1e-3);
            motion.covariance[i][j] =
                axes.sign(i) * axes.sign(j) * unit * double{pose.covariance[i][j]};
        }
    }
    return motion;
}

std::string three_digits(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", value);
    return text.data();
}

/// Returns additional diagnostic values for a frame with a fix.
std::vector<KeyValue> fix_facts_of(const Located& located) {
    const Fix& fix = located.fix;
    std::vector<KeyValue> facts = {{"dots_used", std::to_string(fix.dots_used)},
                                   {"attempt", name(fix.attempt)},
                                   {"p_wrong", three_digits(fix.p_wrong())}};
    if (located.place) facts.push_back({"sheet", located.place->entry->name});
    if (!located.space) return facts;
    facts.push_back({"camera_is_ambiguous", located.space->is_ambiguous() ? "true" : "false"});
    if (const auto& second = located.space->second)
        facts.push_back({"camera_second_odds", three_digits(std::exp2(second->odds_log2))});
    return facts;
}

std::vector<KeyValue> facts_of(const Followed& followed) {
    const Fix& fix = followed.located.fix;
    std::vector<KeyValue> facts = {{"status", name(fix.status)},
                                   {"events", event_names(followed.track.events)},
                                   {"verdict", name(followed.track.verdict)},
                                   {"dots_seen", std::to_string(fix.dots_seen)}};
    if (fix.status == Status::ok) {
        for (KeyValue& fact : fix_facts_of(followed.located))
            facts.push_back(std::move(fact));
    }
    if (followed.space_track)
        facts.push_back({"camera_verdict", name(followed.space_track->verdict)});
    return facts;
}

}  // namespace

RobotUpdate update_of(const Followed& followed, bool is_in_world, std::int64_t time_ns) {
    const Located& located = followed.located;
    const Track& track = followed.track;
    const bool is_ok = located.fix.status == Status::ok;
    RobotUpdate update;
    update.time_ns = time_ns;
    if (is_ok) update.fix = is_in_world ? fix_in_world(located) : fix_in_pattern(located);
    update.camera = camera_of(located, is_in_world);
    if (followed.space_track) update.camera_motion = dotpose::motion_of(*followed.space_track);
    if (!track.is_lost) {
        update.motion = motion_of(track.pose, {is_in_world});
        update.plane = track.pose.plane;
    }
    update.state = state_name(track);
    update.is_found_again = track.events.fix || track.events.kidnapped;
    if (!is_ok) update.problem = message(located.fix.status);
    update.facts = facts_of(followed);
    return update;
}

}  // namespace dotpose::ros
