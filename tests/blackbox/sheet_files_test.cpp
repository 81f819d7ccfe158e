// Tests poses on the page and in the world: prints pages with `dotpose print` and a sheet file,
// renders frames of the pages, and locates the frames with `dotpose locate`.
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "csv_columns.hpp"
#include "dotpose/tools/image_file.hpp"
#include "sheets_command.hpp"

namespace dotpose::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kPi = std::numbers::pi;

// Position tolerance. It is smaller than half a camera pixel (0.023 mm), and much larger than the
// error of a nominal frame, which is 0.001 mm (a jitter of 0.010 mm, averaged over about 170 dots).
constexpr double kTolerance_mm = 0.02;

using SheetFiles = SheetsCommand;

TEST_F(SheetFiles, tell_sheet_place_and_world_pose) {
    ASSERT_EQ(print("-o table.svg --paper 80x60 --sheets sheets.json --name table"), 0) << errors_;
    ASSERT_EQ(print("-o desk.svg --paper 60x90 --sheets sheets.json --name 'the desk'"), 0);
    constexpr double kYaw_rad = 2.3;
    edit_sheet(1, [&](json& desk) {
        desk["world"] = {{"x_m", 1.25}, {"y_m", -0.5}, {"yaw_rad", kYaw_rad}};
    });
    std::mt19937 random(11);
    std::printf("seed 11\n");
    const auto uniform = [&random](double low, double high) {
        return std::uniform_real_distribution(low, high)(random);
    };
    const json file = sheets();
    for (std::uint64_t i = 0; i < 16; ++i) {
        const json& sheet = file.at(i % 2);
        const double x_mm = uniform(9, sheet["width_mm"].get<double>() - 9);
        const double y_mm = uniform(9, sheet["height_mm"].get<double>() - 9);
        const double theta_rad = uniform(-kPi, kPi);
        const json record = locate_with_sheets(frame_of(sheet, x_mm, y_mm, theta_rad, i));
        ASSERT_EQ(record["status"], "ok") << record;
        EXPECT_EQ(record["sheet"], sheet["name"]);
        EXPECT_NEAR(record["x_sheet_mm"], x_mm, kTolerance_mm);
        EXPECT_NEAR(record["y_sheet_mm"], y_mm, kTolerance_mm);
        EXPECT_EQ(record.contains("x_m"), i % 2 == 1);
        EXPECT_EQ(record.contains("yaw_rad"), i % 2 == 1);
        if (i % 2 == 0) continue;
        // The y axis of the page points down, and the y axis of the world points up. As complex
        // numbers, the position in the world is therefore the conjugate of the position on the
        // page, rotated and translated.
        const std::complex<double> turn = std::polar(1.0, kYaw_rad);
        const std::complex<double> at =
            std::complex(1.25, -0.5) + turn * std::conj(std::complex(x_mm, y_mm)) / 1000.0;
        EXPECT_NEAR(record["x_m"], at.real(), kTolerance_mm / 1000);
        EXPECT_NEAR(record["y_m"], at.imag(), kTolerance_mm / 1000);
        const double yaw_rad = std::arg(turn * std::polar(1.0, -theta_rad));
        EXPECT_NEAR(std::remainder(record["yaw_rad"].get<double>() - yaw_rad, 2 * kPi), 0, 0.005);
    }
}

TEST_F(SheetFiles, a_place_on_no_sheet_is_a_warning) {
    ASSERT_EQ(print("-o table.svg --paper 80x60 --sheets sheets.json --name table"), 0) << errors_;
    json sheet = sheets().at(0);
    EXPECT_FALSE(locate_with_sheets(frame_of(sheet, 40, 30, 0, 1)).contains("warning"));
    sheet["origin_x"] = sheet["origin_x"].get<int>() + 5000;
    const json record = locate_with_sheets(frame_of(sheet, 40, 30, 0, 1));
    EXPECT_EQ(record["status"], "ok");
    EXPECT_TRUE(record.at("sheet").is_null());
    EXPECT_THAT(record["warning"], HasSubstr("this place is on no sheet of the sheet file"));
}

