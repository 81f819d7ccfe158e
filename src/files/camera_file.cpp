#include "dotpose/files/camera_file.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "dotpose/files/write_file.hpp"
#include "files/ros_camera.hpp"
#include "files/yaml_reader.hpp"

namespace dotpose {
namespace {

using files::YamlMap;

constexpr const char* kFormat = "dotpose-camera";

PixelPoint point(const YamlMap& file, const char* key) {
    const auto numbers = file.numbers(key, 2);
    return {numbers[0], numbers[1]};
}

std::optional<double> optional_number(const YamlMap& file, const char* key) {
    return file.has(key) ? std::optional(file.number(key)) : std::nullopt;
}

PaperScale read_paper(const YamlMap& file) {
    const auto scale = file.numbers("mm_per_px", 2);
    PaperScale paper{scale[0], scale[1], file.has("skew") ? file.number("skew") : 0, 0, 0};
    if (file.has("perspective_per_px")) {
        const PixelPoint perspective = point(file, "perspective_per_px");
        paper.perspective_u = perspective.u;
        paper.perspective_v = perspective.v;
    }
    return paper;
}

Camera read_native(const YamlMap& file) {
    if (!file.has("format")) file.fail("format", "is missing: this is not a camera file");
    if (file.text("format") != kFormat) {
        file.fail("format", fmt::format("is '{}': this is not a camera file", file.text("format")));
    }
    if (file.integer("version") != kCameraFileVersion) {
        file.fail("version", fmt::format("is {}; this program reads version {}",
                                         file.integer("version"), kCameraFileVersion));
    }
    file.allow_only(
        {"format",      "version",   "width_px",     "height_px",          "k_per_px2",
         "centre_px",   "mm_per_px", "skew",         "perspective_per_px", "focal_px",
         "pinhole_px",  "tilt_rad",  "reference_px", "theta_offset_rad",   "tip_mm",
         "tip_rest_mm", "flip",      "flat_field",   "readout_ms",         "exposure_us",
         "gain",        "sigma"});
    Camera camera;
    camera.width_px = file.integer("width_px");
    camera.height_px = file.integer("height_px");
    camera.k_per_px2 = file.number("k_per_px2");
    camera.centre_px = point(file, "centre_px");
    if (file.has("mm_per_px")) camera.paper = read_paper(file);
    camera.focal_px = optional_number(file, "focal_px");
    if (file.has("pinhole_px")) {
        const auto numbers = file.numbers("pinhole_px", 4);
        camera.pinhole = Pinhole{numbers[0], numbers[1], {numbers[2], numbers[3]}};
    }
    if (file.has("tilt_rad")) {
        const PixelPoint tilt = point(file, "tilt_rad");
        camera.tilt = Tilt{tilt.u, tilt.v};
    }
    if (file.has("reference_px")) camera.reference_px = point(file, "reference_px");
    camera.theta_offset_rad = optional_number(file, "theta_offset_rad").value_or(0);
    if (file.has("tip_mm")) {
        const auto numbers = file.numbers("tip_mm", 3);
        camera.tip = PenTip{numbers[0], numbers[1], numbers[2],
                            optional_number(file, "tip_rest_mm").value_or(0)};
    } else if (file.has("tip_rest_mm")) {
        file.fail("tip_rest_mm", "needs tip_mm");
    }
    camera.flip = file.has("flip") && file.boolean("flip");
    if (file.has("flat_field")) camera.flat_field = file.rows_of_numbers("flat_field");
    camera.readout_ms = optional_number(file, "readout_ms");
    camera.exposure_us = optional_number(file, "exposure_us");
    camera.gain = optional_number(file, "gain");
    if (file.has("sigma")) {
        const YamlMap sigma = file.map("sigma");
        for (const std::string& key : sigma.keys())
            camera.sigma[key] = sigma.number(key);
    }
    return camera;
}

Camera camera_of(const YamlMap& file, const std::string& name) {
    const Camera camera =
        files::is_camera_info(file) ? files::camera_from_camera_info(file) : read_native(file);
    try {
        validate(camera);
    } catch (const BadArgument& error) {
        throw Error(fmt::format("{}: {}", name, error.what()));
    }
    return camera;
}

/// Formats a number with 10 significant digits. The rounding error is much smaller than the
/// standard deviation of any value in the file.
std::string text_of(double value) {
    return fmt::format("{:.10g}", value);
}

class Writer {
  public:
    void line(const std::string& key, const std::string& value, const char* comment = "") {
        text_ += fmt::format("{}: {}{}{}\n", key, value, *comment != '\0' ? "  # " : "", comment);
    }
    void line(const char* key, double value, const char* comment = "") {
        line(key, text_of(value), comment);
    }
    void line(const char* key, double first, double second, const char* comment = "") {
        line(key, fmt::format("[{}, {}]", text_of(first), text_of(second)), comment);
    }
    /// Appends an element to the list under the most recent key.
    void item(const std::vector<double>& numbers) {
        text_ += fmt::format("  - [{:.4g}]\n", fmt::join(numbers, ", "));
    }
    const std::string& text() const { return text_; }

