/// Print check: examines a scan or photo of a printed sheet, and detects faults of the printer and
/// of the paper.
///
///     CheckPrintOptions options;  // the pattern as it was printed
///     const ImageOrigin origin = read_origin("scan.png");  // image_file.hpp
///     options.resolution = origin.resolution;
///     options.is_photo = origin.is_photo;
///     const PrintCheck check = check_print(read_image("scan.png").view(), options);
///     for (const Finding& finding : check.findings) puts(finding.text.c_str());
///
/// Calls `locate` on overlapping crops to find the pattern anywhere in the image, at any angle.
/// Neighbouring crops with consistent positions form a field, and every dot of a field is measured
/// in the image. The scale, rotation and skew of the print are computed from the measured and
/// nominal positions of the dots.
///
/// A page can contain several fields: patches of a test page (test_page.hpp), or sheets side by
/// side. Functions share no state, and throw Error or BadArgument.
///
/// Coordinate frames, both with x right and y DOWN: *pattern* (mm, as printed), *scan* (px,
/// relative to the centre of the first pixel).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dotpose/export.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/files/sheet.hpp"
#include "dotpose/image.hpp"
#include "dotpose/tools/image_file.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Known properties of the print and of the image.
struct CheckPrintOptions {
    /// The pattern that was printed. The section is read from the image. Patches of a test page
    /// encode their own settings, so for a test page only the code variant of `pattern` is used.
    Pattern pattern;
    /// True to detect the code variant from the whole page instead of using the code variant of
    /// `pattern`.
    bool any_code = false;
    /// Sheets that the scan may contain, for example the sheets of a sheet file. A field within the
    /// region of a sheet is compared with the dimensions of that sheet. Sheets whose code variant
    /// differs from the given or detected code variant are ignored, except that anoto and libdots
    /// are treated as one variant (see `overlap` in sheet_file.hpp).
    std::vector<Sheet> sheets;
    /// Resolution of the scan. If no resolution is given, or if the image shows the perspective or
    /// lens distortion of a camera, the image is treated as a photo. The check of a photo allows
    /// for perspective and lens distortion, and does not check the absolute scale. If the
    /// resolution contradicts the spacing, the check reports a fault.
    std::optional<Resolution> resolution;
    /// True if the metadata in the image file indicate that the image was taken with a camera. In
    /// this case, the resolution is ignored.
    bool is_photo = false;
    /// Reflectance of solid ink relative to the paper, 0 to 0.9. The check uses this value to
    /// compute the diameter of a dot, which is the diameter of a disc of solid ink with the same
    /// total darkness. The reflectance cannot be measured, because dots are only a few pixels wide.
    double ink_reflectance = 0.15;
    /// Called after each step of the check with the number of completed steps and an estimate of
    /// the total number, which may grow during the check. Returning false aborts the check with an
    /// Error.
    std::function<bool(int done, int total)> progress;
};

/// Scale and angles of a print in a flatbed scan, including the scanner's errors. To separate
/// printer errors from scanner errors, scan the page a second time, turned by 90 degrees.
struct PrintScale {
    /// Ratio of the printed to the nominal length along the pattern's x axis.
    double scale_x = 1;
    /// Ratio of the printed to the nominal length along the pattern's y axis.
    double scale_y = 1;
    /// Direction of the pattern's x axis in the scan, as an angle from +u towards +v.
    double rotation_rad = 0;
    double skew_rad = 0;  ///< angle from the x axis to the y axis, minus 90 degrees
};

/// Ratio of the x scale to the y scale of a print, measured in a photo. Perspective and the unknown
/// focal length of the camera make the ratio uncertain. The ratio is available only if its
/// uncertainty is at most half a percent.
struct ScaleRatio {
    double x_over_y = 1;
    double uncertainty = 0;  ///< maximum error of the ratio
};

/// Side length of a DistortionBin, in cells.
inline constexpr int kDistortionCells = 20;

/// Mean deviation of the dots in one bin from their fitted positions.
struct DistortionBin {
    double u_px = 0;  ///< mean position of the dots
    double v_px = 0;
    /// Measured minus fitted position along the axes of the scan, in mm on the paper.
    double du_mm = 0;
    double dv_mm = 0;
    int dots = 0;
};

/// One contiguous region of the code plane that was found in the image.
struct PrintField {
    Pattern pattern;        ///< nominal pattern, but with the section that was read from the image
    Cell origin;            ///< first cell of the region
    int columns = 0;        ///< number of columns of the region
    int rows = 0;           ///< number of rows of the region
    bool is_patch = false;  ///< true if the field is a patch of a test page
    /// The sheet whose region contains the field, as an index into CheckPrintOptions::sheets.
    std::optional<std::size_t> sheet;

    std::optional<PrintScale> scale;        ///< only for scans
    std::optional<ScaleRatio> scale_ratio;  ///< only for photos
    double spacing_px = 0;                  ///< spacing in the middle of the field
    /// Rms deviation of the dots from their fitted positions, per axis, in mm on the paper.
    double residual_mm = 0;
    /// Standard deviation, per axis, of the position errors of individual dots, in mm on the paper.
    /// It is computed from differences between neighbouring dots, so the distortion of the page
    /// hardly affects it.
    double scatter_mm = 0;
    std::vector<DistortionBin> distortion;
    double largest_distortion_mm = 0;  ///< length of the largest deviation in `distortion`