TEST_F(SheetFiles, only_sheets_excludes_others_and_reads_small_views) {
    ASSERT_EQ(print("-o table.svg --paper 80x60 --sheets sheets.json --name table"), 0) << errors_;
    json sheet = sheets().at(0);
    const GreyImage frame = frame_of(sheet, 40, 30, 0.3, 1);
    // Cuts a region 6.5 cells wide out of the middle of the frame. This is enough to determine a
    // position only if the sheets are known.
    constexpr int kSide_px = 72;
    const ImageView whole = frame.view();
    const std::uint8_t* first =
        whole.row((whole.height_px - kSide_px) / 2) + (whole.width_px - kSide_px) / 2;
    write_pgm(directory_ / "small.pgm", {first, kSide_px, kSide_px, whole.stride_bytes});
    run("small.pgm");
    EXPECT_NE(records().at(0)["status"], "ok");
    run("--sheets sheets.json --only-sheets small.pgm");
    EXPECT_EQ(records().at(0)["status"], "ok") << records().at(0);
    EXPECT_EQ(records().at(0)["sheet"], "table");
    EXPECT_EQ(records().at(0)["prior"], "only_sheets");

    sheet["origin_x"] = sheet["origin_x"].get<int>() + 5000;
    write_pgm(directory_ / "other.pgm", frame_of(sheet, 40, 30, 0, 1).view());
    run("--sheets sheets.json --only-sheets other.pgm");
    EXPECT_NE(records().at(0)["status"], "ok") << records().at(0);
}

/// Returns the image seen by a camera above the printed page. Each camera pixel is the mean of 2 x
/// 2 printer pixels. The image centre is at the upper left corner of printer pixel (u, v). Outside
/// the page, everything is white.
GreyImage cut_out(const GreyImage& page, int u, int v, int width_px = 188, int height_px = 120) {
    const auto level_at = [&page](int column, int row) {
        const bool is_inside =
            column >= 0 && column < page.width_px && row >= 0 && row < page.height_px;
        return is_inside ? page.pixels[static_cast<std::size_t>(row * page.width_px + column)]
                         : 255;
    };
    GreyImage frame{{}, width_px, height_px};
    for (int row = 0; row < height_px; ++row) {
        for (int column = 0; column < width_px; ++column) {
            const int left = u + 2 * column - width_px;
            const int top = v + 2 * row - height_px;
            const int sum = level_at(left, top) + level_at(left + 1, top) +
                            level_at(left, top + 1) + level_at(left + 1, top + 1);
            frame.pixels.push_back(static_cast<std::uint8_t>(40 + sum / 8));
        }
    }
    return frame;
}

TEST_F(SheetFiles, agree_with_a_ruler_on_the_printed_page) {
    ASSERT_EQ(print("-o other.svg --paper 40x40 --sheets sheets.json --name other"), 0);
    ASSERT_EQ(print("-o page.png --dpi 1200 --paper 50x40 --sheets sheets.json --name page"), 0);
    const GreyImage page = read_image((directory_ / "page.png").string());
    // The last two positions are in the margins: one to the left of the first column of dots, and
    // one above the first row.
    for (const auto& [u, v] :
         {std::pair(500, 500), {1111, 700}, {1800, 1333}, {200, 900}, {1200, 190}}) {
        const json record = locate_with_sheets(cut_out(page, u, v, 280, 260));
        ASSERT_EQ(record["status"], "ok") << record;
        EXPECT_EQ(record["sheet"], "page");
        EXPECT_NEAR(record["x_sheet_mm"], u * 25.4 / 1200, kTolerance_mm);
        EXPECT_NEAR(record["y_sheet_mm"], v * 25.4 / 1200, kTolerance_mm);
    }
}

