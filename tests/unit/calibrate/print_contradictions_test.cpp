// Tests prints that contradict their description: places that occur twice, pages that belong to
// none of the given sheets, and impossible resolutions. Also tests scans that contain only a small
// number of large dots.
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../scanned_page.hpp"
#include "dotpose/tools/check_print.hpp"
#include "print_checks.hpp"

namespace dotpose::check_print_test {
namespace {

using test::scan_page;
using test::ScanSettings;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(PrintContradictions, cells_that_are_on_the_page_twice_are_a_fault) {
    SheetOptions options;
    options.paper = {40, 30};
    std::vector<Sheet> cards(3, make_sheet(options));
    cards[1].origin_x_mm += 42;
    cards[2].origin_x_mm += 84;
    cards[2].origin = {5000, 5000};
    for (Sheet& card : cards)
        card.width_mm = 126;
    const PrintCheck result = check(scan_page(cards, {}), 600);
    ASSERT_EQ(result.fields.size(), 3U);
    EXPECT_THAT(faults(result), ElementsAre("repeated", "repeated"));
    for (const Finding& finding : result.findings) {
        const bool is_copy = result.fields[*finding.field].origin == cards[0].origin;
        EXPECT_TRUE(is_copy || !finding.is_fault) << finding.text;
    }
    ASSERT_EQ(result.repeated.size(), 1U);
    EXPECT_GT(result.repeated[0].cells, 0.99 * cards[0].columns * cards[0].rows);
}

TEST(PrintContradictions, a_page_that_is_on_no_given_sheet_is_a_fault) {
    const Sheet sheet = small_sheet();
    CheckPrintOptions options;
    options.resolution = Resolution{300, 300};
    options.sheets = {sheet};
    ScanSettings settings;
    settings.dpi = 300;
    const GreyImage scan = scan_page(sheet, settings);
    EXPECT_THAT(faults(check_print(scan.view(), options)), IsEmpty());
    options.sheets[0].origin.x += 1000;
    const PrintCheck result = check_print(scan.view(), options);
    EXPECT_THAT(faults(result), ElementsAre("unknown_sheet"));
    EXPECT_EQ(result.findings.size(), 1U);
}

TEST(PrintContradictions, a_resolution_that_contradicts_the_spacing_is_a_fault) {
    ScanSettings settings;
    settings.dpi = 600;
    // At 100 dpi, the spacing of 12 px corresponds to 3.048 mm.
    const PrintCheck result = check(scan_page(small_sheet(), settings), 100);
    EXPECT_THAT(faults(result), ElementsAre("contradiction"));
    EXPECT_THAT(result.findings[0].text, HasSubstr("at 100 dpi the dots are 3.048 mm apart instead "
                                                   "of 0.508 mm"));
    EXPECT_FALSE(result.resolution);
    EXPECT_FALSE(result.fields.at(0).scale);
}

TEST(PrintContradictions, judges_dots_that_are_83_pixels_apart) {
    SheetOptions options;
    options.paper = {9, 9};
    options.pattern.code = CodeVariant::microdots;
    options.pattern.section = {10, 10};
    options.margin_mm = 0.5;
    ScanSettings settings;
    settings.dpi = 83 * 25.4 / 0.508;
    settings.blur_sigma_px = 3;
    CheckPrintOptions expected;
    expected.any_code = true;
    expected.resolution = Resolution{settings.dpi, settings.dpi};
    const PrintCheck result =
        check_print(scan_page(make_sheet(options), settings).view(), expected);
    ASSERT_EQ(result.fields.size(), 1U);
    EXPECT_EQ(result.code, CodeVariant::microdots);
    EXPECT_NEAR(result.fields[0].spacing_px, 83, 0.05);
    EXPECT_THAT(faults(result), IsEmpty());
}

}  // namespace
}  // namespace dotpose::check_print_test
