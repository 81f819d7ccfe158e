// Prints pages with a sheet file, and locates frames with the same file.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "locate_command.hpp"

namespace dotpose::test {

/// Returns a nominal frame centred on a position on the page, in mm from the page's upper left
/// corner. `sheet`, the page's entry in the sheet file, determines the cell at this position.
inline GreyImage frame_of(const json& sheet, double x_mm, double y_mm, double theta_rad,
                          std::uint64_t seed) {
    Setup setup;
    setup.seed = seed;
    setup.random_section = false;
    Shot shot = draw_shot(setup, 0);
    Pattern& pattern = shot.page.pattern;
    pattern.code = sheet["code"] == "microdots" ? CodeVariant::microdots
                   : sheet["code"] == "libdots" ? CodeVariant::libdots
                                                : CodeVariant::anoto;
    pattern.section = {sheet["section_u"], sheet["section_v"]};
    pattern.spacing_mm = sheet["spacing_mm"];
    pattern.displacement_mm = sheet["displacement_mm"];
    pattern.dot_mm = sheet["dot_mm"];
    shot.page.origin = {sheet["origin_x"], sheet["origin_y"]};
    shot.page.columns = sheet["columns"];
    shot.page.rows = sheet["rows"];
    const double x = (x_mm - sheet["first_x_mm"].get<double>()) / pattern.spacing_mm;
    const double y = (y_mm - sheet["first_y_mm"].get<double>()) / pattern.spacing_mm;
    shot.pose.cell = {shot.page.origin.x + static_cast<std::uint32_t>(std::floor(x)),
                      shot.page.origin.y + static_cast<std::uint32_t>(std::floor(y))};
    shot.pose.fraction_x = x - std::floor(x);
    shot.pose.fraction_y = y - std::floor(y);
    shot.pose.theta_rad = theta_rad;
    return render(shot);
}

class SheetsCommand : public LocateCommand {
  protected:
    int print(const std::string& arguments) { return ToolCommand::run("print " + arguments); }
    json sheets() const { return json::parse(read_file(directory_ / "sheets.json"))["sheets"]; }

    template <typename Edit>
    void edit_sheet(std::size_t index, const Edit& edit) const {
        json document = json::parse(read_file(directory_ / "sheets.json"));
        edit(document["sheets"].at(index));
        write("sheets.json", document.dump());
    }

    json locate_with_sheets(const GreyImage& image) {
        write_pgm(directory_ / "frame.pgm", image.view());
        run("--sheets sheets.json frame.pgm");
        EXPECT_EQ(exit_code_, 0) << errors_;
        return records().at(0);
    }
};

}  // namespace dotpose::test