/// Returns the column with the most dark pixels in the rectangle [u_begin, u_end) x [v_begin,
/// v_end).
int darkest_column(const GreyImage& page, int u_begin, int u_end, int v_begin, int v_end) {
    int best = u_begin;
    int most = 0;
    for (int u = u_begin; u < u_end; ++u) {
        int dark = 0;
        for (int v = v_begin; v < v_end; ++v)
            dark += page.pixels[static_cast<std::size_t>(v * page.width_px + u)] < 128;
        if (dark > most) best = u;
        most = std::max(most, dark);
    }
    return best;
}

TEST_F(SheetFiles, a_frame_under_the_ruler_s_50_mm_lies_at_50_mm) {
    constexpr double kPxPerMm = 1200 / 25.4;
    ASSERT_EQ(print("-o page.pdf --paper 80x60 --margin 10 --sheets sheets.json --name page"), 0);
    ASSERT_EQ(shell("pdftoppm -r 1200 -gray -singlefile page.pdf page && "
                    "pdftotext -bbox page.pdf - | grep '>50</word>'"),
              0)
        << errors_;
    double left_pt = 0;
    double top_pt = 0;
    double right_pt = 0;
    double bottom_pt = 0;
    ASSERT_EQ(
        std::sscanf(output_.c_str(), " <word xMin=\"%lf\" yMin=\"%lf\" xMax=\"%lf\" yMax=\"%lf",
                    &left_pt, &top_pt, &right_pt, &bottom_pt),
        4)
        << output_;
    const GreyImage page = read_image((directory_ / "page.pgm").string());
    const auto px = [](double pt) { return static_cast<int>(pt * 1200 / 72); };
    // The tick is between the number and the dots. It is 1.8 mm long.
    const int v = px(bottom_pt);
    const int u =
        darkest_column(page, px(left_pt), px(right_pt), v, v + static_cast<int>(1.8 * kPxPerMm));
    const json record =
        locate_with_sheets(cut_out(page, u, static_cast<int>(30 * kPxPerMm), 280, 260));
    ASSERT_EQ(record["status"], "ok") << record;
    // The tick is 0.1 mm wide, so the darkest column is within 0.05 mm of its middle.
    EXPECT_NEAR(record["x_sheet_mm"], 50, 0.05 + kTolerance_mm);
    EXPECT_NEAR(record["y_sheet_mm"], 30, kTolerance_mm + 0.03);
}

TEST_F(SheetFiles, may_mix_codes_and_spacings) {
    ASSERT_EQ(print("-o a.svg --paper 40x40 --sheets sheets.json --name a"), 0);
    ASSERT_EQ(print("-o b.svg --paper 40x40 --sheets sheets.json --name b --code microdots "
                    "--spacing 0.6 --section 9,61"),
              0);
    ASSERT_EQ(print("-o c.svg --paper 40x40 --sheets sheets.json --name c --code libdots "
                    "--spacing 0.45"),
              0);
    const json file = sheets();
    for (std::size_t i = 0; i < file.size(); ++i) {
        for (const double x_mm : {12.0, 20.25, 27.5}) {
            const json record = locate_with_sheets(frame_of(file[i], x_mm, 18.5, 0.7, i));
            ASSERT_EQ(record["status"], "ok") << record;
            EXPECT_EQ(record["sheet"], file[i]["name"]);
            EXPECT_NEAR(record["x_sheet_mm"], x_mm, kTolerance_mm);
            EXPECT_NEAR(record["y_sheet_mm"], 18.5, kTolerance_mm);
            // Positions in pattern coordinates are converted to mm with the spacing of the sheet.
            EXPECT_NEAR(record["x_mm"],
                        record["x_grid"].get<double>() * file[i]["spacing_mm"].get<double>(), 1e-5);
        }
    }
    // Outside the sheets, the spacing is unknown, so the record contains no lengths in millimetres.
    run("frame.pgm --code libdots");
    json elsewhere = file[0];
    elsewhere["origin_x"] = 300'000'000;
    const json record = locate_with_sheets(frame_of(elsewhere, 20, 20, 0, 5));
    EXPECT_EQ(record["status"], "ok");
    EXPECT_NEAR(record["x_grid"], 300'000'000 + (20 - 5.207) / 0.508, 0.04);
    for (const char* field : {"x_sheet_mm", "x_m", "x_mm", "y_mm", "sigma_x_mm"})
        EXPECT_FALSE(record.contains(field)) << record;
}

