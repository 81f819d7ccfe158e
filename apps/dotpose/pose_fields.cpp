#include "pose_fields.hpp"

#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include <fmt/core.h>

#include "dotpose/files/degrees.hpp"

namespace dotpose::cli {
namespace {

std::string radians(double angle_rad) {
    return decimal(angle_rad, 8);
}

/// Returns the nine fields of a covariance after scaling its rows and columns by `factors`.
std::vector<Field> scaled(const std::string& name, const PoseCovariance& covariance,
                          const std::array<double, 3>& factors, bool is_known) {
    std::vector<Field> fields;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            const double value = factors[i] * factors[j] * double{covariance[i][j]};
            fields.push_back({fmt::format("{}_{}{}", name, i, j),
                              is_known ? significant(value) : std::string(), false, name});
        }
    }
    return fields;
}

}  // namespace

PlanePose pattern_pose(const Fix& fix, double spacing_mm) {
    PlanePose pose{fix.x_grid() * spacing_mm, fix.y_grid() * spacing_mm, fix.theta_rad(), {}};
    const std::array factors = {spacing_mm, spacing_mm, 1.0};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            pose.covariance[i][j] =
                static_cast<float>(factors[i] * factors[j] * double{fix.covariance[i][j]});
        }
    }
    return pose;
}

PlanePose with_other_y(const PlanePose& pose) {
    // Leaves an angle of pi unchanged, because -pi is the same direction but is outside the range
    // (-pi, pi].
    const double angle_rad =
        pose.theta_rad == std::numbers::pi ? std::numbers::pi : -pose.theta_rad;
    return {pose.x_mm, -pose.y_mm, angle_rad, world_covariance(pose.covariance, 0)};
}

PoseNames pattern_names(Units units) {
    if (units == Units::mm) return {"x_mm", "y_mm", "theta_deg", "covariance_mm_deg"};
    return {"x_pattern_m", "y_pattern_m", "yaw_pattern_rad", "covariance_pattern_m_rad"};
}

PoseNames sheet_names(Units units) {
    if (units == Units::mm) {
        return {"x_sheet_mm", "y_sheet_mm", "theta_sheet_deg", "covariance_sheet_mm_deg"};
    }
    return {"x_sheet_m", "y_sheet_m", "yaw_sheet_rad", "covariance_sheet_m_rad"};
}

PoseNames track_names(Units units) {
    if (units == Units::mm) {
        return {"track_x_mm", "track_y_mm", "track_theta_deg", "track_covariance_mm_deg"};
    }
    return {"track_x_m", "track_y_m", "track_yaw_rad", "track_covariance_m_rad"};
}

std::vector<Field> pose_fields(const PoseNames& names, Units units,
                               const std::optional<PlanePose>& pose) {
    std::vector<Field> fields = {{names.x, {}}, {names.y, {}}, {names.angle, {}}};
    if (!pose) return fields;
    const bool is_ros = units == Units::ros;
    fields[0].text = is_ros ? metres(pose->x_mm) : decimal(pose->x_mm, 6);
    fields[1].text = is_ros ? metres(pose->y_mm) : decimal(pose->y_mm, 6);
    fields[2].text = is_ros ? radians(pose->theta_rad) : degrees(pose->theta_rad);
    return fields;
}

std::vector<Field> covariance_fields(const PoseNames& names, Units units,
                                     const std::optional<PlanePose>& pose) {
    const double length = units == Units::ros ? 1e-3 : 1;
    const double angle = units == Units::ros ? 1 : kDegrees;
    const PoseCovariance covariance = pose ? pose->covariance : PoseCovariance{};
    return scaled(names.covariance, covariance, {length, length, angle}, covariance[0][0] > 0);
}

std::vector<Field> world_fields(const std::optional<WorldPlace>& place) {
    std::vector<Field> fields = {{"x_m", {}}, {"y_m", {}}, {"yaw_rad", {}}};
    const PoseCovariance covariance = place ? place->covariance : PoseCovariance{};
    if (place) {
        fields[0].text = decimal(place->x_m, 9);
        fields[1].text = decimal(place->y_m, 9);
        fields[2].text = radians(place->yaw_rad);
    }
    append(fields, scaled("covariance_m_rad", covariance, {1, 1, 1}, covariance[0][0] > 0));
    return fields;
}

std::string metres(double mm) {
    return decimal(mm / 1000, 9);
}

void append(std::vector<Field>& fields, std::vector<Field> more) {
    std::move(more.begin(), more.end(), std::back_inserter(fields));
}

}  // namespace dotpose::cli
