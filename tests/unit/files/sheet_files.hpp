/// Sheets and sheet files used by several tests.
#pragma once

#include <nlohmann/json.hpp>

#include "dotpose/files/sheet_file.hpp"
#include "dotpose/tools/print.hpp"

namespace dotpose::print_test {

inline Sheet page(double width_mm = 30, double height_mm = 20) {
    SheetOptions options;
    options.paper = {.width_mm = width_mm, .height_mm = height_mm};
    return make_sheet(options);
}

/// Returns a sheet file as a user might write it.
inline nlohmann::json hand_written() {
    return nlohmann::json::parse(R"({
        "format": "dotpose-sheets", "version": 1,
        "sheets": [{
            "name": "table", "page": 2, "code": "microdots", "section_u": 5, "section_v": 62,
            "origin_x": 1000, "origin_y": 410000000, "columns": 20, "rows": 10,
            "spacing_mm": 0.6, "displacement_mm": 0.1, "dot_mm": 0.12,
            "width_mm": 40, "height_mm": 30, "first_x_mm": 7.5, "first_y_mm": 8.25,
            "print_scale_x": 1.01, "print_scale_y": 0.99,
            "world": {"x_m": -1.5, "y_m": 2, "yaw_rad": 3}
        }]
    })");
}

}  // namespace dotpose::print_test
