#include "space_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

#include <fmt/core.h>

#include "dotpose/files/degrees.hpp"

namespace dotpose::cli {
namespace {

/// Axes of the position in space, as they appear in field names.
constexpr std::array kAxes = {"x", "y", "z"};
constexpr std::array kComponents = {"x", "y", "z", "w"};

/// Fields that `Columns::brief` selects.
constexpr std::array<std::string_view, 19> kBrief = {
    "camera_x_mm",        "camera_y_mm",       "camera_z_mm",        "camera_tilt_deg",
    "camera_azimuth_deg", "camera_turn_deg",   "camera_x_pattern_m", "camera_y_pattern_m",
    "camera_z_pattern_m", "camera_x_sheet_mm", "camera_y_sheet_mm",  "camera_z_sheet_mm",
    "camera_x_sheet_m",   "camera_y_sheet_m",  "camera_z_sheet_m",   "camera_x_m",
    "camera_y_m",         "camera_z_m",        "camera_is_ambiguous"};

/// A pose in the axes and units of the output.
struct OutputPose {
    std::array<double, 3> position{};
    Quaternion rotation;
    SpaceCovariance covariance{};
};

/// Converts a pose to the units and axes of the output: mm with unchanged axes, or metres with y up
/// and z out of the paper.
OutputPose in_units(Units units, const CameraInSpace& camera, const SpaceCovariance& covariance) {
    if (units == Units::mm)
        return {{camera.x_mm, camera.y_mm, camera.z_mm}, camera.rotation, covariance};
    const CameraInWorld up = in_world(camera, covariance, WorldPose{});
    return {{up.x_m, up.y_m, up.z_m}, up.rotation, up.covariance};
}

/// Appends the fields PREFIXxSUFFIX, PREFIXySUFFIX and PREFIXzSUFFIX.
void append_position(const std::string& prefix, const std::string& suffix, Units units,
                     const OutputPose& pose, std::vector<Field>& fields) {
    for (std::size_t i = 0; i < kAxes.size(); ++i) {
        fields.push_back(
            {prefix + kAxes[i] + suffix, decimal(pose.position[i], units == Units::ros ? 9 : 6)});
    }
}

void append_rotation(const std::string& name, const Quaternion& q, std::vector<Field>& fields) {
    const std::array values = {q.x, q.y, q.z, q.w};
    for (std::size_t i = 0; i < values.size(); ++i) {
        fields.push_back(
            {fmt::format("{}_{}", name, kComponents[i]), decimal(values[i], 9), false, name});
    }
}

/// Appends the 36 fields of a covariance. `angle` is the number of output angle units per radian.
void append_covariance(const std::string& name, double angle, const SpaceCovariance& covariance,
                       std::vector<Field>& fields) {
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j) {
            const double factor = (i < 3 ? 1 : angle) * (j < 3 ? 1 : angle);
            fields.push_back({fmt::format("{}_{}{}", name, i, j),
                              significant(factor * covariance[i][j]), false, name});
        }
    }
}

/// Returns the fields, with empty values if `is_known` is false.
std::vector<Field> if_known(bool is_known, std::vector<Field> fields) {
    if (is_known) return fields;
    for (Field& field : fields)
        field.text.clear();
    return fields;
}

/// Returns the fields for position, rotation and covariance in the pattern frame. The field names
/// begin with `prefix`.
std::vector<Field> pattern_fields(const std::string& prefix, const CameraInSpace& camera,
                                  const SpaceCovariance& covariance, Units units) {
    std::vector<Field> fields;
    const bool is_ros = units == Units::ros;
    const OutputPose pose = in_units(units, camera, covariance);
    append_position(prefix, is_ros ? "_pattern_m" : "_mm", units, pose, fields);
    append_rotation(prefix + (is_ros ? "quaternion_pattern_xyzw" : "quaternion_xyzw"),
                    pose.rotation, fields);
    if (is_ros) {
        append_covariance(prefix + "covariance_pattern_m_rad", 1, pose.covariance, fields);
    } else {
        append_covariance(prefix + "covariance_mm_deg", kDegrees, pose.covariance, fields);
    }
    return fields;
}

/// Returns the fields for the tilt, azimuth and turn of a pose. Only the output with `Units::mm`
/// contains these fields.
std::vector<Field> lean_fields(const Quaternion& rotation) {
    const CameraLean lean = lean_of(rotation);
    return {{"camera_tilt_deg", degrees(lean.tilt_rad)},
            {"camera_azimuth_deg", degrees(lean.azimuth_rad)},
            {"camera_turn_deg", degrees(lean.turn_rad)}};
}

std::vector<Field> evidence_fields_of(const SpacePose& space) {
    return {{"camera_dots", fmt::format("{}", space.dots)},
            {"camera_residual_px", decimal(space.residual_px, 4)},
            {"camera_is_ambiguous", space.is_ambiguous() ? "true" : "false"}};
}

std::vector<Field> second_fields(const SecondPose& second, Units units) {
    const bool is_ros = units == Units::ros;
    const OutputPose pose = in_units(units, second.camera, {});
    std::vector<Field> fields = {{"camera_second_odds", p_wrong_text(std::exp2(second.odds_log2))}};
    append_position("camera_second_", is_ros ? "_pattern_m" : "_mm", units, pose, fields);
    append_rotation(
        is_ros ? "camera_second_quaternion_pattern_xyzw" : "camera_second_quaternion_xyzw",
        pose.rotation, fields);
    return fields;
}

std::vector<Field> sheet_fields_of(const CameraInSpace& camera, Units units) {
    std::vector<Field> fields;
    append_position("camera_", units == Units::ros ? "_sheet_m" : "_sheet_mm", units,
                    in_units(units, camera, {}), fields);
    return fields;
}

