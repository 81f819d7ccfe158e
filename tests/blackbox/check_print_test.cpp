// Black-box tests of `dotpose print --test-page` and `dotpose check-print`.
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../exif.hpp"
#include "../jpeg.hpp"
#include "../scanned_page.hpp"
#include "../tiff_pages.hpp"
#include "dotpose/files/sheet_file.hpp"
#include "dotpose/tools/flip.hpp"
#include "dotpose/tools/image_file.hpp"
#include "dotpose/tools/print.hpp"
#include "dotpose/tools/simulate.hpp"
#include "dotpose/tools/test_page.hpp"
#include "tool_command.hpp"

namespace dotpose {
namespace {

namespace fs = std::filesystem;

using nlohmann::json;
using test::ScanSettings;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

class CheckPrintCommand : public test::ToolCommand {
  protected:
    void write_jpeg(const char* name, const GreyImage& image, int dpi) const {
        std::ofstream(directory_ / name, std::ios::binary) << test::jpeg_of(image, 90, dpi);
    }
};

using CheckPrintCommandAtLength = CheckPrintCommand;

GreyImage scan_of_60_x_50_mm(const ScanSettings& settings) {
    SheetOptions options;
    options.paper = {60, 50};
    options.origin = {700, 800};
    return test::scan_page(make_sheet(options), settings);
}

TEST_F(CheckPrintCommand, tells_people_what_is_wrong_and_why) {
    ScanSettings settings;
    settings.dpi = 600;
    settings.scale_x = settings.scale_y = 0.97;
    settings.missing = 0.05;
    write_jpeg("scan.jpg", scan_of_60_x_50_mm(settings), 600);
    run("check-print scan.jpg --draw map.svg");
    EXPECT_EQ(exit_code_, 3) << errors_;
    EXPECT_THAT(errors_, IsEmpty());
    EXPECT_THAT(output_, StartsWith("scan.jpg: 1417 x 1181 px, 600 dpi\n"));
    EXPECT_THAT(output_, HasSubstr("cells 700,800 to "));
    EXPECT_THAT(output_, HasSubstr("scale       x 97.00"));
    EXPECT_THAT(output_, HasSubstr("FAULT: the driver scaled the page to 97.0 %: print at 100 %"));
    EXPECT_THAT(output_, HasSubstr("of the dots are missing"));
    EXPECT_THAT(file("map.svg"), StartsWith("<?xml"));
}

TEST_F(CheckPrintCommand, tells_machines_the_same) {
    ScanSettings settings;
    settings.dpi = 300;
    settings.rotation_rad = 0.02;
    write_png(directory_ / "scan.png", scan_of_60_x_50_mm(settings).view());
    run("check-print scan.png --dpi 300 --format json");
    EXPECT_EQ(exit_code_, 0) << errors_;
    const json report = json::parse(output_);
    EXPECT_EQ(report["status"], "ok");
    EXPECT_EQ(report["file"], "scan.png");
    EXPECT_EQ(report["test_page"], false);
    ASSERT_EQ(report["fields"].size(), 1U);
    const json field = report["fields"][0];
    EXPECT_NEAR(field["scale_x"].get<double>(), 1, 0.0002);
    EXPECT_NEAR(field["scale_y"].get<double>(), 1, 0.0002);
    EXPECT_NEAR(field["rotation_deg"].get<double>(), 0.02 * 57.29578, 0.02);
    EXPECT_EQ(field["origin"], json({700, 800}));
    EXPECT_EQ(field["missing"], 0);
    EXPECT_EQ(report["findings"].back()["kind"], "good");
}

TEST_F(CheckPrintCommand, fit_makes_the_millimetres_of_the_sheet_file_true) {
    ASSERT_EQ(run("print --paper 60x50 -o a.svg --sheets sheets.json --name a"), 0);
    ASSERT_EQ(run("print --paper 60x50 -o b.svg --sheets sheets.json --name b"), 0);
    const auto sheets = [&] { return read_sheets(directory_ / "sheets.json"); };
    ScanSettings settings;
    settings.dpi = 600;
    settings.scale_x = 0.97;
    settings.scale_y = 0.98;
    write_jpeg("scan.jpg", test::scan_page(sheets()[1].sheet, settings), 600);
    run("check-print scan.jpg --fit --sheets sheets.json");
    EXPECT_EQ(exit_code_, 0);
    EXPECT_THAT(errors_, StartsWith("sheet 'b' of sheets.json: print scale x 0.97"));
    EXPECT_THAT(errors_, HasSubstr("the place of its dots on the page is not fitted"));
    EXPECT_NEAR(sheets()[1].print_scale_x, 0.97, 2e-4);
    EXPECT_NEAR(sheets()[1].print_scale_y, 0.98, 2e-4);
    EXPECT_EQ(sheets()[0].print_scale_x, 1);

    // A scan of a sheet that is not in the sheet file must not change the file.
    const std::string before = file("sheets.json");
    write_jpeg("other.jpg", scan_of_60_x_50_mm(settings), 600);
    EXPECT_EQ(run("check-print other.jpg --fit --sheets sheets.json"), 1);
    EXPECT_THAT(errors_, HasSubstr("the scan shows none of its sheets"));
    EXPECT_EQ(file("sheets.json"), before);
    EXPECT_EQ(run("check-print other.jpg --fit"), 2);
}

TEST_F(CheckPrintCommand, fit_refuses_what_has_no_scale) {
    ASSERT_EQ(run("print --paper 60x50 -o a.svg --sheets sheets.json --name a"), 0);
    const std::string before = file("sheets.json");
    const Sheet sheet = read_sheets(directory_ / "sheets.json")[0].sheet;
    CameraModel camera;
    camera.width_px = 800;
    camera.height_px = 640;
    camera.mm_per_px = 0.06;
    camera.working_distance_mm = 60;
    CameraPose pose;
    pose.cell = {sheet.origin.x + 50, sheet.origin.y + 40};
    pose.tilt_x_rad = 0.1;
    write_jpeg("photo.jpg", render(page_of(sheet), camera, pose, {}, 1), 423);
    for (const char* dpi : {"", " --dpi 423"}) {
        run(std::string("check-print photo.jpg --fit --sheets sheets.json") + dpi);
        EXPECT_EQ(exit_code_, 1);
        EXPECT_THAT(errors_, StartsWith("dotpose: photo.jpg is a photo, which has no scale of its "
                                        "own: lengths change by "));
        EXPECT_EQ(file("sheets.json"), before);
    }
    run("check-print photo.jpg");
    EXPECT_EQ(exit_code_, 0) << output_;
    EXPECT_THAT(output_, HasSubstr("note:  scale was not checked, because this is a photo"));

    // scan.jpg specifies no resolution. screen.jpg specifies 72 dpi instead of 600 dpi, so the page
    // would be more than eight times its actual size.
    const GreyImage scan = test::scan_page(sheet, {});
    write_jpeg("scan.jpg", scan, 0);
    EXPECT_EQ(run("check-print scan.jpg --fit --sheets sheets.json"), 1);
    EXPECT_THAT(errors_, HasSubstr("scan.jpg states no plausible resolution"));
    write_jpeg("screen.jpg", scan, 72);
    EXPECT_EQ(run("check-print screen.jpg --fit --sheets sheets.json"), 1);
    EXPECT_THAT(errors_, HasSubstr("screen.jpg states no plausible resolution"));
    EXPECT_EQ(run("check-print scan.jpg --fit --sheets sheets.json --dpi 400"), 1);
    EXPECT_THAT(errors_, HasSubstr("scan.jpg: the page would be printed at 150 % of its size"));
    EXPECT_EQ(file("sheets.json"), before);
    EXPECT_EQ(run("check-print scan.jpg --fit --sheets sheets.json --dpi 600"), 0) << errors_;
}

// The photo was taken straight from above, so it looks like a scan, and the phone wrote an
// arbitrary resolution into the file. Only the EXIF data show that it is a photo.
TEST_F(CheckPrintCommand, tells_a_straight_photo_by_its_exif_data) {
    ASSERT_EQ(run("print --paper 60x50 -o a.svg --sheets sheets.json --name a"), 0);
    const std::string before = file("sheets.json");
    ScanSettings settings;
    settings.dpi = 330;
    const GreyImage image =
        test::scan_page(read_sheets(directory_ / "sheets.json")[0].sheet, settings);
    const std::string jpeg = test::jpeg_of(image, 90, 300);
    const auto write = [&](const char* name, const std::vector<std::uint16_t>& tags) {
        std::ofstream(directory_ / name, std::ios::binary)
            << test::with_exif(jpeg, test::exif_of(tags, true));
    };
    write("photo.jpg", {test::exposure_time, test::f_number, test::date_taken});
    EXPECT_EQ(run("check-print photo.jpg --fit --sheets sheets.json"), 1);
    EXPECT_THAT(errors_, StartsWith("dotpose: photo.jpg is a photo, which has no scale of its own: "
                                    "its EXIF data have a camera's exposure; nothing was written"));
    EXPECT_EQ(file("sheets.json"), before);
    EXPECT_EQ(run("check-print photo.jpg"), 0) << output_;
    EXPECT_THAT(output_, HasSubstr("note:  scale was not checked, because this is a photo, which "
                                   "has no scale of its own: its EXIF data"));
    EXPECT_THAT(output_, Not(HasSubstr("FAULT")));
    EXPECT_EQ(run("check-print photo.jpg --format json"), 0);
    EXPECT_EQ(json::parse(output_)["exif_of_camera"], true);

    // EXIF data written by a scanner contain no exposure, so the check uses the resolution given in
    // the file. The image was scanned at 330 dpi, but the file specifies 300 dpi, so the page seems
    // to be scaled to 110 %. For a photo, the scale is checked only if --dpi is given.
    write("scan.jpg", {test::date_taken, test::file_source});
    EXPECT_EQ(run("check-print scan.jpg"), 3);
    EXPECT_THAT(output_, HasSubstr("FAULT: the driver scaled the page to 110.0 %"));
    EXPECT_EQ(run("check-print photo.jpg --dpi 330"), 0) << output_;
    EXPECT_THAT(output_, HasSubstr("scale       x 100.0"));
}

TEST_F(CheckPrintCommand, judges_every_sheet_on_the_scan_by_what_the_sheet_file_says) {
    ASSERT_EQ(run("print --paper 50x50 -o a.svg --sheets sheets.json --name a --section 3,4"), 0);
    ASSERT_EQ(run("print --paper 50x50 -o b.svg --sheets sheets.json --name b --spacing 0.6"), 0);
    ASSERT_EQ(run("print --paper 50x50 -o c.svg --sheets sheets.json --name c"), 0);
    std::vector<Sheet> on_table;
    for (const SheetEntry& entry : read_sheets(directory_ / "sheets.json"))
        on_table.push_back(entry.sheet);
    on_table.pop_back();
    // The second sheet was printed at a scale of 96 %, with dots twice as wide.
    on_table[1].pattern.spacing_mm *= 0.96;
    on_table[1].pattern.displacement_mm *= 0.96;
    on_table[1].pattern.dot_mm *= 2;
    on_table[1].origin_x_mm += 52;
    for (Sheet& sheet : on_table)
        sheet.width_mm = 105;
    write_jpeg("scan.jpg", test::scan_page(on_table, {}), 600);

    run("check-print scan.jpg --sheets sheets.json");
    EXPECT_EQ(exit_code_, 3) << errors_;
    EXPECT_THAT(output_, HasSubstr("FAULT: sheet 'b': the driver scaled the page to 96.0 %"));
    EXPECT_THAT(output_, HasSubstr("FAULT: sheet 'b': dots are swollen"));
    EXPECT_THAT(output_, HasSubstr("note:  sheet 'a': the print can be used as it is"));
    EXPECT_THAT(output_, Not(HasSubstr("FAULT: sheet 'a'")));
    run("check-print scan.jpg --sheets sheets.json --format json --fit");
    const json report = json::parse(output_);
    ASSERT_EQ(report["fields"].size(), 2U);
    for (const json& finding : report["findings"]) {
        const bool is_about_b = report["fields"][finding["field"].get<int>()]["sheet"] == "b";
        EXPECT_EQ(finding["fault"], is_about_b) << finding;
    }
    const std::vector<SheetEntry> fitted = read_sheets(directory_ / "sheets.json");
    EXPECT_NEAR(fitted[0].print_scale_x, 1, 2e-4);
    EXPECT_NEAR(fitted[1].print_scale_y, 0.96, 2e-4);
    EXPECT_EQ(fitted[2].print_scale_x, 1);

    // Without the sheet file, the check expects the scan to show a single pattern.
    run("check-print scan.jpg");
    EXPECT_THAT(output_, HasSubstr("FAULT: from cell "));
}

TEST_F(CheckPrintCommand, without_a_resolution_nothing_is_said_of_scale) {
    write_pgm(directory_ / "scan.pgm", scan_of_60_x_50_mm({}).view());
    run("check-print scan.pgm");
    EXPECT_EQ(exit_code_, 0) << errors_;
    EXPECT_THAT(output_, Not(HasSubstr("scale   ")));
    EXPECT_THAT(output_, HasSubstr("note:  scale was not checked"));
}

TEST_F(CheckPrintCommand, a_scan_without_a_pattern_is_status_1) {
    const GreyImage blank{std::vector<std::uint8_t>(400 * 300, 230), 400, 300};
    write_pgm(directory_ / "blank.pgm", blank.view());
    run("check-print blank.pgm --draw map.svg");
    EXPECT_EQ(exit_code_, 1);
    EXPECT_EQ(output_, "blank.pgm: 400 x 300 px\nno pattern was found in this image\n");
    EXPECT_FALSE(fs::exists(directory_ / "map.svg"));
    run("check-print blank.pgm --format json");
    EXPECT_EQ(exit_code_, 1);
    EXPECT_EQ(json::parse(output_)["status"], "no_pattern");
}

TEST_F(CheckPrintCommand, a_resolution_that_cannot_be_true_is_refused) {
    ScanSettings settings;
    settings.dpi = 600;
    const GreyImage scan = scan_of_60_x_50_mm(settings);
    write_jpeg("scan.jpg", scan, 85);
    run("check-print scan.jpg");
    EXPECT_EQ(exit_code_, 3);
    EXPECT_THAT(output_,
                HasSubstr("FAULT: at 85 dpi the dots are 3.586 mm apart instead of 0.508"));
    EXPECT_THAT(output_, Not(HasSubstr("can be used")));
    EXPECT_EQ(run("check-print scan.jpg --dpi 600"), 0) << output_;
    EXPECT_EQ(run("check-print scan.jpg --dpi 85"), 3);
    EXPECT_EQ(run("check-print scan.jpg --dpi 85 --spacing 3.5857 --dot 0.6 --displacement 0.6"), 0)
        << output_;
}

TEST_F(CheckPrintCommand, counts_pages_and_checks_the_one_that_is_named) {
    ScanSettings settings;
    settings.dpi = 300;
    const GreyImage page = scan_of_60_x_50_mm(settings);
    const GreyImage blank{std::vector<std::uint8_t>(400 * 300, 230), 400, 300};
    std::ofstream(directory_ / "scan.tif", std::ios::binary)
        << test::tiff_of_pages({blank, page}, 300);
    run("check-print scan.tif");
    EXPECT_EQ(exit_code_, 1);
    EXPECT_THAT(output_, HasSubstr("page        1 of 2: --page N checks another one\n"));
    run("check-print scan.tif --page 2");
    EXPECT_EQ(exit_code_, 0) << output_;
    EXPECT_THAT(output_, HasSubstr("page        2 of 2"));
    EXPECT_THAT(output_, HasSubstr("cells 700,800 to "));
    run("check-print scan.tif --page 2 --format json");
    EXPECT_EQ(json::parse(output_)["pages"], 2);
    EXPECT_EQ(run("check-print scan.tif --page 3"), 1);
    EXPECT_THAT(errors_, HasSubstr("scan.tif: it has 2 pages, and no page 3"));
    run("locate scan.tif");
    EXPECT_THAT(errors_, HasSubstr("scan.tif has 2 pages, of which only the first is read"));
}

TEST_F(CheckPrintCommand, a_mirrored_page_is_told_and_checked_flipped) {
    ScanSettings settings;
    settings.dpi = 600;
    write_jpeg("scan.jpg", flipped(scan_of_60_x_50_mm(settings).view()), 600);
    run("check-print scan.jpg");
    EXPECT_EQ(exit_code_, 1);
    EXPECT_THAT(output_, HasSubstr("the pattern is mirrored: check it with --flip"));
    run("check-print scan.jpg --format json");
    EXPECT_EQ(json::parse(output_)["status"], "mirrored");
    EXPECT_EQ(run("check-print scan.jpg --flip"), 0) << output_;
    EXPECT_THAT(output_, HasSubstr("cells 700,800 to "));
}

TEST_F(CheckPrintCommand, recognises_the_test_page) {
    TestPageOptions options;
    options.paper = {100, 90};
    options.margin_mm = 5;
    options.spacings = {24};
    options.dots = {4, 6};
    const PrintPage page = make_test_page(options);
    write_jpeg("scan.jpg", test::scan_page(page.sheets, {}), 600);
    run("check-print scan.jpg");
    EXPECT_EQ(exit_code_, 0) << errors_;
    EXPECT_THAT(output_, HasSubstr("test page: 2 patches were read"));
    EXPECT_THAT(output_, HasSubstr("best for this printer: --spacing 0.5080 --dot 0.0847\n"));
    EXPECT_THAT(output_, HasSubstr("0.3810   0.0423 could not be read"));
    run("check-print scan.jpg --format json");
    const json report = json::parse(output_);
    EXPECT_EQ(report["test_page"], true);
    EXPECT_EQ(report["best"], json({{"spacing_mm", 0.508}, {"dot_mm", 0.084667}}));
    EXPECT_EQ(report["unread"].size(), 18U);
}

TEST_F(CheckPrintCommandAtLength, test_page_is_printed_in_every_format_but_text) {
    for (const char* name : {"test.svg", "test.pdf", "test.tif", "test.png"}) {
        run(std::string("print --test-page --paper A5 -o ") + name);
        EXPECT_EQ(exit_code_, 0) << errors_;
        EXPECT_THAT(output_, HasSubstr("test page 148 x 210 mm, 20 patches"));
        EXPECT_TRUE(fs::exists(directory_ / name));
    }
    // The PNG file and the rendered PDF file are perfect scans of the test page.
    ASSERT_EQ(
        shell("qpdf --check test.pdf && pdftoppm -gray -r 600 -png -singlefile test.pdf scan"), 0)
        << output_ << errors_;
    for (const char* scan : {"test.png", "scan.png"}) {
        run(std::string("check-print --dpi 600 ") + scan);
        EXPECT_EQ(exit_code_, 0) << errors_;
        EXPECT_THAT(output_, HasSubstr("test page: ")) << scan;
        EXPECT_THAT(output_, HasSubstr("best for this printer: ")) << scan;
    }
}

TEST_F(CheckPrintCommand, wrong_usage_is_status_2) {
    const GreyImage blank{std::vector<std::uint8_t>(100 * 100, 230), 100, 100};
    write_pgm(directory_ / "blank.pgm", blank.view());
    const char* const wrong[] = {
        "check-print",                               // no scan
        "check-print blank.pgm --dpi 0",             //
        "check-print blank.pgm --dpi x",             //
        "check-print blank.pgm --format csv",        //
        "check-print blank.pgm --draw map.jpg",      //
        "check-print blank.pgm --spacing 0",         //
        "check-print blank.pgm --displacement 0.4",  //
        "check-print blank.pgm --section 1,1",  // not an option, because the section is detected
        "check-print blank.pgm --sheets s --dot 0.1",   // the diameter is in the sheet file
        "check-print blank.pgm stray",                  //
        "print --test-page -o test.txt",                //
        "print --test-page -o test.png --spacing 0.5",  // a test page has several spacings
        "print --test-page -o test.png --origin 1,1",   //
        "print --test-page -o test.png --dpi 300",      // too coarse for a spacing of 0.381 mm
        "print --test-page -o test.png --paper 40x40",  // no room for dots
    };
    for (const char* arguments : wrong) {
        run(arguments);
        EXPECT_EQ(exit_code_, 2) << arguments;
        EXPECT_THAT(errors_, StartsWith("dotpose: ")) << arguments;
        EXPECT_THAT(output_, IsEmpty()) << arguments;
    }
    EXPECT_FALSE(fs::exists(directory_ / "test.png"));
}

TEST_F(CheckPrintCommand, a_file_that_cannot_be_read_is_status_1) {
    run("check-print missing.png");
    EXPECT_EQ(exit_code_, 1);
    EXPECT_EQ(errors_, "dotpose: cannot read missing.png: no such file\n");
}

TEST_F(CheckPrintCommand, help_shows_an_example) {
    run("check-print --help");
    EXPECT_EQ(exit_code_, 0);
    EXPECT_THAT(output_, HasSubstr("dotpose check-print scan.png"));
    for (const char* option :
         {"--dpi", "--spacing", "--dot", "--displacement", "--code", "--format", "--out"}) {
        EXPECT_THAT(output_, HasSubstr(option));
    }
}

}  // namespace
}  // namespace dotpose
