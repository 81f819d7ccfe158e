// Tests `check_print` on prints scanned by an independent renderer (tests/scanned_page.hpp).
#include "dotpose/tools/check_print.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../jpeg.hpp"
#include "../../scanned_page.hpp"
#include "../../temporary_directory.hpp"
#include "../../xml_check.hpp"
#include "dotpose/tools/draw.hpp"
#include "dotpose/tools/image_file.hpp"
#include "dotpose/tools/print.hpp"
#include "dotpose/tools/simulate.hpp"
#include "dotpose/tools/test_page.hpp"
#include "print_checks.hpp"

namespace dotpose::check_print_test {
namespace {

using test::scan_page;
using test::ScanSettings;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

GreyImage through_jpeg(const GreyImage& scan, int quality) {
    const test::TemporaryDirectory directory;
    const auto path = directory.path() / "scan.jpg";
    std::ofstream(path, std::ios::binary) << test::jpeg_of(scan, quality);
    return read_image(path);
}

std::vector<std::string> remarks(const PrintCheck& check) {
    std::vector<std::string> names;
    for (const Finding& finding : check.findings) {
        if (!finding.is_fault) names.emplace_back(name(finding.kind));
    }
    return names;
}

TEST(CheckPrint, finds_the_whole_region) {
    const Sheet sheet = small_sheet();
    const PrintCheck result = check(scan_page(sheet, {}), 600);
    ASSERT_EQ(result.fields.size(), 1U);
    EXPECT_EQ(result.fields[0].origin, sheet.origin);
    EXPECT_EQ(result.fields[0].columns, sheet.columns);
    EXPECT_EQ(result.fields[0].rows, sheet.rows);
    EXPECT_EQ(result.fields[0].cells, sheet.columns * sheet.rows);
    EXPECT_THAT(remarks(result), ElementsAre("good"));
}

TEST(CheckPrint, looks_through_jpeg) {
    const Sheet sheet = small_sheet();
    for (const int dpi : {300, 600}) {
        ScanSettings settings;
        settings.dpi = dpi;
        settings.scale_x = settings.scale_y = 0.97;
        const PrintCheck result = check(through_jpeg(scan_page(sheet, settings), 60), dpi);
        ASSERT_EQ(result.fields.size(), 1U);
        EXPECT_NEAR(result.fields[0].scale->scale_x, 0.97, kScaleTolerance);
        EXPECT_NEAR(result.fields[0].scale->scale_y, 0.97, kScaleTolerance);
        EXPECT_NEAR(result.fields[0].scale->rotation_rad, 0, kRotationTolerance_rad);
        EXPECT_THAT(faults(result), ElementsAre("scaled"));
        EXPECT_THAT(result.findings[0].text, HasSubstr("97.0 %: print at 100 %"));
    }
}

TEST(CheckPrint, says_when_a_scan_is_too_coarse) {
    const Sheet sheet = small_sheet();
    ScanSettings settings;
    settings.dpi = 300;
    EXPECT_THAT(faults(check(through_jpeg(scan_page(sheet, settings), 15), 300)),
                ElementsAre("too_coarse"));
    settings.dpi = 75;
    const PrintCheck nothing = check(scan_page(sheet, settings), 75);
    EXPECT_THAT(nothing.fields, IsEmpty());
    EXPECT_THAT(faults(nothing), ElementsAre("too_coarse"));
}

TEST(CheckPrint, finds_dots_that_run_together) {
    // The dots have a diameter of 0.31 mm. If two neighbours are displaced towards each other,
    // their centres are 0.339 mm apart, which leaves a gap of 0.03 mm. The gap is smaller than a
    // pixel of the scan (0.042 mm), so the two dots appear as a single dot.
    ScanSettings settings;
    settings.dot_growth = 3.7;
    const PrintCheck result = check(scan_page(small_sheet(), settings), 600);
    ASSERT_EQ(result.fields.size(), 1U);
    EXPECT_GT(result.fields[0].merged_fraction(), 0.03);
    EXPECT_THAT(faults(result), ElementsAre("swollen"));
    EXPECT_THAT(result.findings[0].text, HasSubstr("run together"));
}

TEST(CheckPrint, tells_other_print_from_faults) {
    // Draws a grey area and a series of bars. The bars are 1 mm wide, repeat every 5 mm, and are
    // about as black as the dots.
    const Sheet sheet = small_sheet();
    ScanSettings settings;
    GreyImage scan = scan_page(sheet, settings);
    const double px_per_mm = settings.dpi / 25.4;
    for (int v = 0; v < scan.height_px; ++v) {
        for (int u = 0; u < scan.width_px; ++u) {
            auto& pixel = scan.pixels[static_cast<std::size_t>(v * scan.width_px + u)];
            const double x_mm = u / px_per_mm;
            const double y_mm = v / px_per_mm;
            if (x_mm > 10 && x_mm < 40 && std::fmod(y_mm, 5) < 1)
                pixel = std::min<std::uint8_t>(pixel, 40);
            if (x_mm > 45 && y_mm > 30 && y_mm < 60) pixel = static_cast<std::uint8_t>(pixel * 0.6);
        }
    }
    const PrintCheck result = check(scan, settings.dpi);
    ASSERT_EQ(result.fields.size(), 1U);
    const PrintField& field = result.fields[0];
    EXPECT_THAT(faults(result), IsEmpty());
    EXPECT_THAT(remarks(result), Contains("covered"));
    EXPECT_LT(field.missing_fraction(), 0.002);
    EXPECT_LT(field.merged_fraction(), 0.002);
    EXPECT_LT(field.wrong_fraction(), 0.002);
    // A bar covers all cells whose intersections are at most half a cell from the bar. These cells
    // form a stripe whose width is 1 mm plus one cell (0.508 mm). There is a bar every 5 mm, and
    // each bar is 30 mm long on a page of 60 mm. Along the edge of the grey area, a strip of up to
    // one tile (24 cells, or 12 mm) may also be reported as covered.
    const double bars = (1 + 0.508) / 5 * 30 / 60;
    const double edge = 12.0 * (25 + 30 + 25) / (60 * 80);
    EXPECT_GT(field.covered_fraction(), 0.9 * bars);
    EXPECT_LT(field.covered_fraction(), bars + edge);
}

// In this scan, most of each tile is blank paper, because the card is small.
TEST(CheckPrint, dots_of_a_small_card_on_a_noisy_scan_are_not_covered) {
    SheetOptions options;
    options.paper = {20, 20};
    options.margin_mm = 1;
    Sheet card = make_sheet(options);
    card.width_mm = card.height_mm = 60;
    card.origin_x_mm += 20;
    card.origin_y_mm += 20;
    ScanSettings settings;
    settings.noise_sigma = 15;
    const PrintCheck result = check(scan_page(card, settings), 600);
    ASSERT_EQ(result.fields.size(), 1U);
    EXPECT_EQ(result.fields[0].columns, card.columns);
    EXPECT_EQ(result.fields[0].rows, card.rows);
    EXPECT_LT(result.fields[0].covered_fraction(), 0.01);
    EXPECT_LT(result.fields[0].missing_fraction(), 0.01);
    EXPECT_THAT(faults(result), IsEmpty());
}

TEST(CheckPrint, maps_distortion) {
    SheetOptions options;
    options.paper = {120, 210};
    ScanSettings settings;
    settings.dpi = 300;
    settings.wave_mm = 0.3;
    const PrintCheck result = check(scan_page(make_sheet(options), settings), 300);
    ASSERT_EQ(result.fields.size(), 1U);
    // The tolerance is large because the fitted scale compensates for part of the sine wave.
    EXPECT_NEAR(result.fields[0].largest_distortion_mm, settings.wave_mm, 0.1);
    EXPECT_LT(result.fields[0].scatter_mm, 0.01);
    EXPECT_THAT(remarks(result), Contains("distorted"));
    const double height_mm = 210;
    for (const DistortionBin& bin : result.fields[0].distortion) {
        EXPECT_NEAR(bin.du_mm, 0, 0.005);
        const double along_mm = bin.v_px * 25.4 / settings.dpi - height_mm / 2;
        // The scale fit subtracts a straight line through the middle of the sheet.
        const double line_mm = (result.fields[0].scale->scale_y - 1) * along_mm;
        const double wave_mm = settings.wave_mm * std::sin(2 * std::numbers::pi * along_mm / 100);
        EXPECT_NEAR(bin.dv_mm, wave_mm - line_mm, 0.03);
    }
}

TEST(CheckPrint, bits_of_another_place_are_wrong) {
    // The lower 12 rows show another part of the pattern, as if a driver had printed the page in
    // tiles.
    Sheet upper = small_sheet();
    Sheet lower = upper;
    upper.rows -= 12;
    lower.origin = {1000, 2000};
    lower.origin_y_mm += upper.rows * upper.pattern.spacing_mm;
    lower.rows = 12;
    const Sheet both[] = {upper, lower};
    const PrintCheck result = check(scan_page(both, {}), 600);
    ASSERT_FALSE(result.fields.empty());
    EXPECT_EQ(result.fields[0].rows, upper.rows);
    EXPECT_EQ(result.fields[0].columns, upper.columns);
    EXPECT_EQ(result.fields[0].bits_wrong, 0);
}

TEST(CheckPrint, sees_a_photo_without_scale) {
    const Sheet sheet = small_sheet();
    CameraModel camera;
    camera.width_px = 1600;
    camera.height_px = 1200;
    camera.mm_per_px = 0.03;
    camera.working_distance_mm = 200;
    CameraPose pose;
    pose.cell = {sheet.origin.x + 60, sheet.origin.y + 80};
    pose.theta_rad = 0.3;
    pose.tilt_x_rad = 0.25;
    Imperfections imperfections;
    imperfections.blur_sigma_px = 0.8;
    imperfections.noise_sigma = 3;
    imperfections.missing = 0.03;
    const GreyImage photo = render(page_of(sheet), camera, pose, imperfections, 1);
    const PrintCheck result = check(photo, 72);  // many phones write 72 dpi into every file
    ASSERT_EQ(result.fields.size(), 1U);
    EXPECT_FALSE(result.fields[0].scale);
    EXPECT_FALSE(result.resolution);
    EXPECT_NEAR(result.fields[0].missing_fraction(), imperfections.missing, 0.006);
    EXPECT_LT(result.fields[0].residual_mm, 0.003);
    EXPECT_THAT(remarks(result), Contains("no_resolution"));
}

/// Returns a close-up photo of a flawless 110 x 90 mm print. The perspective is as strong as in a
/// phone photo of a whole page.
GreyImage phone_photo(double tilt_rad, double mm_per_px = 0.06, double missing = 0) {
    SheetOptions options;
    options.paper = {110, 90};
    const Sheet sheet = make_sheet(options);
    CameraModel camera;
    camera.width_px = 1600;
    camera.height_px = 1200;
    camera.mm_per_px = mm_per_px;
    camera.working_distance_mm = 100 * mm_per_px / 0.06;
    CameraPose pose;
    pose.cell = {sheet.origin.x + 95, sheet.origin.y + 75};
    pose.theta_rad = 0.1;
    pose.tilt_x_rad = 0.8 * tilt_rad;
    pose.tilt_y_rad = 0.6 * tilt_rad;
    Imperfections imperfections;
    imperfections.blur_sigma_px = 0.8;
    imperfections.noise_sigma = 3;
    imperfections.vignetting = 0.3;
    imperfections.fall = 0.3;
    imperfections.missing = missing;
    return through_jpeg(render(page_of(sheet), camera, pose, imperfections, 1), 85);
}

TEST(CheckPrint, photos_of_a_flawless_print_have_no_faults_and_no_scale) {
    for (const double tilt_degrees : {1.0, 10.0, 25.0}) {
        // The given resolution is correct in the middle of the view.
        const PrintCheck result = check(phone_photo(tilt_degrees * kDegree_rad), 25.4 / 0.06);
        ASSERT_EQ(result.fields.size(), 1U) << tilt_degrees;
        const PrintField& field = result.fields[0];
        EXPECT_TRUE(result.camera) << tilt_degrees;
        EXPECT_FALSE(result.resolution) << tilt_degrees;
        EXPECT_FALSE(field.scale) << tilt_degrees;
        EXPECT_THAT(faults(result), IsEmpty()) << tilt_degrees;
        EXPECT_THAT(remarks(result), ElementsAre("no_resolution", "unresolved", "good"))
            << tilt_degrees;
        EXPECT_LT(field.wrong_fraction(), 0.001) << tilt_degrees;
        EXPECT_LT(field.missing_fraction(), 0.001) << tilt_degrees;
        EXPECT_LT(field.covered_fraction(), 0.001) << tilt_degrees;
        EXPECT_LT(field.largest_distortion_mm, 0.02) << tilt_degrees;
    }
}

TEST(CheckPrint, photos_tell_missing_dots) {
    const PrintCheck result = check(phone_photo(10 * kDegree_rad, 0.04, 0.04), 72);
    ASSERT_EQ(result.fields.size(), 1U);
    EXPECT_TRUE(result.fields[0].are_dots_checked);
    EXPECT_FALSE(result.fields[0].are_sizes_measured);
    EXPECT_NEAR(result.fields[0].missing_fraction(), 0.04, 0.006);
    EXPECT_THAT(faults(result), ElementsAre("missing"));
}

TEST(CheckPrint, scan_without_a_pattern) {
    GreyImage blank{std::vector<std::uint8_t>(800 * 600, 230), 800, 600};
    EXPECT_THAT(check(blank, 300).fields, IsEmpty());
    EXPECT_THAT(check(blank, 300).findings, IsEmpty());
    Shot shot = draw_shot({}, 1);
    shot.camera.width_px = 800;
    shot.camera.height_px = 600;
    EXPECT_THAT(check(render_scene(Scene::text, shot), 300).fields, IsEmpty());
    EXPECT_THAT(check(render_scene(Scene::random_symbols, shot), 300).fields, IsEmpty());
}

TEST(CheckPrintAtLength, a_whole_page_at_600_dpi) {
    ScanSettings settings;
    settings.scale_x = 0.998;
    settings.scale_y = 1.0005;
    settings.rotation_rad = -1.5 * kDegree_rad;
    const Sheet sheet = make_sheet({});
    const PrintCheck result = check(scan_page(sheet, settings), 600);
    ASSERT_EQ(result.fields.size(), 1U);
    EXPECT_EQ(result.fields[0].columns, sheet.columns);
    EXPECT_EQ(result.fields[0].rows, sheet.rows);
    EXPECT_NEAR(result.fields[0].scale->scale_x, settings.scale_x, 0.00002);
    EXPECT_NEAR(result.fields[0].scale->scale_y, settings.scale_y, 0.00002);
    EXPECT_NEAR(result.fields[0].scale->rotation_rad, settings.rotation_rad, 0.002 * kDegree_rad);
    EXPECT_EQ(result.fields[0].missing, 0);
    EXPECT_THAT(faults(result), ElementsAre("uneven_scale"));
}

TEST(CheckPrint, test_page_tells_the_best_settings) {
    TestPageOptions options;
    options.paper = {110, 100};
    options.margin_mm = 5;
    options.spacings = {24, 36};
    options.dots = {2, 4, 6};
    const PrintPage page = make_test_page(options);
    ScanSettings settings;
    settings.dot_growth = 1.5;  // the printed dots are larger than nominal
    settings.rotation_rad = 0.3 * kDegree_rad;
    const PrintCheck result = check(scan_page(page.sheets, settings), 600);
    EXPECT_TRUE(result.is_test_page);
    ASSERT_EQ(result.fields.size(), page.sheets.size());
    for (const Sheet& sheet : page.sheets) {
        const auto field = std::ranges::find(result.fields, sheet.origin, &PrintField::origin);
        ASSERT_NE(field, result.fields.end());
        EXPECT_TRUE(field->is_patch);
        EXPECT_DOUBLE_EQ(field->pattern.spacing_mm, sheet.pattern.spacing_mm);
        EXPECT_DOUBLE_EQ(field->pattern.dot_mm, sheet.pattern.dot_mm);
        EXPECT_EQ(field->columns, sheet.columns);
        EXPECT_EQ(field->rows, sheet.rows);
        EXPECT_EQ(field->missing, 0);
        EXPECT_EQ(field->bits_wrong, 0);
        EXPECT_NEAR(field->gain(), 0.5, 0.1);
    }
    // The optimal printed diameter is a sixth of the spacing: 4 units for the first spacing, and 6
    // for the second. Dots are printed 1.5 times as large as nominal, so the best nominal diameters
    // are 2 units (printed as 3) and 4 units (printed as 6).
    ASSERT_EQ(result.best_per_spacing.size(), 2U);
    const auto dot_of = [&](std::size_t i) {
        return std::lround(result.fields[result.best_per_spacing[i]].pattern.dot_mm / kTestUnit_mm);
    };
    EXPECT_EQ(dot_of(0), 2);
    EXPECT_EQ(dot_of(1), 4);
    EXPECT_EQ(result.best, result.best_per_spacing[0]);
    EXPECT_THAT(remarks(result), Contains("best_settings"));
    EXPECT_EQ(result.unread_patches.size(), 20U - 6U);
}

TEST(CheckPrint, patches_whose_dots_reach_all_around_are_not_good) {
    // The dots have a diameter of 0.27 mm. At a spacing of 0.38 mm, the distance between the
    // centres of two neighbours may be as small as 0.25 mm, so their dots overlap.
    TestPageOptions options;
    options.paper = {60, 60};
    options.margin_mm = 5;
    options.spacings = {18};
    options.dots = {8};
    ScanSettings settings;
    settings.dot_growth = 1.6;
    const PrintCheck result = check(scan_page(make_test_page(options).sheets, settings), 600);
    ASSERT_EQ(result.fields.size(), 1U);
    EXPECT_THAT(result.best_per_spacing, IsEmpty());
}

TEST(CheckPrint, draws_the_distortion) {
    const GreyImage scan = scan_page(small_sheet(), {});
    const PrintCheck result = check(scan, 600);
    const test::TemporaryDirectory directory;
    const auto path = directory.path() / "distortion.svg";
    draw_distortion(path, scan.view(), result);
    std::ifstream stream(path);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_THAT(test::XmlCheck(text).problem(), IsEmpty());
    const auto count = [&](const std::string& part) {
        std::size_t n = 0;
        for (std::size_t at = text.find(part); at != std::string::npos;
             at = text.find(part, at + 1))
            ++n;
        return n;
    };
    EXPECT_EQ(count("<circle"), result.fields[0].distortion.size());
    EXPECT_THROW(draw_distortion("/nowhere/map.svg", scan.view(), result), Error);
}

TEST(CheckPrint, refuses_what_cannot_be) {
    const GreyImage blank{std::vector<std::uint8_t>(100 * 100, 230), 100, 100};
    CheckPrintOptions options;
    options.resolution = Resolution{0, 600};
    EXPECT_THROW(check_print(blank.view(), options), BadArgument);
    options = {};
    options.pattern.spacing_mm = -1;
    EXPECT_THROW(check_print(blank.view(), options), BadArgument);
    options = {};
    options.pattern.displacement_mm = 0.3;
    EXPECT_THROW(check_print(blank.view(), options), BadArgument);
    options = {};
    options.ink_reflectance = 1;
    EXPECT_THROW(check_print(blank.view(), options), BadArgument);
}

TEST(CheckPrint, can_be_stopped) {
    CheckPrintOptions options;
    int calls = 0;
    options.progress = [&](int done, int total) {
        EXPECT_LT(done, total);
        return ++calls < 3;
    };
    const GreyImage scan = scan_page(small_sheet(), {});
    EXPECT_THROW(check_print(scan.view(), options), Error);
    EXPECT_EQ(calls, 3);
}

}  // namespace
}  // namespace dotpose::check_print_test
