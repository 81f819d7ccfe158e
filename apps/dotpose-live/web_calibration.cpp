#include "web_calibration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "dotpose/files/degrees.hpp"
#include "draw/deviation.hpp"
#include "json_text.hpp"
#include "system/path.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

using draw::plus_minus;
using nlohmann::json;
using namespace std::chrono_literals;

constexpr std::chrono::milliseconds kPeriod = 100ms;
constexpr std::chrono::seconds kReportPeriod = 10s;

json json_of(const std::vector<video::Gauge>& gauges) {
    json all = json::array();
    for (const video::Gauge& gauge : gauges) {
        all.push_back({{"label", gauge.label},
                       {"text", gauge.text},
                       {"fraction", gauge.fraction},
                       {"is_reached", gauge.is_reached}});
    }
    return all;
}

json json_of(const CalibrationStatus& status) {
    std::string covered;
    for (int row = 0; row < ImageCoverage::kRows; ++row) {
        for (int column = 0; column < ImageCoverage::kColumns; ++column)
            covered += status.coverage.image().is_covered(column, row) ? '1' : '0';
    }
    json directions = json::array();
    for (int i = 0; i < CalibrationCoverage::kDirections; ++i)
        directions.push_back(status.coverage.has_direction(i));
    json needs = json::array();
    for (const CalibrationNeed& need : status.needs)
        needs.push_back(need.advice);
    json tilts = json::array();
    for (const FrameTilt& tilt : status.tilts)
        tilts.push_back({tilt.u, tilt.v});
    return {{"columns", ImageCoverage::kColumns},
            {"covered", std::move(covered)},
            {"directions", std::move(directions)},
            {"theta_rad", status.theta_rad ? json(*status.theta_rad) : json(nullptr)},
            {"tilts", std::move(tilts)},
            {"needs", std::move(needs)},
            {"remark", status.remark},
            {"is_taken", status.is_taken}};
}

/// Returns the mean residuals of the image blocks, in one list for the lens before the calibration
/// and one for the calibrated lens. In each list, u and v components alternate.
json json_of(const ResidualField& field) {
    json before = json::array();
    json after = json::array();
    const auto add = [](json& values, PixelPoint sum, int dots) {
        for (const double value : {sum.u, sum.v})
            values.push_back(dots > 0 ? std::round(1e4 * value / dots) / 1e4 : 0);
    };
    for (const ResidualField::Part& part : field.parts) {
        add(before, part.before, part.dots);
        add(after, part.after, part.dots);
    }
    return {{"columns", field.columns},
            {"rows", field.rows},
            {"before", std::move(before)},
            {"after", std::move(after)}};
}

/// Returns the rows of a report (calibrate_report.hpp), each consisting of a label and its text.
json rows_of(std::string_view report) {
    constexpr std::size_t kLabelColumns = 12;
    json rows = json::array();
    while (!report.empty()) {
        const std::string_view line = report.substr(0, report.find('\n'));
        report.remove_prefix(std::min(report.size(), line.size() + 1));
        const std::string_view label = line.substr(0, kLabelColumns);
        rows.push_back({std::string(label.substr(0, label.find_last_not_of(' ') + 1)),
                        std::string(line.substr(std::min(line.size(), kLabelColumns)))});
    }
    return rows;
}

json json_of(const GuideResult& result) {
    json stations = json::array();
    for (const SpinStation& station : result.stations)
        stations.push_back(
            {station.x_mm, station.y_mm, station.theta_rad, station.off_x_mm, station.off_y_mm});
    return {{"rows", rows_of(result.report)},
            {"is_good", result.is_good},
            {"improvements", result.improvements},
            {"residuals", result.residuals ? json_of(*result.residuals) : json(nullptr)},
            {"stations_mm", std::move(stations)}};
}

std::string sigma_text(const Camera& camera, const char* key, double factor, int digits) {
    const auto sigma = camera.sigma.find(key);
    return sigma == camera.sigma.end() ? "" : plus_minus(factor * sigma->second, digits);
}

/// Describes the lens. Returns an empty string if the lens was not calibrated, that is, if it has
/// neither distortion nor standard deviations.
std::string lens_text(const Camera& camera) {
    constexpr std::array kSigmas = {"k_per_px2", "centre_u_px", "centre_v_px"};
    const auto is_known = [&camera](const char* key) { return camera.sigma.contains(key); };
    if (!std::ranges::all_of(kSigmas, is_known)) {
        return camera.k_per_px2 == 0 ? "" : fmt::format("k {:.4e} per px^2", camera.k_per_px2);
    }
    return fmt::format("k {:.4e} per px^2, corner known to {:.3f} px", camera.k_per_px2,
                       corner_sigma_px(camera));
}

std::string reference_text(const Camera& camera) {
    const PixelPoint reference = *camera.reference_px;
    if (!camera.paper) {
        return fmt::format("{:.2f}, {:.2f}{} px", reference.u, reference.v,
                           sigma_text(camera, "reference_u_px", 1, 2));
    }
    const CameraPoint offset = from_image_centre(camera, reference);
    return fmt::format("{:+.3f}, {:+.3f}{} mm from the image centre", offset.x_mm, offset.y_mm,
                       sigma_text(camera, "reference_u_px", camera.paper->mm_per_px_x, 4));
}

