#include "fleet_alerts.hpp"

namespace dotpose::cli {
namespace {

/// Returns true if a change between two conditions does not require an alert.
bool are_alike(Condition a, Condition b) {
    return a == b || (is_fine(a) && is_fine(b));
}

/// Returns true if the robot lost its pose less than a second ago. An alert would be premature,
/// because the pose is often lost only briefly, for example between two sheets.
bool is_briefly_lost(const FleetRobot& robot, const Now& now) {
    constexpr std::int64_t kBriefly_us = 1'000'000;
    return robot.condition == Condition::lost && now.watched_us - robot.lost_since_us < kBriefly_us;
}

RobotAlert alert_of(const std::string& name, const FleetRobot& robot) {
    RobotAlert alert;
    alert.robot = name;
    alert.condition = name_of(robot.condition);
    alert.reason = robot.reason;
    if (!robot.has_place) return alert;
    alert.map_id = robot.newest.map_id;
    alert.sheet = robot.newest.sheet;
    alert.x_m = robot.newest.x_m;
    alert.y_m = robot.newest.y_m;
    return alert;
}

}  // namespace

std::vector<RobotAlert> AlertWatch::changes(const FleetRobots& robots, const Now& now) {
    std::vector<RobotAlert> alerts;
    std::map<std::string, Condition, std::less<>> newly_known;
    for (const auto& [name, robot] : robots) {
        const auto known = known_.find(name);
        const bool is_new = known == known_.end();
        if (is_briefly_lost(robot, now)) {
            if (!is_new) newly_known.emplace(name, known->second);
            continue;
        }
        newly_known.emplace(name, robot.condition);
        const bool is_change =
            is_new ? robot.condition == Condition::lost || robot.condition == Condition::silent
                   : !are_alike(known->second, robot.condition);
        if (!is_change) continue;
        alerts.push_back(alert_of(name, robot));
        if (!is_new) alerts.back().previous = name_of(known->second);
    }
    known_.swap(newly_known);
    for (const auto& [name, condition] : newly_known) {
        if (known_.contains(name)) continue;
        RobotAlert& alert = alerts.emplace_back();
        alert.robot = name;
        alert.condition = "removed";
        alert.previous = name_of(condition);
    }
    return alerts;
}

}  // namespace dotpose::cli
