#include "page_calibration_arguments.hpp"

#include "dotpose/files/camera_file.hpp"
#include "dotpose/files/write_file.hpp"
#include "kept_camera.hpp"
#include "sheet_text.hpp"
#include "system/path.hpp"

namespace dotpose::cli {

void PageCalibrationArguments::add_to(Command& command) {
    command_ = &command;
    command
        .add_option("--calibrate-to", file_,
                    "Camera file that the page of --web calibrates and writes; no other file can "
                    "be chosen there. Without --camera, the run starts with this file if it exists")
        ->type_name("FILE");
}

void PageCalibrationArguments::use_replaced_camera(FollowerArguments& follower) const {
    CameraArgument& camera = follower.camera;
    if (file_.empty() || !camera.path.empty()) return;
    camera.camera = replaced_camera("--calibrate-to", file_);
    if (camera.camera) camera.path = file_;
}

void PageCalibrationArguments::require_page(const WebArguments& web) const {
    if (!file_.empty() && !web.is_wanted())
        throw BadArgument("--calibrate-to needs --web [ADDRESS:]PORT");
}

void PageCalibrationArguments::require_writable_file() const {
    if (!file_.empty()) require_writable(system::path_of(file_));
}

void PageCalibrationArguments::add_files(const FollowerArguments& follower, RunFiles& files) const {
    const std::string& camera = follower.camera.path;
    files.reads("--sheets", follower.sheets);
    const auto identity = identity_of(camera);
    if (identity && identity == identity_of(file_) && !is_camera_info(system::path_of(camera))) {
        files.updates("--calibrate-to", file_, Content::yaml);
        return;
    }
    files.reads("--camera", camera);
    files.writes("--calibrate-to", file_, Content::yaml);
}

std::optional<GuideOptions> PageCalibrationArguments::options(const FollowerArguments& arguments,
                                                              const SourceArguments& sources,
                                                              const Follower& follower) const {
    if (file_.empty()) return std::nullopt;
    GuideOptions guide;
    guide.file = file_;
    guide.camera = arguments.camera.camera;
    guide.needs_focal_length = follower.fits_space_pose();
    guide.flip = sources.options.flip;
    CalibrateOptions& calibrate = guide.calibrate;
    calibrate.sheets = follower.sheets();
    calibrate.pattern.spacing_mm = arguments.options.spacing_mm;
    std::optional<CodeVariant> code = arguments.options.code;
    if (!calibrate.sheets.empty()) {
        code = common_code(arguments.sheets, calibrate.sheets);
        guide.spacing = SpacingSource::sheets;
    } else if (command_->count("--spacing") > 0) {
        guide.spacing = SpacingSource::option;
    }
    calibrate.any_code = !code;
    calibrate.pattern.code = code.value_or(CodeVariant::anoto);
    return guide;
}

}  // namespace dotpose::cli
