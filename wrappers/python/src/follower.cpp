// Bindings for Follower, which locates frames on the sheets of a sheet file and tracks a robot.
#include "dotpose/tools/follower.hpp"

#include <mutex>

#include <fmt/core.h>

#include "dotpose/files/error.hpp"
#include "fix.hpp"
#include "image.hpp"
#include "rounded.hpp"
#include "sheets.hpp"
#include "tracker.hpp"

namespace dotpose::python {
namespace {

/// Result for one image, exposed to Python as the Located class. `track` is empty if the image is
/// not part of a sequence.
struct SeenLocated {
    PyFix fix;
    std::optional<SeenPlace> place;
    std::optional<SpacePose> space;
    std::optional<TipPose> tip;
    bool is_pen_down = false;
    MapUse map_use = MapUse::no_map;
    int reduced_by = 1;
    std::optional<Track> track;
    std::optional<SpaceTrack> space_track;
};

class FollowerOfPython {
  public:
    FollowerOfPython(const FollowerOptions& options, bool keep_stages)
        : follower_(options), keep_stages_(keep_stages) {}

    SeenLocated locate(const py::object& image) {
        const ImageView view = view_of(image);
        const py::gil_scoped_release others_may_run;
        const std::scoped_lock lock(mutex_);
        return seen(follower_.locate(copy_of(view)));
    }

    SeenLocated follow(const py::object& image, std::int64_t time_us) {
        const ImageView view = view_of(image);
        const py::gil_scoped_release others_may_run;
        const std::scoped_lock lock(mutex_);
        const Followed followed = follower_.follow(view, time_us);
        SeenLocated result = seen(followed.located);
        result.track = followed.track;
        result.space_track = followed.space_track;
        return result;
    }

    const Follower& follower() const { return follower_; }

  private:
    SeenLocated seen(const Located& located) {
        SeenLocated result;
        result.fix = seen_fix(located.reading);
        result.fix.fix = located.fix;
        result.place = seen_place(located.place);
        result.space = located.space;
        result.tip = located.tip;
        result.is_pen_down = located.is_pen_down;
        result.map_use = located.map_use;
        result.reduced_by = located.reduced_by;
        const DeviceOptions& used = follower_.used_options();
        result.fix.reference_q8 = {used.reference_dx_q8, used.reference_dy_q8};
        if (keep_stages_) {
            result.fix.stages = std::make_shared<Stages>(follower_.image(), follower_.trace());
        }
        return result;
    }