TEST_F(SheetFiles, csv_has_the_same_columns_for_every_frame) {
    ASSERT_EQ(print("-o a.svg --paper 40x40 --sheets sheets.json --name 'a, b'"), 0);
    ASSERT_EQ(print("-o b.svg --paper 40x40 --sheets sheets.json --name b"), 0);
    edit_sheet(1, [](json& b) { b["world"] = {{"x_m", 0}, {"y_m", 0}, {"yaw_rad", 0}}; });
    const json file = sheets();
    write_pgm(directory_ / "a.pgm", frame_of(file[0], 20, 20, 0, 1).view());
    write_pgm(directory_ / "b.pgm", frame_of(file[1], 20, 20, 0, 2).view());
    write_frame("elsewhere.pgm", 0);
    write_level("flat.pgm", 64, 64);
    const std::string arguments = "--sheets sheets.json a.pgm b.pgm elsewhere.pgm flat.pgm";
    run(arguments);
    const std::vector<json> expected = records();
    ASSERT_EQ(expected.size(), 4U);
    EXPECT_EQ(expected[2]["status"], "ok");
    // All sheets have the same spacing, so the record of the frame that is not on a sheet also
    // contains lengths in mm.
    EXPECT_TRUE(expected[2].contains("x_mm"));
    run("--format csv " + arguments);
    EXPECT_EQ(lines_of(output_).front(),
              "file,status,message,p_wrong,sigma_x_mm,sigma_y_mm,sigma_theta_deg,warning,sheet,"
              "x_sheet_mm,y_sheet_mm,theta_sheet_deg,x_m,y_m,yaw_rad");
    run("--format text " + arguments);
    EXPECT_THAT(
        lines_of(output_).at(0),
        testing::MatchesRegex("a\\.pgm: sheet a, b, x (19|20)\\.[0-9]{4} ± 0\\.00[0-9]+ mm, "
                              "y (19|20)\\.[0-9]{4} ± 0\\.00[0-9]+ mm, angle .* deg"));
    EXPECT_THAT(lines_of(output_).at(1),
                testing::MatchesRegex("b\\.pgm: sheet b, .*; world x 0\\.0[0-9]{5} m, "
                                      "y -0\\.0[0-9]{5} m, yaw .* deg"));
    EXPECT_THAT(lines_of(output_).at(2),
                testing::StartsWith("elsewhere.pgm: on no sheet, pattern x "));
    run("--format csv --columns all " + arguments);
    const std::vector<std::string> lines = lines_of(output_);
    ASSERT_EQ(lines.size(), 5U);
    const std::vector<std::string> header = cells_of(lines[0]);
    std::vector<std::string> added(std::ranges::find(header, "sheet"), header.end());
    const std::size_t first = header.size() - added.size();
    std::erase_if(added, [](const std::string& name) { return name.starts_with("covariance"); });
    EXPECT_THAT(added, ElementsAre("sheet", "x_sheet_mm", "y_sheet_mm", "theta_sheet_deg", "x_m",
                                   "y_m", "yaw_rad"));
    for (std::size_t row = 0; row < 4; ++row) {
        const std::vector<std::string> cells = cells_of(lines[row + 1]);
        ASSERT_EQ(cells.size(), header.size());
        for (std::size_t i = first; i < header.size(); ++i) {
            const json value = value_in(expected[row], header[i]);
            if (value.is_null()) {
                EXPECT_EQ(cells[i], "") << row << header[i];
            } else if (value.is_string()) {
                EXPECT_EQ(cells[i], value.get<std::string>());
            } else {
                EXPECT_EQ(std::stod(cells[i]), value.get<double>());
            }
        }
    }
    EXPECT_EQ(expected[0]["sheet"], "a, b");
    EXPECT_EQ(expected[1]["sheet"], "b");
    EXPECT_TRUE(expected[1].contains("yaw_rad"));
    EXPECT_TRUE(expected[2].at("sheet").is_null());
    EXPECT_FALSE(expected[3].contains("sheet")) << expected[3];
}