std::vector<Field> world_fields_of(const std::string& prefix, const CameraInWorld& world) {
    std::vector<Field> fields;
    append_position(prefix, "_m", Units::ros, {{world.x_m, world.y_m, world.z_m}, {}, {}}, fields);
    append_rotation(prefix + "quaternion_world_xyzw", world.rotation, fields);
    append_covariance(prefix + "covariance_m_rad", 1, world.covariance, fields);
    return fields;
}

/// Returns the largest of the standard deviations of the three coordinates `first` to `first` + 2.
double largest_sigma(const SpaceCovariance& covariance, std::size_t first) {
    return std::sqrt(std::max({covariance[first][first], covariance[first + 1][first + 1],
                               covariance[first + 2][first + 2]}));
}

/// Returns the fields for the velocity, the angular velocity and their standard deviations. The
/// velocity is along the axes of the world or the pattern frame. The angular velocity is about the
/// axes of the camera.
std::vector<Field> velocity_fields(const CameraMotion& motion, bool is_in_world, Units units) {
    const bool is_ros = units == Units::ros;
    const double length = is_ros ? 1 : 1000;
    const double angle = is_ros ? 1 : kDegrees;
    const double down = is_in_world || is_ros ? 1 : -1;
    const int decimals = is_ros ? 6 : 3;
    const std::string per_s = is_ros ? "_m_s" : "_mm_s";
    const std::string turn = is_ros ? "camera_turn_rad_s" : "camera_turn_deg_s";
    std::vector<Field> fields;
    for (std::size_t i = 0; i < 3; ++i) {
        fields.push_back(
            {std::string("camera_v") + kAxes[i] + per_s,
             decimal((i == 0 ? 1 : down) * length * motion.velocity_m_s[i], decimals)});
    }
    for (std::size_t i = 0; i < 3; ++i) {
        fields.push_back(
            {turn + '_' + kAxes[i], decimal(angle * motion.turn_rad_s[i], decimals), false, turn});
    }
    fields.push_back({"camera_sigma_v" + per_s,
                      decimal(length * largest_sigma(motion.velocity_covariance, 0), decimals)});
    fields.push_back({is_ros ? "camera_sigma_turn_rad_s" : "camera_sigma_turn_deg_s",
                      decimal(angle * largest_sigma(motion.velocity_covariance, 3), decimals)});
    return fields;
}

}  // namespace

std::vector<Field> space_fields(const std::optional<SpacePose>& space,
                                const std::optional<SheetPlace>& place, bool has_sheets,
                                Units units) {
    const SpacePose pose = space.value_or(SpacePose{});
    std::vector<Field> fields =
        if_known(space.has_value(), pattern_fields("camera_", pose.camera, pose.covariance, units));
    if (units == Units::mm)
        append(fields, if_known(space.has_value(), lean_fields(pose.camera.rotation)));
    append(fields, if_known(space.has_value(), evidence_fields_of(pose)));
    append(fields, if_known(pose.second.has_value(),
                            second_fields(pose.second.value_or(SecondPose{}), units)));
    if (!has_sheets) return fields;
    const bool is_on_sheet = space && place;
    const CameraInSpace on_page = is_on_sheet ? on_sheet(pose.camera, *place->entry) : pose.camera;
    append(fields, if_known(is_on_sheet, sheet_fields_of(on_page, units)));
    const bool is_in_world = is_on_sheet && place->entry->world;
    const WorldPose page = is_in_world ? *place->entry->world : WorldPose{};
    append(fields, if_known(is_in_world,
                            world_fields_of("camera_", in_world(on_page, pose.covariance, page))));
    return fields;
}

std::vector<Field> space_track_fields(const SpaceTrack& track, bool is_in_world, bool has_sheets,
                                      Units units) {
    const CameraMotion motion = motion_of(track).value_or(CameraMotion{});
    std::vector<Field> fields = {{"camera_verdict", name(track.verdict), true}};
    append(fields,
           if_known(!track.is_lost && !is_in_world,
                    pattern_fields("camera_track_", track.camera, track.covariance, units)));
    if (has_sheets) {
        append(fields, if_known(!track.is_lost && is_in_world,
                                world_fields_of("camera_track_", motion.pose)));
    }
    append(fields, if_known(!track.is_lost, velocity_fields(motion, is_in_world, units)));
    return fields;
}

bool is_brief_space_field(const std::string& name) {
    return std::ranges::find(kBrief, name) != kBrief.end();
}

std::string space_text(const SpacePose& pose, const std::optional<SheetPlace>& place, Units units) {
    const bool is_ros = units == Units::ros;
    const CameraInSpace camera = place ? on_sheet(pose.camera, *place->entry) : pose.camera;
    const double sign = is_ros ? -1 : 1;  // in ROS output, y and z have the opposite sign
    const std::array values = {camera.x_mm, sign * camera.y_mm, sign * camera.z_mm};
    const double per_mm = is_ros ? 1e-3 : 1;
    std::string text = "camera";
    for (std::size_t i = 0; i < values.size(); ++i) {
        text += fmt::format(" {} {} ± {:.2g} {},", kAxes[i],
                            decimal(per_mm * values[i], is_ros ? 7 : 4),
                            per_mm * std::sqrt(pose.covariance[i][i]), is_ros ? "m" : "mm");
    }
    const CameraLean lean = lean_of(camera.rotation);
    return text + fmt::format(" tilt {:.3f} deg towards {:.1f} deg, turn {:.3f} deg",
                              lean.tilt_rad * kDegrees, sign * lean.azimuth_rad * kDegrees,
                              sign * lean.turn_rad * kDegrees);
}

}  // namespace dotpose::cli
