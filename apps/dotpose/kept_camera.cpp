#include "kept_camera.hpp"

#include <filesystem>

#include <fmt/core.h>

#include "dotpose/files/camera_file.hpp"
#include "system/path.hpp"

namespace dotpose::cli {

std::optional<Camera> replaced_camera(const std::string& option, const std::string& path) {
    const std::filesystem::path file = system::path_of(path);
    std::error_code failed;
    if (!std::filesystem::is_regular_file(file, failed) ||
        std::filesystem::file_size(file, failed) == 0) {
        return std::nullopt;
    }
    try {
        return read_camera(file);
    } catch (const Error& error) {
        throw Error(fmt::format("{}; {} replaces only a camera file: name another file",
                                error.what(), option));
    }
}

void require_size(const Camera& file, const Camera& frames, const std::string& path) {
    if (file.width_px == frames.width_px && file.height_px == frames.height_px) return;
    throw Error(
        fmt::format("{} is for images of {} x {} px, and the frames have {} x {} px: its mount "
                    "cannot be kept; write another file with -o",
                    path, file.width_px, file.height_px, frames.width_px, frames.height_px));
}

void keep_mount(const Camera& from, Camera& to) {
    to.reference_px = reference_in(to, from);
    to.theta_offset_rad = from.theta_offset_rad;
    to.tip = from.tip;
    to.flat_field = from.flat_field;
    to.readout_ms = from.readout_ms;
    to.exposure_us = from.exposure_us;
    to.gain = from.gain;
    for (const char* key : {"reference_u_px", "reference_v_px", "theta_offset_rad", "tip_x_mm",
                            "tip_y_mm", "tip_z_mm", "tip_rest_mm", "readout_ms"}) {
        const auto sigma = from.sigma.find(key);
        if (sigma != from.sigma.end()) to.sigma[key] = sigma->second;
    }
}

}  // namespace dotpose::cli