std::string tip_text(const Camera& camera) {
    const PenTip& tip = *camera.tip;
    return fmt::format("{:.3f}{}, {:.3f}{}, {:.3f}{} mm from the camera", tip.x_mm,
                       sigma_text(camera, "tip_x_mm", 1, 4), tip.y_mm,
                       sigma_text(camera, "tip_y_mm", 1, 4), tip.z_mm,
                       sigma_text(camera, "tip_z_mm", 1, 4));
}

/// Returns the values in the camera file, grouped by calibration step. The text for a missing value
/// is empty.
json values_of(const std::optional<Camera>& camera) {
    json values = {{"lens", ""}, {"spin", ""}, {"drive", ""}, {"readout", ""}, {"pivot", ""}};
    if (!camera) return values;
    values["lens"] = lens_text(*camera);
    if (camera->reference_px) values["spin"] = reference_text(*camera);
    if (camera->theta_offset_rad != 0 || camera->sigma.contains("theta_offset_rad")) {
        values["drive"] = fmt::format("{:+.3f}{} degrees", camera->theta_offset_rad * kDegrees,
                                      sigma_text(*camera, "theta_offset_rad", kDegrees, 3));
    }
    if (camera->readout_ms) {
        values["readout"] = fmt::format("{:.3f}{} ms", *camera->readout_ms,
                                        sigma_text(*camera, "readout_ms", 1, 3));
    }
    if (camera->tip) values["pivot"] = tip_text(*camera);
    return values;
}

json json_of(const std::vector<PenLean>& leans) {
    json all = json::array();
    for (const PenLean& lean : leans)
        all.push_back({lean.x, lean.y});
    return all;
}

json json_of(const GuideState& state, const std::string& file) {
    return {{"file", system::path_of(file).filename().string()},
            {"step", name(state.step)},
            {"phase", name(state.phase)},
            {"frames", state.frames},
            {"gauges", json_of(state.gauges)},
            {"advice", state.advice},
            {"lens", state.lens ? json_of(*state.lens) : json(nullptr)},
            {"directions", state.directions},
            {"leans", json_of(state.leans)},
            {"needs", state.needs},
            {"problem", state.problem},
            {"result", state.result ? json_of(*state.result) : json(nullptr)},
            {"values", values_of(state.camera)}};
}

}  // namespace

WebCalibration::WebCalibration(std::optional<GuideOptions> options, serve::Server& server)
    : server_(server), topic_(server.add_topic("calibration", serve::Format::text)) {
    if (options) guide_.emplace(std::move(*options));
}

void WebCalibration::obey(const serve::Command& command) {
    if (!guide_) {
        refuse("a command to calibrate, without --calibrate-to");
        return;
    }
    const std::string* action = command.argument<std::string>("action");
    const std::string* step = command.argument<std::string>("step");
    const std::size_t known = (action != nullptr ? 1 : 0) + (step != nullptr ? 1 : 0);
    const std::optional<GuideStep> started = step != nullptr ? guide_step(*step) : std::nullopt;
    const bool is_start = action != nullptr && *action == "start";
    if (action == nullptr || known != command.arguments.size() || is_start != started.has_value()) {
        refuse("a command to calibrate with wrong arguments");
    } else if (is_start) {
        guide_->start(*started);
    } else if (*action == "finish") {
        guide_->finish();
    } else if (*action == "cancel") {
        guide_->cancel();
    } else if (*action == "save") {
        guide_->save();
    } else {
        refuse("an unknown command to calibrate");
    }
}

void WebCalibration::refuse(const std::string& reason) {
    const Clock::time_point now = Clock::now();
    if (now < next_report_) return;
    next_report_ = now + kReportPeriod;
    notify("web: refused " + reason);
}

void WebCalibration::set_sheets(std::vector<SheetEntry> sheets) {
    if (guide_) guide_->set_sheets(std::move(sheets));
}

void WebCalibration::take(const capture::Frame& frame, const Reading& reading, ImageView image,
                          double bits_per_px) {
    if (guide_ && image.pixels != nullptr) guide_->take(frame, reading, image, bits_per_px);
    const Clock::time_point now = Clock::now();
    if (now < next_ || (published_ && !topic_.is_wanted())) return;
    next_ = now + kPeriod;
    publish();
}

void WebCalibration::publish() {
    const std::uint64_t version = guide_ ? guide_->version() : 0;
    if (published_ == version) return;
    published_ = version;
    if (!guide_) {
        server_.publish(topic_, [] { return std::string(R"({"file":null})"); });
        return;
    }
    server_.publish(topic_, [state = guide_->state(), file = guide_->file()] {
        return text_of(json_of(state, file));
    });
}

std::optional<Camera> WebCalibration::take_camera() {
    return guide_ ? guide_->take_camera() : std::nullopt;
}

}  // namespace dotpose::cli
