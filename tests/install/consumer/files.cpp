#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include <dotpose/files/camera_file.hpp>
#include <dotpose/files/sheet_place.hpp>

namespace {

using namespace dotpose;

/// Computes the position of a fix on a sheet and in the world.
bool place(const std::filesystem::path& folder) {
    std::ofstream(folder / "sheets.json")
        << R"({"format": "dotpose-sheets", "version": 1, "sheets": [{"name": "table", "page": 1,
            "code": "anoto", "columns": 400, "rows": 300, "section_u": 1, "section_v": 2,
            "origin_x": 1000, "origin_y": 2000, "first_x_mm": 5, "first_y_mm": 5,
            "spacing_mm": 0.5, "dot_mm": 0.08, "displacement_mm": 0.08,
            "width_mm": 210, "height_mm": 160, "print_scale_x": 1, "print_scale_y": 1,
            "world": {"x_m": 1, "y_m": 2, "yaw_rad": 0}}]})";
    const std::vector<SheetEntry> sheets = read_sheets(folder / "sheets.json");
    Fix fix;
    fix.status = Status::ok;
    fix.section = {1, 2};
    fix.cell = {1100, 2100};
    fix.covariance[0][0] = fix.covariance[1][1] = 1e-6F;
    const auto place = find_sheet(sheets, CodeVariant::anoto, fix);
    const auto world = place ? world_place(*place) : std::nullopt;
    if (!world) return false;
    std::printf("%.3f mm, %.3f mm; %.4f m, %.4f m\n", place->x_mm, place->y_mm, world->x_m,
                world->y_m);
    return std::abs(place->x_mm - 55) < 1e-6 && std::abs(world->x_m - 1.055) < 1e-9 &&
           place->covariance[0][0] > 0 && world->covariance[1][1] > 0;
}

bool keep_camera(const std::filesystem::path& folder) {
    Camera camera;
    camera.width_px = 188;
    camera.height_px = 120;
    camera.centre_px = {93.5, 59.5};
    write_camera(folder / "camera.yaml", camera);
    return read_camera(folder / "camera.yaml").width_px == camera.width_px;
}

}  // namespace

// Uses only the `files` component, so it must link without the libraries for printing and
// calibration.
int main() {
    const std::filesystem::path folder = "consumer-out";
    std::filesystem::create_directories(folder);
    return place(folder) && keep_camera(folder) ? 0 : 1;
}