  private:
    std::string text_;
};

std::string yaml_of(const Camera& camera) {
    Writer out;
    out.line("format", kFormat);
    out.line("version", kCameraFileVersion);
    out.line("width_px", camera.width_px);
    out.line("height_px", camera.height_px);
    out.line("k_per_px2", camera.k_per_px2, "p = centre + r / (1 + k |r|^2)");
    out.line("centre_px", camera.centre_px.u, camera.centre_px.v, "of the distortion");
    if (const auto& paper = camera.paper) {
        out.line("mm_per_px", paper->mm_per_px_x, paper->mm_per_px_y,
                 "on the paper, at the centre");
        out.line("skew", paper->skew);
        out.line("perspective_per_px", paper->perspective_u, paper->perspective_v);
    }
    if (camera.focal_px) out.line("focal_px", *camera.focal_px);
    if (const auto& pinhole = camera.pinhole) {
        out.line("pinhole_px",
                 fmt::format("[{}, {}, {}, {}]", text_of(pinhole->focal_u_px),
                             text_of(pinhole->focal_v_px), text_of(pinhole->centre_px.u),
                             text_of(pinhole->centre_px.v)),
                 "focal lengths and optical axis, undistorted");
    }
    if (camera.tilt) out.line("tilt_rad", camera.tilt->x_rad, camera.tilt->y_rad);
    if (camera.reference_px) {
        out.line("reference_px", camera.reference_px->u, camera.reference_px->v,
                 "the point whose pose is wanted, undistorted");
    }
    if (camera.theta_offset_rad != 0) {
        out.line("theta_offset_rad", camera.theta_offset_rad, "heading minus image x axis");
    }
    if (const auto& tip = camera.tip) {
        out.line(
            "tip_mm",
            fmt::format("[{}, {}, {}]", text_of(tip->x_mm), text_of(tip->y_mm), text_of(tip->z_mm)),
            "tip of the pen: x right and y down in the image, z forward");
        out.line("tip_rest_mm", tip->rest_mm, "measured height of the tip on the paper");
    }
    if (camera.flip) out.line("flip", "true", "frames are mirrored: flip them left to right");
    if (!camera.flat_field.empty()) {
        out.line("flat_field", "", "brightness of the paper, relative to the brightest point");
        for (const std::vector<double>& row : camera.flat_field)
            out.item(row);
    }
    if (camera.readout_ms) {
        out.line("readout_ms", *camera.readout_ms,
                 "rolling shutter: from the first to the last row");
    }
    if (camera.exposure_us) out.line("exposure_us", *camera.exposure_us);
    if (camera.gain) out.line("gain", *camera.gain);
    if (!camera.sigma.empty()) out.line("sigma", "", "standard deviations");
    for (const auto& [key, value] : camera.sigma)
        out.line("  " + key, fmt::format("{:.3g}", value));
    return out.text();
}

}  // namespace

Camera read_camera(const std::filesystem::path& path) {
    return camera_of(YamlMap(path), path.string());
}

Camera parse_camera(const std::string& text, const std::string& name) {
    return camera_of(YamlMap(text, name), name);
}

bool is_camera_info(const std::filesystem::path& path) {
    return files::is_camera_info(YamlMap(path));
}

void write_camera(const std::filesystem::path& path, const Camera& camera) {
    validate(camera);
    write_file(path, yaml_of(camera));
}

}  // namespace dotpose
