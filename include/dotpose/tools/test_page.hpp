/// Test page: patches with different dot sizes and spacings, to find the best settings for a
/// printer.
///
/// The position of each patch encodes its settings. The top left cell (x, y) of a patch is
///
///     x = kTestPageCell + kTestPatchCells * (spacing in 1/1200 inch)
///     y = kTestPageCell + kTestPatchCells * (diameter of a dot in 1/1200 inch)
///
/// The position that `locate` reads anywhere in a patch therefore identifies the patch. Cells whose
/// x and y are at least kTestPageCell are reserved for test pages and must not be used for sheets.
/// The displacement of the dots is a sixth of the spacing.
#pragma once

#include <optional>
#include <vector>

#include "dotpose/export.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/files/sheet.hpp"
#include "dotpose/tools/print.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Minimum x and y of the cells that are reserved for test pages.
inline constexpr std::uint32_t kTestPageCell = 410'000'000;
/// Distance, in cells, between the first cells of two patches whose settings differ by one unit
/// (1/1200 inch). A patch has at most half this number of cells per axis.
inline constexpr std::uint32_t kTestPatchCells = 10'000;
/// Unit of spacings and diameters on a test page.
inline constexpr double kTestUnit_mm = 25.4 / 1200;

/// Contents of a test page.
struct TestPageOptions {
    CodeVariant code = CodeVariant::anoto;
    Paper paper;
    double margin_mm = 10;
    /// Spacing in each column of patches, and dot diameter in each row of patches, in 1/1200 inch.
    /// Range: 1 to 80.
    std::vector<int> spacings = {18, 24, 30, 36};  ///< 0.381, 0.508, 0.635, 0.762 mm
    std::vector<int> dots = {2, 3, 4, 6, 8};       ///< 0.042, 0.064, 0.085, 0.127, 0.169 mm
};

/// Lays out the patches, with a label "spacing/dot" in mm above each patch. Omits combinations in
/// which dots would touch. Throws BadArgument if a patch is not a valid sheet (see `make_sheet`),
/// if a setting is outside [1, 80], or if there are no spacings or no dot diameters.
PrintPage make_test_page(const TestPageOptions& options);

/// Returns the settings of the patch whose first cell is nearest to `cell` on both axes, even if
/// `cell` is slightly outside the patch. Returns nullopt if the cell is outside the region of the
/// test pages, or if the dots of the patch would touch.
std::optional<Pattern> test_patch_at(CodeVariant code, Cell cell);

}  // namespace dotpose

DOTPOSE_END_EXPORT
