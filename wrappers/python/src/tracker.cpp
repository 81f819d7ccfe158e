// Bindings for Tracker, which tracks a robot using the fixes of its frames, and for Track, the
// result of Tracker.
#include "tracker.hpp"

#include <array>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include "dotpose/files/error.hpp"
#include "fix.hpp"

namespace dotpose::python {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A float member of TrackOptions that can be set by name.
struct FloatOption {
    const char* name;
    float TrackOptions::*member;
};
constexpr std::array kFloatOptions = {
    FloatOption{"acceleration_mm_s2", &TrackOptions::acceleration_mm_s2},
    FloatOption{"angular_acceleration_rad_s2", &TrackOptions::angular_acceleration_rad_s2},
    FloatOption{"max_acceleration_mm_s2", &TrackOptions::max_acceleration_mm_s2},
    FloatOption{"max_angular_acceleration_rad_s2", &TrackOptions::max_angular_acceleration_rad_s2},
    FloatOption{"max_speed_mm_s", &TrackOptions::max_speed_mm_s},
    FloatOption{"max_turn_rad_s", &TrackOptions::max_turn_rad_s},
    FloatOption{"gate_sigmas", &TrackOptions::gate_sigmas},
    FloatOption{"max_sigma_mm", &TrackOptions::max_sigma_mm},
    FloatOption{"still_mm", &TrackOptions::still_mm},
    FloatOption{"still_rad", &TrackOptions::still_rad},
    FloatOption{"min_sigma_mm", &TrackOptions::min_sigma_mm},
    FloatOption{"min_sigma_rad", &TrackOptions::min_sigma_rad},
    FloatOption{"spacing_mm", &TrackOptions::spacing_mm},
};
struct IntOption {
    const char* name;
    int TrackOptions::*member;
};
constexpr std::array kIntOptions = {
    IntOption{"confirmations", &TrackOptions::confirmations},
    IntOption{"max_p_wrong_log2", &TrackOptions::max_p_wrong_log2},
    IntOption{"max_weak_p_wrong_log2", &TrackOptions::max_weak_p_wrong_log2},
};
struct TimeOption {
    const char* name;
    std::int64_t TrackOptions::*member;
};
constexpr std::array kTimeOptions = {
    TimeOption{"lost_after_us", &TrackOptions::lost_after_us},
    TimeOption{"stationary_after_us", &TrackOptions::stationary_after_us},
};

template <typename Value, typename Named>
bool set_if_named(const Named& named, const std::string& key, const py::handle& value,
                  TrackOptions& options) {
    for (const auto& option : named) {
        if (key != option.name) continue;
        try {
            options.*option.member = value.cast<Value>();
        } catch (const py::cast_error&) {
            throw py::type_error(key + " must be a number");
        }
        return true;
    }
    return false;
}

/// A Tracker and its newest fix. Predictions are based on this fix.
class TrackerOfPython {
  public:
    explicit TrackerOfPython(const TrackOptions& options) : tracker_(options) {}

    Track update(std::int64_t time_us, const std::optional<PyFix>& fix,
                 const std::optional<MeasuredMotion>& motion) {
        const bool is_ok = fix && fix->is_ok();
        if (is_ok && !(fix->fix.spacing_mm() <= 20)) {
            throw BadArgument("the spacing of the pattern must be known and at most 20 mm");
        }
        if (is_ok) {
            newest_ = fix;
            sighting_ = sighting_of(fix->fix, time_us);
        }
        const Sighting* sighting = is_ok ? &sighting_ : nullptr;
        return motion ? tracker_.update(time_us, sighting, *motion)
                      : tracker_.update(time_us, sighting);
    }

    std::optional<SeenPrediction> predict(std::int64_t time_us) const {
        if (!newest_ || !tracker_.has_prior()) return std::nullopt;
        DeviceOptions options;
        options.code = newest_->code;
        options.reference_dx_q8 = newest_->reference_q8.x;
        options.reference_dy_q8 = newest_->reference_q8.y;
        SeenPrediction result = SeenPrediction::like(*newest_);
        result.prediction = tracker_.predict(time_us, newest_->fix, sighting_, options);
        return result;
    }

    const Track& track() const { return tracker_.track(); }

