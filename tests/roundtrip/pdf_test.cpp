#include <cmath>
#include <filesystem>
#include <string>
#include <tuple>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "../temporary_directory.hpp"
#include "dot_places.hpp"
#include "dotpose/tools/print.hpp"
#include "rendered_page.hpp"

namespace dotpose::roundtrip {
namespace {

/// Limits on the distances between the centroids of dots and their nominal positions, after
/// subtracting the mean offset from all centroids.
struct Limits {
    double mean_um;
    double largest_um;
};
// Usual limits in µm. The maximum of 12 µm is a seventh of the displacement of a symbol, which is
// 85 µm at a spacing of 0.508 mm.
constexpr Limits kUsual = {4, 12};
// Limits for a spacing of 0.3 mm at 300 dpi, which is 3.5 pixels. They are larger, because
// neighbouring dots may ink the same pixel. The displacement of a symbol is 50 µm.
constexpr Limits kFineOnCoarse = {6, 30};

// Minimum diameter of a dot whose position can be measured exactly. A smaller dot may look the same
// at different positions within a pixel. For example, the error is up to 17 µm for a dot of 0.05 mm
// at 300 dpi. A dot that consists of whole pixels has no such error.
constexpr double kExactDot_px = 2.3;
// Maximum diameter at which there is a white pixel between any two dots, for a spacing of 0.3 mm at
// 300 dpi.
constexpr double kFineDot_px = 1.63;

struct Dots {
    double spacing_mm;
    DotDrawing drawing;
    const char* name;
};

bool is_whole(double px) {
    return std::abs(px - std::round(px)) < 1e-6;
}

/// Writes a PDF for 600 dpi, renders it at `dpi`, and returns the errors of its dots.
DotErrors rendered_errors(const Sheet& sheet, DotDrawing drawing, const char* renderer, int dpi) {
    PrintOptions print;
    print.drawing = drawing;
    print.labels = false;
    const test::TemporaryDirectory directory;
    const auto pdf = directory.path() / "sheet.pdf";
    write_sheet(sheet, pdf, print);
    return measure_dots(render(renderer, pdf, dpi), sheet, dpi);
}

class RenderedPdf : public testing::TestWithParam<std::tuple<Dots, const char*, int>> {};

TEST_P(RenderedPdf, shows_every_dot_in_its_place) {
    const auto& [dots, renderer, dpi] = GetParam();
    SheetOptions options;
    options.pattern.spacing_mm = dots.spacing_mm;
    options.pattern.displacement_mm = dots.spacing_mm / 6;
    const bool is_aligned = is_whole(dots.spacing_mm / 6 * dpi / 25.4);
    const bool is_coarse = dpi == 300 && !is_aligned;
    const bool is_fine_on_coarse = is_coarse && dots.spacing_mm < 0.4;
    const double coarse_dot_px = is_fine_on_coarse ? kFineDot_px : kExactDot_px;
    options.pattern.dot_mm = is_coarse ? coarse_dot_px * 25.4 / dpi : dots.spacing_mm / 6;
    options.pattern.section = {5, 60};
    options.origin = {123'456, 400'000'000};
    // The height is not a whole number of pixels. The page is wide, because errors that accumulate
    // along x would be largest at the right edge.
    options.paper = {150, 21.3};
    options.margin_mm = 5;
    const Sheet sheet = make_sheet(options);
    const DotErrors errors = rendered_errors(sheet, dots.drawing, renderer, dpi);
    fmt::print(
        "{} mm {}, {} at {} dpi: {} dots, mean {:.2f} um, largest {:.2f} um, offset {:.1f} "
        "{:.1f} um\n",
        dots.spacing_mm, dots.name, renderer, dpi, errors.dots, errors.mean_um, errors.largest_um,
        errors.offset_x_um, errors.offset_y_um);
    EXPECT_EQ(errors.dots, sheet.columns * sheet.rows);
    EXPECT_EQ(errors.missing, 0);
    EXPECT_EQ(errors.wrong_symbols, 0);
    const Limits limits = is_fine_on_coarse ? kFineOnCoarse : kUsual;
    EXPECT_LE(errors.mean_um, limits.mean_um);
    EXPECT_LE(errors.largest_um, limits.largest_um);
}

std::string case_name(const testing::TestParamInfo<RenderedPdf::ParamType>& tested) {
    const auto& [dots, renderer, dpi] = tested.param;
    return fmt::format("{}um_{}_{}_{}dpi", static_cast<int>(dots.spacing_mm * 1000 + 0.5),
                       dots.name, renderer, dpi);
}

INSTANTIATE_TEST_SUITE_P(
    renderers, RenderedPdf,
    testing::Combine(testing::Values(Dots{0.3, DotDrawing::automatic, "strokes"},
                                     Dots{0.508, DotDrawing::automatic, "glyphs"},
                                     Dots{0.508, DotDrawing::strokes, "strokes"},
                                     Dots{0.55, DotDrawing::automatic, "strokes"}),
                     testing::ValuesIn(kRenderers), testing::Values(300, 600, 1200)),
    case_name);

class OddResolution : public testing::TestWithParam<const char*> {};

// A renderer may move a glyph to a whole pixel or to certain fractions of a pixel, so glyphs are
// used only for dots whose size is a whole number of pixels. Strokes are drawn at their exact
// positions.
TEST_P(OddResolution, moves_letters_and_leaves_strokes) {
    constexpr int kOdd_dpi = 310;  // a spacing of 6.2 pixels
    SheetOptions options;
    options.pattern.dot_mm = options.pattern.spacing_mm / 3;
    options.paper = {150, 21.3};
    const Sheet sheet = make_sheet(options);
    const DotErrors letters = rendered_errors(sheet, DotDrawing::glyphs, GetParam(), kOdd_dpi);
    const DotErrors strokes = rendered_errors(sheet, DotDrawing::strokes, GetParam(), kOdd_dpi);
    fmt::print("{}: letters {:.1f} / {:.1f} um, strokes {:.1f} / {:.1f} um\n", GetParam(),
               letters.mean_um, letters.largest_um, strokes.mean_um, strokes.largest_um);
    EXPECT_GT(letters.mean_um, 2 * kUsual.mean_um);
    EXPECT_LE(strokes.mean_um, kUsual.mean_um);
    EXPECT_LE(strokes.largest_um, kUsual.largest_um);
}

INSTANTIATE_TEST_SUITE_P(renderers, OddResolution, testing::ValuesIn(kRenderers),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace dotpose::roundtrip