TEST_F(SheetFiles, the_print_scale_is_applied) {
    ASSERT_EQ(print("-o a.svg --paper 60x60 --sheets sheets.json --name a"), 0);
    const GreyImage frame = frame_of(sheets()[0], 30, 40, 0, 3);
    edit_sheet(0, [](json& a) {
        a["print_scale_x"] = 0.98;
        a["print_scale_y"] = 1.01;
    });
    const json record = locate_with_sheets(frame);
    EXPECT_NEAR(record["x_sheet_mm"], 5.207 + (30 - 5.207) * 0.98, kTolerance_mm);
    EXPECT_NEAR(record["y_sheet_mm"], 5.207 + (40 - 5.207) * 1.01, kTolerance_mm);
}

TEST_F(SheetFiles, a_frame_of_two_sheets_is_never_on_the_wrong_one) {
    ASSERT_EQ(print("-o a.png --margin 0 --dpi 1200 --paper 30x30 --sheets sheets.json --name a"),
              0);
    // The margin of b is so wide that some frames centred on b show only dots of a.
    ASSERT_EQ(print("-o b.png --margin 9 --dpi 1200 --paper 50x30 --sheets sheets.json --name b"),
              0);
    const GreyImage a = read_image((directory_ / "a.png").string());
    const GreyImage b = read_image((directory_ / "b.png").string());
    // The sheets are side by side on the table, without a gap.
    GreyImage table{{}, a.width_px + b.width_px, a.height_px};
    for (int row = 0; row < a.height_px; ++row) {
        for (const GreyImage* page : {&a, &b}) {
            const auto first = page->pixels.begin() + row * page->width_px;
            table.pixels.insert(table.pixels.end(), first, first + page->width_px);
        }
    }
    int on_a = 0;
    int on_b = 0;
    for (int u = a.width_px - 300; u <= a.width_px + 900; u += 40) {
        const json record = locate_with_sheets(cut_out(table, u, 700, 280, 260));
        if (!record.contains("sheet") || record["sheet"].is_null()) continue;
        const bool is_b = record["sheet"] == "b";
        ++(is_b ? on_b : on_a);
        const double x_mm = (is_b ? u - a.width_px : u) * 25.4 / 1200;
        EXPECT_NEAR(record["x_sheet_mm"], x_mm, kTolerance_mm) << u;
    }
    // A frame extends 280 printer pixels to each side of its centre. The dots of b begin 430 pixels
    // from the edge between a and b. Frames centred on b up to 150 pixels from this edge therefore
    // show only dots of a.
    EXPECT_GE(on_a, 8);
    EXPECT_GE(on_b, 12);
}

TEST_F(SheetFiles, locate_refuses_wrong_usage_and_bad_files) {
    write_frame("a.pgm", 0);
    ASSERT_EQ(print("-o a.svg --paper 40x40 --sheets sheets.json --name a"), 0);
    for (const char* option : {"--spacing 0.508", "--code anoto"}) {
        run(std::string("--sheets sheets.json a.pgm ") + option);
        EXPECT_EQ(exit_code_, 2);
        EXPECT_THAT(errors_, HasSubstr("cannot be given together"));
        EXPECT_THAT(output_, IsEmpty());
    }
    edit_sheet(0, [](json& a) { a.erase("rows"); });
    write("empty.json", R"({"format": "dotpose-sheets", "version": 1, "sheets": []})");
    const struct {
        const char* file;
        const char* problem;
    } bad[] = {
        {"missing.json",
         "dotpose: cannot read missing.json: no such file; 'dotpose print --sheets missing.json "
         "--name NAME' prints a sheet and creates the file\n"},
        {"sheets.json", "dotpose: sheets.json: sheets[0].rows is missing\n"},
        {"empty.json", "dotpose: empty.json has no sheets\n"},
    };
    for (const auto& [file, problem] : bad) {
        run(std::string("a.pgm --sheets ") + file);
        EXPECT_EQ(exit_code_, 1) << file;
        EXPECT_EQ(errors_, problem);
        EXPECT_THAT(output_, IsEmpty()) << file;
    }
}