    /// Number of cells covered by other printed content, such as text. These cells are not counted
    /// in `cells`.
    int covered = 0;
    int cells = 0;       ///< number of cells in the region that are in view and not covered
    int missing = 0;     ///< number of cells without a dot
    int merged = 0;      ///< number of dots that touch a neighbour
    int dots = 0;        ///< number of dots found
    int bits_wrong = 0;  ///< number of wrong bits, at most two per dot found
    /// Median dot diameter. The diameter of a dot is the diameter of an equivalent disc (see
    /// CheckPrintOptions::ink_reflectance).
    double dot_mm = 0;
    /// Standard deviation of the dot diameters, computed from their median absolute deviation.
    double dot_sigma_mm = 0;
    double paper_level = 0;  ///< median grey level of blank paper
    double contrast = 0;     ///< darkness of the dot centres relative to the paper, 0 to 1
    /// False if the dot sizes and the contrast cannot be measured because of a photo's blur and
    /// tone curve.
    bool are_sizes_measured = true;
    /// False if missing and wrong dots cannot be detected because of the noise in a photo.
    bool are_dots_checked = true;

    double covered_fraction() const {
        return covered > 0 ? double(covered) / (covered + cells) : 0;
    }
    double missing_fraction() const { return cells > 0 ? double(missing) / cells : 0; }
    double merged_fraction() const { return dots > 0 ? double(merged) / dots : 0; }
    double wrong_fraction() const { return dots > 0 ? 0.5 * bits_wrong / dots : 0; }
    /// Returns the relative difference between the dot diameter and its nominal value. Negative if
    /// the dots are smaller than intended.
    double gain() const { return dot_mm / pattern.dot_mm - 1; }
    /// Returns an estimate of the fraction of cells that are covered, have no dot, have a merged
    /// dot or have a wrong bit: the sum of the four fractions above, at most 1.
    double bad_fraction() const;
};

/// Kinds of faults and remarks.
enum class FindingKind {
    good,          ///< no fault was found
    scaled,        ///< the page as a whole is too large or too small
    uneven_scale,  ///< the horizontal and vertical scales differ
    rotated,       ///< the page is turned in the scan, which is harmless
    skewed,        ///< the axes are not perpendicular
    distorted,     ///< dots in some regions deviate from their nominal positions
    swollen,       ///< dots are too large or run together
    thin,          ///< dots are too small or too pale
    missing,       ///< dots are missing
    covered,       ///< other printed content covers some of the dots
    /// Many bits are wrong. Either dots are too far from their nominal positions, or the page was
    /// printed in another code variant.
    bits_wrong,
    too_coarse,     ///< the scan has too few pixels per dot
    pale,           ///< the contrast of the dots is low
    no_resolution,  ///< the resolution is not known, so the scale cannot be checked
    contradiction,  ///< the resolution and the spacing contradict each other
    repeated,       ///< the page contains the same cells more than once
    unknown_sheet,  ///< the cells are not on any of the given sheets
    unresolved,     ///< the photo is too coarse to show some of the faults above
    best_settings,  ///< the best settings of a test page
};
/// Returns the identifier as written in output, for example "uneven_scale".
const char* name(FindingKind kind);

/// One fault or remark.
struct Finding {
    FindingKind kind = FindingKind::good;
    bool is_fault = false;  ///< true for a fault to correct, false for a remark
    /// Index of the field to which the finding applies. None if it applies to the whole scan.
    std::optional<std::size_t> field;
    /// One or two sentences for the user: the fault, the likely cause, and the remedy.
    std::string text;
};

/// Two fields that show the same cells. A position in these cells is not unique on the page.
struct RepeatedCells {
    std::size_t first = 0;  ///< indices of the fields
    std::size_t second = 0;
    int cells = 0;  ///< number of cells whose dot is correct in both fields
};

/// Evidence that the image is a photo rather than a scan.
struct CameraSigns {
    double perspective = 0;  ///< relative change in scale across the page, due to perspective
    /// Displacement of the outermost dot due to lens distortion, relative to its distance from the
    /// image centre.
    double lens = 0;
};

/// Result of a print check.
struct PrintCheck {
    /// All fields, largest first. Empty if there is no pattern in the image.
    std::vector<PrintField> fields;
    /// True if the pattern is found only in the flipped image. In this case, `fields` is empty.
    bool is_mirrored = false;
    CodeVariant code = CodeVariant::anoto;  ///< code variant that was given or detected
    /// Probability that the detected code variant is wrong. 0 if the code variant was given.
    double code_p_wrong = 0;
    std::optional<Resolution> resolution;  ///< resolution that was used, or none for a photo
    bool is_photo = false;                 ///< copy of CheckPrintOptions::is_photo
    /// Evidence that the image is a photo although a resolution was given. The given resolution is
    /// then ignored. Not set if there is no such evidence, or if no resolution was given.
    std::optional<CameraSigns> camera;
    std::vector<RepeatedCells> repeated;
    bool is_test_page = false;
    /// Patches of the default test page (`make_test_page` with default options) that are not among
    /// the fields.
    std::vector<Pattern> unread_patches;
    /// On a test page: index of the best patch for each spacing, finest spacing first. The best
    /// patch is the one with the dot diameter closest to a sixth of the spacing. Patches with many
    /// faulty cells are excluded.
    std::vector<std::size_t> best_per_spacing;
    /// Index of the best patch overall, which is the best patch for the finest spacing. A finer
    /// pattern is better because more of its dots are in view. Equals `best_per_spacing.front()`.
    /// Valid only if `best_per_spacing` is not empty.
    std::size_t best = 0;
    std::vector<Finding> findings;
};

/// Checks a scan or photo of at least 64 x 64 px. Needs about 100 bytes of memory per dot in
/// addition to the image. Throws BadArgument if a length of `pattern` is not positive and finite,
/// if the displacement is half the spacing or more, or if the ink reflectance or the resolution is
/// out of range.
PrintCheck check_print(const ImageView& scan, const CheckPrintOptions& options);

}  // namespace dotpose

DOTPOSE_END_EXPORT