  private:
    Tracker tracker_;
    std::optional<PyFix> newest_;
    Sighting sighting_;
};

py::set events(const Track& track) {
    const TrackEvents& happened = track.events;
    py::set names;
    if (happened.fix) names.add("fix");
    if (happened.lost) names.add("lost");
    if (happened.kidnapped) names.add("kidnapped");
    if (happened.stationary) names.add("stationary");
    if (happened.moving) names.add("moving");
    return names;
}

py::array_t<double> covariance(const Track& track) {
    py::array_t<double> array({6, 6});
    auto at = array.mutable_unchecked<2>();
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
            at(i, j) = track.is_lost ? kNaN
                                     : double{track.pose.covariance[static_cast<std::size_t>(i)]
                                                                   [static_cast<std::size_t>(j)]};
    return array;
}

/// Returns a getter for a member of the pose. The result is NaN while the robot is lost.
template <typename Get>
auto if_seen(Get get) {
    return [get](const Track& self) { return self.is_lost ? kNaN : double{get(self.pose)}; };
}

std::string text_of_track(const Track& track) {
    if (track.is_lost) return "<Track lost>";
    return fmt::format("<Track x {:.3f} mm, y {:.3f} mm, theta {:.4f} rad, {:.1f} and {:.1f} mm/s>",
                       track.pose.x_mm(), track.pose.y_mm(), track.pose.theta_rad(),
                       double{track.pose.vx_mm_s}, double{track.pose.vy_mm_s});
}

void define_track(py::module_& module) {
    py::class_<Track>(module, "Track",
                      "The state of a robot after a frame. Its plane is the pattern (mm, y DOWN), "
                      "or the world of a sheet file (mm, y up).")
        .def_readonly("is_lost", &Track::is_lost,
                      "True if the robot has not been seen for too long. The pose is then nan.")
        .def_readonly("is_stationary", &Track::is_stationary, "True if the robot is at rest.")
        .def_property_readonly(
            "verdict", [](const Track& self) { return name(self.verdict); },
            "Verdict of the tracker on the fix: \"none\", \"accepted\", \"with_prior\", \"gated\" "
            "or "
            "\"too_weak\".")
        .def_property_readonly(
            "p_wrong", [](const Track& self) { return std::ldexp(1.0, self.p_wrong_log2); },
            "Upper bound of the probability that the pose is wrong, given the previous frames.")
        .def_property_readonly("events", &events,
                               "Changes caused by the frame: a set of \"fix\", \"lost\", "
                               "\"kidnapped\", \"stationary\", \"moving\".")
        .def_property_readonly(
            "time_us", [](const Track& self) { return self.pose.time_us; },
            "Time of the pose, in us.")
        .def_property_readonly("x_mm", if_seen([](const TrackedPose& p) { return p.x_mm(); }),
                               "Position, in mm.")
        .def_property_readonly("y_mm", if_seen([](const TrackedPose& p) { return p.y_mm(); }),
                               "Position, in mm.")
        .def_property_readonly("theta_rad",
                               if_seen([](const TrackedPose& p) { return p.theta_rad(); }),
                               "Angle, in rad, in [-pi, pi).")
        .def_property_readonly("vx_mm_s", if_seen([](const TrackedPose& p) { return p.vx_mm_s; }),
                               "Velocity along x, in mm/s.")
        .def_property_readonly("vy_mm_s", if_seen([](const TrackedPose& p) { return p.vy_mm_s; }),
                               "Velocity along y, in mm/s.")
        .def_property_readonly("turn_rad_s",
                               if_seen([](const TrackedPose& p) { return p.turn_rad_s; }),
                               "Turn rate, in rad/s.")
        .def_property_readonly("covariance", &covariance,
                               "Covariance of (x, y, theta, their velocities): 6 x 6, in mm, rad "
                               "and s.")
        .def("__repr__", &text_of_track);
}

}  // namespace

TrackOptions track_options_of(const py::dict& given) {
    TrackOptions options;
    for (const auto& [key, value] : given) {
        const std::string name = py::str(key);
        if (!set_if_named<float>(kFloatOptions, name, value, options) &&
            !set_if_named<int>(kIntOptions, name, value, options) &&
            !set_if_named<std::int64_t>(kTimeOptions, name, value, options)) {
            throw py::type_error("a tracker has no option '" + name + "'");
        }
    }
    return options;
}

void define_measured_motion(py::module_& module) {
    py::class_<MeasuredMotion>(module, "MeasuredMotion",
                               "Motion of the camera between two frames, from odometry. The "
                               "displacement is along the axes of the previous image.")
        .def(py::init([](float right_mm, float down_mm, float turn_rad, float sigma_mm,
                         float sigma_rad) {
                 return MeasuredMotion{right_mm, down_mm, turn_rad, sigma_mm, sigma_rad};
             }),
             py::kw_only(), "right_mm"_a = 0.0F, "down_mm"_a = 0.0F, "turn_rad"_a = 0.0F,
             "sigma_mm"_a, "sigma_rad"_a,
             "Make a motion. sigma_mm and sigma_rad are the standard deviations of each "
             "displacement and of the rotation; too small values lead to wrong fixes.")
        .def_readwrite("right_mm", &MeasuredMotion::right_mm,
                       "Displacement along the image x axis, in mm.")
        .def_readwrite("down_mm", &MeasuredMotion::down_mm,
                       "Displacement along the image y axis, in mm.")
        .def_readwrite("turn_rad", &MeasuredMotion::turn_rad, "Change of theta, in rad.")
        .def_readwrite("sigma_mm", &MeasuredMotion::sigma_mm,
                       "Standard deviation of each displacement, in mm.")
        .def_readwrite("sigma_rad", &MeasuredMotion::sigma_rad,
                       "Standard deviation of the rotation, in rad.");
}

void define_tracker(py::module_& module) {
    define_track(module);
    py::class_<TrackerOfPython>(module, "Tracker",
                                "Tracks one robot from the fixes of its frames.\n\n"
                                "    fix = locator.locate(image, tracker.predict(time_us))\n"
                                "    track = tracker.update(time_us, fix)")
        .def(py::init([](const py::kwargs& options) {
                 return TrackerOfPython(track_options_of(options));
             }),
             "Make a tracker, in the state lost. Options are keyword arguments, such as\n"
             "acceleration_mm_s2=600, max_speed_mm_s=1000, lost_after_us=70000; docs/tracking.md\n"
             "lists all options.")
        .def("update", &TrackerOfPython::update, "time_us"_a, "fix"_a = py::none(),
             "motion"_a = py::none(),
             "Update the tracker with the next frame: its time in us on any clock, and its Fix, "
             "which need not be ok. Return the Track after the frame. motion: the MeasuredMotion "
             "since the previous update, from odometry; without fixes, only the motions update "
             "the pose.")
        .def("predict", &TrackerOfPython::predict, "time_us"_a,
             "Return the Prediction for a frame at the given time; None while the robot is lost.")
        .def_property_readonly(
            "track", [](const TrackerOfPython& self) { return Track(self.track()); },
            "The Track after the newest frame.");
}

}  // namespace dotpose::python