TEST_F(SheetFiles, labels_beside_the_dots_contradict_nothing_where_the_sheet_is_known) {
    ASSERT_EQ(print("-o a.svg --paper 40x40 --sheets sheets.json --name a"), 0) << errors_;
    const json sheet = sheets().at(0);
    const double spacing_mm = sheet["spacing_mm"];
    const double right_mm =
        sheet["first_x_mm"].get<double>() + (sheet["columns"].get<int>() - 0.5) * spacing_mm;
    // The last column of dots is 1.5 mm to the right of the image centre.
    GreyImage frame = frame_of(sheet, right_mm - 1.5, 20, 0, 5);
    const double px_per_mm = 1 / CameraModel{}.mm_per_px;
    const int first_u = static_cast<int>((frame.width_px - 1) / 2.0 + 1.5 * px_per_mm) + 3;
    std::mt19937 random(12);
    for (int n = 0; n < 40; ++n) {
        // Draws a blot of 2 x 2 pixels, similar to a small letter.
        const auto u = std::uniform_int_distribution(first_u, frame.width_px - 2)(random);
        const auto v = std::uniform_int_distribution(0, frame.height_px - 2)(random);
        for (const int at : {v * frame.width_px + u, (v + 1) * frame.width_px + u}) {
            frame.pixels[static_cast<std::size_t>(at)] = 40;
            frame.pixels[static_cast<std::size_t>(at) + 1] = 40;
        }
    }
    write_pgm(directory_ / "frame.pgm", frame.view());
    run("frame.pgm");
    ASSERT_EQ(records().at(0)["status"], "ok") << output_;
    ASSERT_GT(records().at(0)["bit_errors"], 0) << output_;
    const json record = locate_with_sheets(frame);
    EXPECT_EQ(record["bit_errors"], 0) << record;
    EXPECT_EQ(record["attempt"], "first");
    EXPECT_LE(record["dots_used"], record["dots_seen"]);
    EXPECT_NEAR(record["x_sheet_mm"], right_mm - 1.5, kTolerance_mm);
    EXPECT_NEAR(record["y_sheet_mm"], 20, kTolerance_mm);
}

TEST_F(SheetFiles, pictures_name_the_sheet) {
    ASSERT_EQ(print("-o a.svg --paper 40x40 --sheets sheets.json --name a"), 0);
    write_pgm(directory_ / "frame.pgm", frame_of(sheets().at(0), 20.25, 18.55, 0.7, 1).view());
    run("--sheets sheets.json --draw pictures frame.pgm");
    EXPECT_THAT(read_file(directory_ / "pictures/frame.svg"),
                testing::ContainsRegex(">20.2[0-9]+ mm</text>"));
    EXPECT_THAT(read_file(directory_ / "pictures/frame.svg"),
                testing::ContainsRegex(">on sheet a; in the pattern: x "));
}

TEST_F(SheetFiles, pictures_show_the_profile_that_was_found) {
    ASSERT_EQ(print("-o a.svg --paper 40x40 --sheets sheets.json --name a"), 0);
    ASSERT_EQ(print("-o b.svg --paper 40x40 --sheets sheets.json --name b --code microdots "
                    "--spacing 0.6"),
              0);
    // This position is not on any sheet, so the tool also tries the code of the second sheet. The
    // picture must still show the fix in the code of the first sheet.
    write_frame("elsewhere.pgm", 0);
    run("--sheets sheets.json --draw pictures elsewhere.pgm");
    EXPECT_EQ(records().at(0)["status"], "ok");
    const std::string picture = read_file(directory_ / "pictures/elsewhere.svg");
    EXPECT_THAT(picture, HasSubstr(" spacings"));
    EXPECT_THAT(picture, testing::Not(HasSubstr("no fix")));
    EXPECT_THAT(picture, testing::Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace dotpose::test
