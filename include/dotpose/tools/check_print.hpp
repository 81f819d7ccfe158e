/// Checking a print: what a scan or photo of a printed sheet tells about printer and paper.
///
///     CheckPrintOptions options;                        // the pattern as it was printed
///     options.resolution = read_resolution("scan.png"); // image_file.hpp
///     const PrintCheck check = check_print(read_image("scan.png").view(), options);
///     for (const Finding& finding : check.findings) puts(finding.text.c_str());
///
/// The pattern is found anywhere on the image, at any angle, by `locate` on overlapping crops; the
/// grid is then followed through neighbouring crops, and every dot in it is measured in the image.
/// Where the nominal place of each dot is known, so are scale, rotation and skew of the print.
///
/// A page may hold several fields: patches of a test page (test_page.hpp), or sheets side by side.
/// Functions throw Error or BadArgument; they share no state.
///
/// Frames (both x right, y DOWN): *pattern* (mm, as printed), *scan* (pixels; the centre of the
/// first one is (0, 0)).
#pragma once

#include <filesystem>
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

struct CheckPrintOptions {
    /// What was printed. The section is found, not believed. Patches of a test page say themselves
    /// how they were printed; of them only the profile counts.
    Pattern pattern;
    /// The profile is found out from the whole page, whatever `pattern` says.
    bool any_code = false;
    /// Sheets that may be on the scan, such as those of a sheet file: what is found in the region
    /// of one of them is judged by its pattern. Only those of the profile of `pattern` are found.
    std::vector<Sheet> sheets;
    /// Of the scan. Without it the image is taken as a photo, and so is one that shows the page as
    /// only a camera does: perspective and a lens are allowed for, and nothing is said about scale.
    std::optional<Resolution> resolution;
    /// How light solid ink is, relative to the paper, 0 to 0.9; dots smaller than a few pixels
    /// never show it. Diameters are those of discs of this ink with the darkness of the dots.
    double ink_reflectance = 0.15;
    /// Told after each part of the work; return false to give up (throws Error).
    std::function<bool(int done, int total)> progress;
};

/// Scale and angles of a print on a flatbed scan. Printer and scanner share them: scan once more,
/// turned by 90 degrees, to tell which of the two is to blame.
struct PrintScale {
    double scale_x = 1;       ///< printed length over nominal length along the pattern's x axis
    double scale_y = 1;       ///< and along its y axis
    double rotation_rad = 0;  ///< of the pattern's x axis in the scan, from +u towards +v
    double skew_rad = 0;      ///< by how much the angle from the x to the y axis exceeds 90 degrees
};

/// What a photo tells of the two scales of a print: their ratio, where perspective and the unknown
/// focal length of the camera leave it open by no more than half a percent.
struct ScaleRatio {
    double x_over_y = 1;
    double uncertainty = 0;  ///< the ratio is at most so far off
};

/// Side of the parts of a page whose distortion is told, in cells.
inline constexpr int kDistortionCells = 20;

/// Mean deviation of the dots of one part of the page from where the fit puts them.
struct DistortionBin {
    double u_px = 0;  ///< centre of the dots
    double v_px = 0;
    double du_mm = 0;  ///< seen minus fitted, along the scan's axes, in mm on the paper
    double dv_mm = 0;
    int dots = 0;
};

/// One contiguous region of the code.
struct PrintField {
    Pattern pattern;                   ///< nominal, with the section that was read
    Cell origin;                       ///< first cell of the region
    int columns = 0;                   ///< of the region
    int rows = 0;                      ///< of the region
    bool is_patch = false;             ///< of a test page
    std::optional<std::size_t> sheet;  ///< whose region it is, in CheckPrintOptions::sheets

    std::optional<PrintScale> scale;        ///< of scans only
    std::optional<ScaleRatio> scale_ratio;  ///< of photos only
    double spacing_px = 0;                  ///< in the middle of the field
    double residual_mm = 0;  ///< rms of the dots from their fitted places, per axis, on the paper
    double scatter_mm = 0;   ///< of single dots about their neighbours, per axis, on the paper
    std::vector<DistortionBin> distortion;
    double largest_distortion_mm = 0;  ///< of the bins

