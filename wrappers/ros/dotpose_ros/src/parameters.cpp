#include "parameters.hpp"

#include <cmath>
#include <sstream>
#include <vector>

#include <dotpose/files/camera_file.hpp>
#include <dotpose/files/error.hpp>
#include <dotpose/files/sheet_file.hpp>

namespace dotpose_ros {
namespace {

/// Reads parameter values, with one function for each type.
class Values {
  public:
    explicit Values(const std::map<std::string, Value>& values) : values_(values) {}

    const std::string& text(const std::string& name) const {
        return get<std::string>(name, "a string");
    }
    bool flag(const std::string& name) const { return get<bool>(name, "true or false"); }

    /// Returns a number, or none if the parameter has no value. Throws dotpose::Error if the number
    /// is not in [least, most].
    std::optional<double> number(const std::string& name, double least, double most) const {
        const Value& value = values_.at(name);
        if (std::holds_alternative<std::monostate>(value)) return std::nullopt;
        const auto* whole = std::get_if<std::int64_t>(&value);
        const double number =
            whole != nullptr ? static_cast<double>(*whole) : get<double>(name, "a number");
        if (number >= least && number <= most) return number;
        std::ostringstream problem;
        problem << "parameter " << name << " is " << number << "; it must be from " << least
                << " to " << most;
        throw dotpose::Error(problem.str());
    }

  private:
    template <typename Type>
    const Type& get(const std::string& name, const char* what) const {
        if (const auto* value = std::get_if<Type>(&values_.at(name))) return *value;
        throw dotpose::Error("parameter " + name + " must be " + what);
    }

    const std::map<std::string, Value>& values_;
};

dotpose::ros::RobotFrames frames_of(const Values& values) {
    dotpose::ros::RobotFrames frames;
    frames.map = values.text("map_frame");
    frames.odom = values.text("odom_frame");
    frames.base = values.text("base_frame");
    frames.camera = values.text("camera_frame");
    for (const std::string* name : {&frames.map, &frames.odom, &frames.base, &frames.camera}) {
        if (name->empty() || name->starts_with('/')) {
            throw dotpose::Error("the frame '" + *name +
                                 "' is not allowed; names of frames must not be empty or begin "
                                 "with a slash");
        }
    }
    return with_prefix(values.text("frame_prefix"), frames);
}

}  // namespace

std::span<const Parameter> parameters() {
    const dotpose::TrackOptions track;
    const dotpose::ros::RobotFrames frames;
    static const std::vector<Parameter> all = {
        {"sheets", "", "sheet file; without it, poses are in the pattern frame"},
        {"camera", "",
         "camera file of dotpose calibrate; without it, the lens is taken from camera_info"},
        {"spacing_mm", dotpose::kDefaultSpacing_mm, "spacing of the pattern without a sheet file"},
        {"space", false,
         "also publish poses of the camera in space; needs a lens with a focal length, from camera "
         "or camera_info"},
        {"flip", false, "flip images left to right, for a camera that mirrors them"},
        {"max_speed_m_s", double{track.max_speed_mm_s} / 1000, "maximum speed of the robot"},
        {"acceleration_m_s2", double{track.acceleration_mm_s2} / 1000,
         "usual acceleration of the robot"},
        {"exposure_us",
         {},
         "half of it is subtracted from stamps; default: the exposure of the camera file"},
        {"map_frame", frames.map, "frame of the world of the sheets"},
        {"odom_frame", frames.odom, "frame of the first position of the robot"},
        {"base_frame", frames.base, "frame of the robot"},
        {"camera_frame", frames.camera, "frame of the camera, z towards the paper"},
        {"frame_prefix", "", "prefix of all frames except map, such as anna/, for several robots"},
        {"reliable", false,
         "reliable quality of service for poses, odometry, images and camera_info"},
        {"publish_tf", true, "publish map, odom and robot on /tf"},
    };
    return all;
}

Settings settings_of(const std::map<std::string, Value>& parameter_values) {
    const Values values(parameter_values);
    Settings settings;
    dotpose::FollowerOptions& follower = settings.follower;
    settings.frames = frames_of(values);
    settings.is_reliable = values.flag("reliable");
    settings.publishes_tf = values.flag("publish_tf");
    follower.flip = values.flag("flip");
    follower.fits_space_pose = values.flag("space");
    follower.spacing_mm = values.number("spacing_mm", 0.01, 100).value_or(follower.spacing_mm);
    const auto in_mm = [&values](const char* name, float standard) {
        const auto metres = values.number(name, 1e-6, 1e4);
        return metres ? static_cast<float>(1000 * *metres) : standard;
    };
    follower.track.max_speed_mm_s = in_mm("max_speed_m_s", follower.track.max_speed_mm_s);
    follower.track.acceleration_mm_s2 =
        in_mm("acceleration_m_s2", follower.track.acceleration_mm_s2);
    follower.track.spacing_mm = static_cast<float>(follower.spacing_mm);
    auto exposure_us = values.number("exposure_us", 0, 1e7);
    if (const std::string& sheets = values.text("sheets"); !sheets.empty())
        follower.sheets = dotpose::read_sheets(sheets);
    if (const std::string& camera = values.text("camera"); !camera.empty()) {
        follower.camera = dotpose::read_camera(camera);
        settings.has_camera_file = true;
        if (!exposure_us) exposure_us = follower.camera->exposure_us;
    }
    settings.half_exposure_ns = std::llround(500 * exposure_us.value_or(0));
    return settings;
}

}  // namespace dotpose_ros
