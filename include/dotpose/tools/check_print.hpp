/// Checking a print: what a scan or photo of a printed sheet shows about printer and paper.
///
///     CheckPrintOptions options;  // the pattern as it was printed
///     const ImageOrigin origin = read_origin("scan.png");  // image_file.hpp
///     options.resolution = origin.resolution;
///     options.is_photo = origin.is_photo;
///     const PrintCheck check = check_print(read_image("scan.png").view(), options);
///     for (const Finding& finding : check.findings) puts(finding.text.c_str());
///
/// The pattern is found anywhere on the image, at any angle, by `locate` on overlapping crops; the
/// grid is then followed through neighbouring crops, and every dot in it is measured in the image.
/// The nominal place of each dot is known, so scale, rotation and skew of the print follow.
///
/// A page may hold several fields: patches of a test page (test_page.hpp), or sheets side by side.
/// Functions throw Error or BadArgument; they share no state.
///
/// Frames (both x right, y DOWN): *pattern* (mm, as printed), *scan* (pixels; the centre of the
/// first one is (0, 0)).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dotpose/files/error.hpp"
#include "dotpose/files/sheet.hpp"
#include "dotpose/image.hpp"
#include "dotpose/tools/image_file.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// What is known of the print and its image.
struct CheckPrintOptions {
    /// The pattern that was printed. The section is read from the image. Patches of a test page
    /// encode how they were printed, so only the code variant counts for them.
    Pattern pattern;
    /// Whether to find the code variant from the whole page instead of taking that of `pattern`.
    bool any_code = false;
    /// Sheets that may be on the scan, such as those of a sheet file: a field in the region of one
    /// of them is judged by its pattern. Only sheets with the code variant of `pattern` are found.
    std::vector<Sheet> sheets;
    /// Resolution of the scan. Without it the image counts as a photo, and so does one with a
    /// camera's perspective or lens: both are then allowed for, and scale is not judged. A
    /// resolution that contradicts the spacing is a fault.
    std::optional<Resolution> resolution;
    /// Whether a camera took the image, as its file says; a resolution is then not used.
    bool is_photo = false;
    /// Reflectance of solid ink relative to the paper, 0 to 0.9; dots smaller than a few pixels
    /// never show it. Diameters are those of discs of this ink with the darkness of the dots.
    double ink_reflectance = 0.15;
    /// Called after each part of the work; return false to stop (throws Error).
    std::function<bool(int done, int total)> progress;
};

/// Scale and angles of a print on a flatbed scan. They include those of the scanner: to tell the
/// two apart, scan once more with the page turned by 90 degrees.
struct PrintScale {
    double scale_x = 1;       ///< printed length over nominal length along the pattern's x axis
    double scale_y = 1;       ///< printed length over nominal length along the pattern's y axis
    double rotation_rad = 0;  ///< direction of the pattern's x axis in the scan, from +u towards +v
    double skew_rad = 0;      ///< excess over 90 degrees of the angle from the x to the y axis
};

/// Ratio of the two scales of a print, as a photo shows it. Given only where perspective and the
/// unknown focal length of the camera leave it uncertain by no more than half a percent.
struct ScaleRatio {
    double x_over_y = 1;
    double uncertainty = 0;  ///< greatest error of the ratio
};

/// Side, in cells, of the parts of a page whose distortion is reported.
inline constexpr int kDistortionCells = 20;

/// Mean deviation of the dots of one part of the page from their fitted places.
struct DistortionBin {
    double u_px = 0;  ///< centre of the dots
    double v_px = 0;
    double du_mm = 0;  ///< seen minus fitted, along the scan's axes, in mm on the paper
    double dv_mm = 0;
    int dots = 0;
};

/// One contiguous region of the code.
struct PrintField {
    Pattern pattern;                   ///< nominal pattern, with the section that was read
    Cell origin;                       ///< first cell of the region
    int columns = 0;                   ///< of the region
    int rows = 0;                      ///< of the region
    bool is_patch = false;             ///< whether it is a patch of a test page
    std::optional<std::size_t> sheet;  ///< index in CheckPrintOptions::sheets of the sheet whose
                                       ///< region it is

    std::optional<PrintScale> scale;        ///< of scans only
    std::optional<ScaleRatio> scale_ratio;  ///< of photos only
    double spacing_px = 0;                  ///< in the middle of the field
    double residual_mm = 0;  ///< rms of the dots from their fitted places, per axis, on the paper
    double scatter_mm = 0;   ///< rms of single dots about their neighbours, per axis, on the paper
    std::vector<DistortionBin> distortion;
    double largest_distortion_mm = 0;  ///< greatest of `distortion`