    int covered = 0;             ///< cells with other print, such as text: not counted below
    int cells = 0;               ///< of the region, in view and not covered
    int missing = 0;             ///< cells without a dot
    int merged = 0;              ///< dots that touch a neighbour
    int dots = 0;                ///< dots found
    int bits_wrong = 0;          ///< of two for each dot found
    double dot_mm = 0;           ///< median equivalent diameter, see ink_reflectance
    double dot_sigma_mm = 0;     ///< its spread, from the median absolute deviation
    double paper_level = 0;      ///< median grey level of blank paper
    double contrast = 0;         ///< darkness of the dots' middles relative to the paper, 0 to 1
    bool are_sizes_told = true;  ///< false: blur and tone curve of a photo hide sizes and contrast
    bool are_dots_told = true;   ///< false: noise of a photo hides which dots are missing or wrong

    double covered_share() const { return covered > 0 ? double(covered) / (covered + cells) : 0; }
    double missing_share() const { return cells > 0 ? double(missing) / cells : 0; }
    double merged_share() const { return dots > 0 ? double(merged) / dots : 0; }
    double wrong_share() const { return dots > 0 ? 0.5 * bits_wrong / dots : 0; }
    /// Growth of the dot's diameter over the nominal one, relative to it; below 0: shrunk.
    double gain() const { return dot_mm / pattern.dot_mm - 1; }
    /// Share of cells that cannot be used: covered, missing, merged or with a wrong bit.
    double bad_share() const;
};

/// What is wrong, or worth knowing.
enum class FindingKind {
    good,           ///< nothing to complain of
    scaled,         ///< the page as a whole is too large or too small
    uneven_scale,   ///< horizontal and vertical scale differ
    rotated,        ///< harmless
    skewed,         ///< the axes do not stand at right angles
    distorted,      ///< dots are displaced by region
    swollen,        ///< dots are too large or run together
    thin,           ///< dots are too small or too pale
    missing,        ///< dots are missing
    covered,        ///< other print lies over dots
    bits_wrong,     ///< dots are displaced so much that they read wrong
    too_coarse,     ///< the scan shows too little of each dot
    pale,           ///< little contrast
    no_resolution,  ///< scale could not be checked
    unresolved,     ///< what a photo is too coarse to tell
    best_settings,  ///< of a test page
};
/// Identifier as written in output, for example "uneven_scale".
const char* name(FindingKind kind);

struct Finding {
    FindingKind kind = FindingKind::good;
    bool is_fault = false;             ///< something to mend; else a remark
    std::optional<std::size_t> field;  ///< that it is about; none: the scan as a whole
    std::string text;  ///< one or two sentences for the user: what, the likely cause, what to do
};

/// How a page shows that a camera took it.
struct CameraSigns {
    double perspective = 0;  ///< by how much lengths change across the page, relative
    double lens = 0;         ///< by how much the lens displaces the outermost dots, relative
};

struct PrintCheck {
    /// All fields, the largest first. Empty: there is no pattern in the image.
    std::vector<PrintField> fields;
    Profile code = Profile::anoto;  ///< given, or found out
    double code_p_wrong = 0;        ///< probability that it is another one, where it was found out
    std::optional<Resolution> resolution;  ///< as used; none for a photo
    std::optional<CameraSigns> camera;     ///< why the stated resolution was not used, if so
    bool is_test_page = false;
    /// Patches of the usual test page (make_test_page's defaults) that are not among the fields.
    std::vector<Pattern> unread_patches;
    /// In a test page: index of the field with the best settings for each spacing, finest first.
    std::vector<std::size_t> best_per_spacing;
    std::size_t best = 0;  ///< of the test page; meaningless if best_per_spacing is empty
    std::vector<Finding> findings;
};

/// Checks a scan or photo of at least 64 x 64 px. Memory: some 100 bytes per dot, besides the
/// image. Throws BadArgument for a pattern `validate` would refuse and for wrong options.
PrintCheck check_print(const ImageView& scan, const CheckPrintOptions& options);

/// Draws the deviations of all fields over the outline of the scan, enlarged, as SVG.
/// Throws Error if the file cannot be written.
void draw_distortion(const std::filesystem::path& path, const ImageView& scan,
                     const PrintCheck& check);

}  // namespace dotpose

#pragma GCC visibility pop
