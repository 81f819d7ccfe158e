#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dotpose/tools/print.hpp"

namespace dotpose {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

void expect_refused(const SheetOptions& options, const char* part_of_message) {
    EXPECT_THAT([&] { (void)make_sheet(options); },
                ThrowsMessage<BadArgument>(HasSubstr(part_of_message)));
}

/// Returns the distances of the ink from two opposite edges of the page (left and right, or top and
/// bottom). Assumes that the outermost dots are displaced towards these edges.
std::pair<double, double> free_mm(double first_mm, int count, double size_mm,
                                  const Pattern& pattern) {
    const double ink_mm = pattern.displacement_mm + pattern.dot_mm / 2;
    const double last_mm = first_mm + (count - 1) * pattern.spacing_mm;
    return {first_mm - ink_mm, size_mm - last_mm - ink_mm};
}

TEST(make_sheet, fills_a4_inside_the_default_margin) {
    SheetOptions options;
    options.origin = {.x = 7, .y = 9};
    options.pattern.section = {.u = 3, .v = 62};
    options.pattern.code = CodeVariant::microdots;
    const Sheet sheet = make_sheet(options);
    // Computed by hand: a width of 200 mm has room for 1 + floor((200 - 0.254) / 0.508) = 394
    // columns, and a height of 287 mm has room for 565 rows.
    EXPECT_EQ(sheet.columns, 394);
    EXPECT_EQ(sheet.rows, 565);
    EXPECT_EQ(sheet.width_mm, 210);
    EXPECT_EQ(sheet.height_mm, 297);
    EXPECT_EQ(sheet.origin, (Cell{7, 9}));
    EXPECT_EQ(sheet.pattern.section, (Section{3, 62}));
    EXPECT_EQ(sheet.pattern.code, CodeVariant::microdots);
}

TEST(make_sheet, keeps_the_margin_and_wastes_less_than_a_cell) {
    for (const double margin_mm : {0.0, 0.1, 3.0, 5.0, 12.7}) {
        for (const double spacing_mm : {0.3, 0.5, 0.508, 1.0}) {
            SheetOptions options;
            options.margin_mm = margin_mm;
            options.pattern.spacing_mm = spacing_mm;
            options.pattern.displacement_mm = spacing_mm / 6;
            options.pattern.dot_mm = spacing_mm / 6;
            const Sheet sheet = make_sheet(options);
            const auto [left, right] =
                free_mm(sheet.origin_x_mm, sheet.columns, 210, options.pattern);
            const auto [top, bottom] = free_mm(sheet.origin_y_mm, sheet.rows, 297, options.pattern);
            for (const double free : {left, right, top, bottom}) {
                EXPECT_GE(free, margin_mm - 1e-6) << margin_mm << " " << spacing_mm;
            }
            // The first intersection is moved to the centre of a printer pixel, away from the edge,
            // so the first dot may be up to one pixel farther from the edge.
            EXPECT_LE(left, margin_mm + 25.4 / 300) << margin_mm << " " << spacing_mm;
            EXPECT_LE(top, margin_mm + 25.4 / 300) << margin_mm << " " << spacing_mm;
            EXPECT_LT(right, margin_mm + spacing_mm) << margin_mm << " " << spacing_mm;
            EXPECT_LT(bottom, margin_mm + spacing_mm) << margin_mm << " " << spacing_mm;
            EXPECT_NO_THROW(validate(sheet));
        }
    }
}

TEST(make_sheet, starts_at_the_centre_of_a_printer_pixel) {
    const Sheet sheet = make_sheet({});
    const double pixels = sheet.origin_x_mm * 300 / 25.4 - 0.5;
    EXPECT_NEAR(pixels, std::round(pixels), 1e-9);
    EXPECT_EQ(sheet.origin_x_mm, sheet.origin_y_mm);
}

TEST(make_sheet, refuses_bad_lengths) {
    for (const double bad : {0.0, -1.0, kNaN, kInfinity}) {
        SheetOptions spacing;
        spacing.pattern.spacing_mm = bad;
        expect_refused(spacing, "the spacing must be more than 0 mm");
        SheetOptions displacement;
        displacement.pattern.displacement_mm = bad;
        expect_refused(displacement, "the displacement must be more than 0 mm");
        SheetOptions dot;
        dot.pattern.dot_mm = bad;
        expect_refused(dot, "the dot diameter must be more than 0 mm");
        SheetOptions page;
        page.paper.height_mm = bad;
        expect_refused(page, "each side must be over 0 and at most 100000 mm");
    }
}

TEST(make_sheet, refuses_a_spacing_too_small_for_the_displacement) {
    SheetOptions options;
    options.pattern.spacing_mm = 0.3;
    options.pattern.displacement_mm = 0.15;
    expect_refused(options, "a spacing of 0.3 mm is too small for a displacement of 0.15 mm");
}

TEST(make_sheet, refuses_dots_that_touch) {
    SheetOptions options;
    options.pattern.dot_mm = 0.3387;  // 0.508 - 2 * 0.508 / 6 is 0.33867
    expect_refused(options, "would touch their neighbours");
    options.pattern.dot_mm = 0.3386;
    EXPECT_NO_THROW((void)make_sheet(options));
}

TEST(make_sheet, refuses_bad_margins) {
    SheetOptions options;
    for (const double margin_mm : {-0.1, kNaN, kInfinity}) {
        options.margin_mm = margin_mm;
        expect_refused(options, "the margin must be 0 mm or more");
    }
    options.margin_mm = 105;
    expect_refused(options, "a margin of 105 mm leaves nothing of a page of 210 x 297 mm");
    options.margin_mm = 104;
    expect_refused(options, "only 4 columns of dots fit");
    options.margin_mm = 5;
    options.paper = {.width_mm = 100, .height_mm = 12};
    expect_refused(options, "only 4 rows of dots fit");
}

TEST(make_sheet, refuses_regions_past_the_end_of_the_code_plane) {
    SheetOptions options;
    options.origin = {.x = kPositionsPerAxis - 394, .y = kPositionsPerAxis - 565};
    EXPECT_NO_THROW((void)make_sheet(options));
    ++options.origin.x;
    expect_refused(options, "394 columns from x = 410814955 run past the end of the code plane");
    --options.origin.x;
    ++options.origin.y;
    expect_refused(options, "565 rows from y = 410814784 run past the end of the code plane");
    options.origin = {.x = kPositionsPerAxis, .y = 0};
    expect_refused(options, "run past the end of the code plane");
    options.origin = {.x = 0xffffffff, .y = 0};
    expect_refused(options, "run past the end of the code plane");
}

TEST(make_sheet, refuses_sections_that_do_not_exist) {
    SheetOptions options;
    options.pattern.section = {.u = 63, .v = 0};
    expect_refused(options, "section 63,0: both numbers must be 0 to 62");
    options.pattern.section = {.u = 0, .v = 255};
    expect_refused(options, "section 0,255");
}

TEST(validate, refuses_ink_off_the_page) {
    const Sheet good = make_sheet({});
    EXPECT_NO_THROW(validate(good));
    Sheet left = good;
    left.origin_x_mm = 0.1;  // ink extends 0.127 mm from an intersection
    Sheet right = good;
    right.columns += 12;
    Sheet top = good;
    top.origin_y_mm = -3;
    Sheet bottom = good;
    bottom.height_mm = 290;
    Sheet unknown = good;
    unknown.origin_x_mm = kNaN;
    for (const Sheet& sheet : {left, right, top, bottom, unknown}) {
        EXPECT_THAT([&] { validate(sheet); },
                    ThrowsMessage<BadArgument>(HasSubstr("do not fit on a page of")));
    }
    Sheet empty = good;
    empty.rows = -5;
    EXPECT_THAT([&] { validate(empty); },
                ThrowsMessage<BadArgument>(HasSubstr("only 0 rows of dots fit")));
}

TEST(validate_resolution, wants_a_displacement_of_a_printer_pixel) {
    const Sheet sheet = make_sheet({});
    for (const double dpi : {300.0, 305.0, 600.0, 720.0, 1200.0, 19200.0}) {
        EXPECT_NO_THROW(validate_resolution(sheet, dpi)) << dpi;
    }
    for (const double dpi : {72.0, 299.0}) {
        EXPECT_THAT(
            [&] { validate_resolution(sheet, dpi); },
            ThrowsMessage<BadArgument>(HasSubstr("at least one is needed (300 dpi or more)")))
            << dpi;
    }
    for (const double dpi : {0.0, -300.0, kNaN, kInfinity, 19201.0}) {
        EXPECT_THAT(
            [&] { validate_resolution(sheet, dpi); },
            ThrowsMessage<BadArgument>(HasSubstr("it must be over 0 and at most 19200 dpi")))
            << dpi;
    }
}

TEST(validate_resolution, wants_white_between_dots) {
    SheetOptions options;
    // At 600 dpi, the minimum distance between two dots is 8 px: the spacing of 12 px, minus two
    // displacements of 2 px.
    options.pattern.dot_mm = 0.33;  // 8 px
    EXPECT_THAT([&] { validate_resolution(make_sheet(options), 600); },
                ThrowsMessage<BadArgument>(HasSubstr("neighbouring dots of 8 printer pixels")));
    options.pattern.dot_mm = 0.29;  // 7 px
    EXPECT_NO_THROW(validate_resolution(make_sheet(options), 600));
}

}  // namespace
}  // namespace dotpose
