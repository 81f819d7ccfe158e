// Bindings for SpaceTracker, which tracks a camera in space.
#include "dotpose/tools/space_track.hpp"

#include <algorithm>
#include <array>
#include <string>

#include <fmt/core.h>

#include "space.hpp"

namespace dotpose::python {
namespace {

/// A member of SpaceTrackOptions that can be set by name.
struct SpaceTrackOption {
    const char* name;
    double SpaceTrackOptions::*member;
};
constexpr std::array kSpaceTrackOptions = {
    SpaceTrackOption{"acceleration_mm_s2", &SpaceTrackOptions::acceleration_mm_s2},
    SpaceTrackOption{"angular_acceleration_rad_s2",
                     &SpaceTrackOptions::angular_acceleration_rad_s2},
    SpaceTrackOption{"hold_s", &SpaceTrackOptions::hold_s},
    SpaceTrackOption{"speed_mm_s", &SpaceTrackOptions::speed_mm_s},
    SpaceTrackOption{"turn_rad_s", &SpaceTrackOptions::turn_rad_s},
    SpaceTrackOption{"max_innovation", &SpaceTrackOptions::max_innovation},
};

SpaceTrackOptions space_track_options_of(const py::dict& given) {
    SpaceTrackOptions options;
    for (const auto& [key, value] : given) {
        const std::string name = py::str(key);
        const auto* const option =
            std::ranges::find_if(kSpaceTrackOptions, [&](const auto& o) { return name == o.name; });
        if (option != kSpaceTrackOptions.end()) {
            options.*option->member = value.cast<double>();
        } else if (name == "confirmations") {
            options.confirmations = value.cast<int>();
        } else if (name == "lost_after_us") {
            options.lost_after_us = value.cast<std::int64_t>();
        } else {
            throw py::type_error("a space tracker has no option '" + name + "'");
        }
    }
    return options;
}

std::string text_of(const SpaceTrack& track) {
    if (track.is_lost) return "<SpaceTrack lost>";
    const CameraInSpace& camera = track.camera;
    return fmt::format("<SpaceTrack ({:.3f}, {:.3f}, {:.3f}) mm, {}>", camera.x_mm, camera.y_mm,
                       camera.z_mm, name(track.verdict));
}

void define_space_track(py::module_& module) {
    py::class_<SpaceTrack>(module, "SpaceTrack",
                           "State of a tracked camera in space, in the frame of its poses. The "
                           "pose is valid unless is_lost.")
        .def_readonly("is_lost", &SpaceTrack::is_lost, "True if there is no track.")
        .def_readonly("is_new", &SpaceTrack::is_new,
                      "True if the track does not continue the previous track.")
        .def_property_readonly(
            "verdict", [](const SpaceTrack& self) { return name(self.verdict); },
            "Decision about the pose of the frame: \"none\", \"accepted\", "
            "\"second_accepted\" or \"rejected\".")
        .def_readonly("time_us", &SpaceTrack::time_us, "Time of the pose, in us.")
        .def_property_readonly(
            "position_mm", [](const SpaceTrack& self) { return position_of(self.camera); },
            "Position (x, y, z) of the projection centre, in mm.")
        .def_property_readonly(
            "quaternion", [](const SpaceTrack& self) { return tuple_of(self.camera.rotation); },
            "Rotation (x, y, z, w) from the camera frame.")
        .def_property_readonly(
            "covariance", [](const SpaceTrack& self) { return array_of(self.covariance); },
            "Covariance of the pose, 6 x 6, as SpacePose.covariance.")
        .def_readonly("velocity_mm_s", &SpaceTrack::velocity_mm_s,
                      "Velocity along x, y and z, in mm/s.")
        .def_readonly("turn_rad_s", &SpaceTrack::turn_rad_s,
                      "Angular velocity about the axes of the camera frame, in rad/s.")
        .def_property_readonly(
            "velocity_covariance",
            [](const SpaceTrack& self) { return array_of(self.velocity_covariance); },
            "Covariance of the velocity and of the angular velocity, 6 x 6.")
        .def("__repr__", &text_of);
}

}  // namespace

void define_space_tracker(py::module_& module) {
    define_space_track(module);
    py::class_<SpaceTracker>(
        module, "SpaceTracker",
        "Tracks one camera in space, from the poses of its frames. Follower does this for its "
        "frames.\n\n"
        "    track = tracker.update(time_us, follower.locate(image).space)")
        .def(py::init([](const py::kwargs& options) {
                 return SpaceTracker(space_track_options_of(options));
             }),
             "Make a tracker without a track. Options are keyword arguments: the members of "
             "SpaceTrackOptions in C++, such as acceleration_mm_s2=2000, lost_after_us=200000.")
        .def(
            "update",
            [](SpaceTracker& self, std::int64_t time_us, const std::optional<SpacePose>& pose,
               std::uint32_t plane) {
                return pose ? self.update(sighting_of(*pose, time_us, plane))
                            : self.update(time_us);
            },
            "time_us"_a, "pose"_a = py::none(), "plane"_a = 0,
            "Update the tracker with the next frame: its time in us on any clock, and its "
            "SpacePose, if there is one. Return the SpaceTrack after the frame. plane: ID of the "
            "coordinate frame of the pose; another ID starts a new track.")
        .def("predict", &SpaceTracker::predict, "time_us"_a,
             "Return the SpaceTrack at a time after the last accepted pose; None while the camera "
             "is lost.")
        .def_property_readonly(
            "track", [](const SpaceTracker& self) { return SpaceTrack(self.track()); },
            "The SpaceTrack after the newest frame.");
}

}  // namespace dotpose::python
