// Requests from JavaScript to the tools. All members are doubles, in the order in which
// src/requests.ts writes them, so C++ and JavaScript agree on every offset. A double represents all
// integers up to 2^53 exactly.
#pragma once

namespace dotpose::wasm {

struct SheetRequest {
    double code;
    double section_u;
    double section_v;
    double spacing_mm;
    double displacement_mm;
    double dot_mm;
    double origin_x;  ///< cell of the first dot
    double origin_y;
    double paper_width_mm;
    double paper_height_mm;
    double margin_mm;
};

/// Layout of the dots on a sheet, as computed by `make_sheet`.
struct SheetLayout {
    double columns;
    double rows;
    double origin_x_mm;
    double origin_y_mm;
};

struct CameraRequest {
    double width_px;
    double height_px;
    double mm_per_px;
    double k;
    double working_distance_mm;
    double cell_x;
    double cell_y;
    double fraction_x;
    double fraction_y;
    double theta_rad;
    double tilt_x_rad;
    double tilt_y_rad;
};

struct ImperfectionsRequest {
    double paper_level;
    double ink_reflectance;
    double ink_variation;
    double palest_ink;
    double vignetting;
    double fall;
    double fall_direction_rad;
    double blur_sigma_px;
    double motion_x_px;
    double motion_y_px;
    double noise_sigma;
    double salt_and_pepper;
    double jitter_mm;
    double missing;
    double dirt_blobs;
    double graphics;
    double texture;
};

struct RenderRequest {
    SheetRequest sheet;
    double whole_plane;  ///< 1 for dots everywhere (an infinite sheet), 0 for a page on a table
    double page_seed;
    double table_reflectance;
    CameraRequest camera;
    ImperfectionsRequest imperfections;
    double seed;
};

static_assert(sizeof(RenderRequest) == 44 * sizeof(double));

}  // namespace dotpose::wasm