    int covered = 0;             ///< cells under other print, such as text; not counted in `cells`
    int cells = 0;               ///< cells of the region that are in view and not covered
    int missing = 0;             ///< cells without a dot
    int merged = 0;              ///< dots that touch a neighbour
    int dots = 0;                ///< dots found
    int bits_wrong = 0;          ///< wrong bits, of two for each dot found
    double dot_mm = 0;           ///< median diameter of equivalent discs, see
                                 ///< CheckPrintOptions::ink_reflectance
    double dot_sigma_mm = 0;     ///< spread of the diameter, from the median absolute deviation
    double paper_level = 0;      ///< median grey level of blank paper
    double contrast = 0;         ///< darkness of the dots' middles relative to the paper, 0 to 1
    bool are_sizes_told = true;  ///< false: blur and tone curve of a photo hide sizes and contrast
    bool are_dots_told = true;   ///< false: noise of a photo hides which dots are missing or wrong

    double covered_share() const { return covered > 0 ? double(covered) / (covered + cells) : 0; }
    double missing_share() const { return cells > 0 ? double(missing) / cells : 0; }
    double merged_share() const { return dots > 0 ? double(merged) / dots : 0; }
    double wrong_share() const { return dots > 0 ? 0.5 * bits_wrong / dots : 0; }
    /// Relative growth of the dot's diameter over the nominal one; below 0: the dot shrank.
    double gain() const { return dot_mm / pattern.dot_mm - 1; }
    /// Share of cells that cannot be used: covered, missing, merged or with a wrong bit.
    double bad_share() const;
};

/// Kinds of faults and remarks.
enum class FindingKind {
    good,           ///< no fault was found
    scaled,         ///< the page as a whole is too large or too small
    uneven_scale,   ///< horizontal and vertical scale differ
    rotated,        ///< the page is turned in the scan, which is harmless
    skewed,         ///< the axes do not stand at right angles
    distorted,      ///< dots are displaced by region
    swollen,        ///< dots are too large or run together
    thin,           ///< dots are too small or too pale
    missing,        ///< dots are missing
    covered,        ///< other print lies over dots
    bits_wrong,     ///< dots are displaced so much that they read wrong
    too_coarse,     ///< the scan has too few pixels per dot
    pale,           ///< the dots have little contrast
    no_resolution,  ///< the scale could not be checked
    contradiction,  ///< resolution and spacing contradict each other
    repeated,       ///< the same cells are on the page more than once
    unknown_sheet,  ///< the cells are on no sheet that was given
    unresolved,     ///< the photo is too coarse to show some of the above
    best_settings,  ///< the best settings of a test page
};
/// Returns the identifier as written in output, for example "uneven_scale".
const char* name(FindingKind kind);

/// One fault or remark.
struct Finding {
    FindingKind kind = FindingKind::good;
    bool is_fault = false;             ///< true: a fault to correct; false: a remark
    std::optional<std::size_t> field;  ///< index of the field concerned; none: the scan as a whole
    std::string text;  ///< one or two sentences for the user: the fault, the likely cause, the
                       ///< remedy
};

/// Two fields that show the same cells, so that a place read there is not unique.
struct RepeatedCells {
    std::size_t first = 0;  ///< indices of the fields
    std::size_t second = 0;
    int cells = 0;  ///< number of cells with a dot in both fields
};

/// Evidence in the image that a camera took it.
struct CameraSigns {
    double perspective = 0;  ///< relative change of lengths across the page
    double lens = 0;         ///< relative displacement of the outermost dots by the lens
};

/// The result of the check.
struct PrintCheck {
    /// All fields, the largest first. Empty if there is no pattern in the image.
    std::vector<PrintField> fields;
    bool is_mirrored = false;  ///< whether there are none, but are in the flipped image
    CodeVariant code = CodeVariant::anoto;  ///< code variant that was given or found
    double code_p_wrong = 0;  ///< if the code variant was found: probability that it is another one
    std::optional<Resolution> resolution;  ///< resolution that was used; none for a photo
    bool is_photo = false;                 ///< as in the options
    std::optional<CameraSigns> camera;     ///< if the stated resolution was not used: the reason
    std::vector<RepeatedCells> repeated;
    bool is_test_page = false;
    /// Patches of the usual test page (make_test_page's defaults) that are not among the fields.
    std::vector<Pattern> unread_patches;
    /// In a test page: index of the field with the best settings for each spacing, finest first.
    std::vector<std::size_t> best_per_spacing;
    std::size_t best = 0;  ///< field with the best settings of all; not valid if best_per_spacing
                           ///< is empty
    std::vector<Finding> findings;
};

/// Checks a scan or photo of at least 64 x 64 px. Memory: about 100 bytes per dot, besides the
/// image. Throws BadArgument for a pattern that `validate` would refuse and for wrong options.
PrintCheck check_print(const ImageView& scan, const CheckPrintOptions& options);

}  // namespace dotpose

#pragma GCC visibility pop