    std::mutex mutex_;
    Follower follower_;
    bool keep_stages_;
};

std::unique_ptr<FollowerOfPython> new_follower(
    const std::vector<SheetEntry>& sheets, const std::string& code, double spacing_mm,
    const std::optional<Camera>& camera, const std::optional<std::array<double, 2>>& reference,
    const LocatorOptions& options, bool only_sheets, bool keep_stages, bool space,
    const std::optional<PrintMap>& print_map, const py::kwargs& track) {
    FollowerOptions all;
    all.locate = checked(options);
    all.locate.show_stages |= keep_stages;
    all.locate.spacing_nm = rounded(spacing_mm * 1e6);
    all.sheets = sheets;
    all.has_only_sheets = only_sheets;
    all.code = code_or_auto(code);
    all.spacing_mm = spacing_mm;
    all.camera = camera;
    all.fits_space_pose = space;
    if (print_map) all.print_map = *print_map;
    if (reference) all.reference_px = PixelPoint{(*reference)[0], (*reference)[1]};
    all.track = track_options_of(track);
    return std::make_unique<FollowerOfPython>(all, keep_stages);
}

const char* name_of(MapUse use) {
    switch (use) {
        case MapUse::no_map:
            return "no_map";
        case MapUse::used:
            return "used";
        case MapUse::not_covered:
            return "not_covered";
        case MapUse::contradicted:
            return "contradicted";
    }
    return "no_map";
}

std::string text_of_located(const SeenLocated& self) {
    std::string words = self.fix.is_ok() ? "ok" : name(self.fix.fix.status);
    if (self.place) words += " on '" + self.place->entry.name + "'";
    return "<Located " + words + ">";
}

}  // namespace

void define_follower(py::module_& module) {
    py::class_<SeenLocated>(
        module, "Located", "The result for an image: its fix, the place on a sheet, and the track.")
        .def_property_readonly(
            "fix", [](SeenLocated& self) { return &self.fix; },
            py::return_value_policy::reference_internal, "The Fix, which may not be ok.")
        .def_readonly("place", &SeenLocated::place,
                      "SheetPlace of the fix; None if the fix is on no sheet.")
        .def_readonly("space", &SeenLocated::space,
                      "SpacePose of the camera; None without a fix or if it was not requested.")
        .def_readonly("tip", &SeenLocated::tip,
                      "TipPose of the pen in the pattern frame; None unless the camera has a tip "
                      "and the pose in space is known and not ambiguous.")
        .def_readonly("is_pen_down", &SeenLocated::is_pen_down, "True if the tip is on the paper.")
        .def_property_readonly(
            "map_use", [](const SeenLocated& self) { return name_of(self.map_use); },
            "How the print map was used: 'used'; 'not_covered' if it contains too few of the "
            "dots in view; 'contradicted' if it belongs to another print; 'no_map' without a map "
            "or a fix.")
        .def_readonly("track", &SeenLocated::track,
                      "Track after the image; None from Follower.locate.")
        .def_readonly("space_track", &SeenLocated::space_track,
                      "SpaceTrack of the camera after the image, in the pattern frame or, if "
                      "Follower.is_in_world, in the world with y down, in mm; None from "
                      "Follower.locate or without space.")
        .def_readonly("reduced_by", &SeenLocated::reduced_by,
                      "Factor by which an image was reduced because it was too large.")
        .def("__bool__", [](const SeenLocated& self) { return self.fix.is_ok(); })
        .def("__repr__", &text_of_located);
    py::class_<FollowerOfPython>(
        module, "Follower",
        "Locates images on the sheets of a sheet file and tracks a robot over the sheets.\n\nFor "
        "example::\n\n"
        "    follower = dotpose.Follower(dotpose.read_sheets(\"sheets.json\"))\n"
        "    now = follower.follow(image, time_us)\n"
        "    if now.place:\n"
        "        print(now.place.name, now.place.x_mm, now.place.y_mm)")
        .def(py::init(&new_follower), "sheets"_a = py::list(), "code"_a = "auto",
             "spacing_mm"_a = kDefaultSpacing_mm, py::kw_only(), "camera"_a = py::none(),
             "reference_px"_a = py::none(), py::arg_v("options", LocatorOptions{}, "Options()"),
             "only_sheets"_a = false, "keep_stages"_a = false, "space"_a = false,
             "print_map"_a = py::none(),
             "Make a follower.\n\n"
             "sheets: entries of the pages that may be in view; without sheets, poses are in the "
             "pattern frame.\n"
             "code, spacing_mm: code and spacing of the pattern without sheets.\n"
             "only_sheets: true if no other sheet can be in view; smaller views are then "
             "sufficient.\n"
             "camera, reference_px, options, keep_stages: as in Locator.\n"
             "space: true to fit the pose of the camera in space, which requires a camera with a "
             "focal length.\n"
             "print_map: PrintMap of the sheets, which corrects fixes and poses in space.\n"
             "Options of the tracker are given by name, as in Tracker.")
        .def("locate", &FollowerOfPython::locate, "image"_a,
             "Locate a single image. An image that is too large is reduced.")
        .def("follow", &FollowerOfPython::follow, "image"_a, "time_us"_a,
             "Locate the next image of a sequence, using the previous images; time in us.")
        .def_property_readonly(
            "is_in_world",
            [](const FollowerOfPython& self) { return self.follower().is_in_world(); },
            "True if tracks are in the world of the sheet file (y up) instead of the pattern "
            "frame.")
        .def_property_readonly(
            "sheets", [](const FollowerOfPython& self) { return self.follower().sheets(); },
            "The sheet entries of the follower.");
}

}  // namespace dotpose::python
