#include "calibrate/print_findings.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <fmt/core.h>

#include "dotpose/tools/test_page.hpp"

namespace dotpose::calibrate {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180;

/// Limits for the deviation of the mean scale from 1. Deviations above kNotableScale are reported.
/// A deviation above kDriverScale is attributed to the printer driver, because printers and paper
/// cause smaller deviations. If the scales along the two axes differ by more than kUnevenScale, the
/// difference is reported.
constexpr double kDriverScale = 0.015;
constexpr double kNotableScale = 0.002;
constexpr double kUnevenScale = 0.002;
/// If the deviation of the mean scale from 1 exceeds this value, the given pattern or resolution
/// must be wrong.
constexpr double kImplausibleScale = 0.25;
constexpr double kNotableRotation_rad = 0.2 * kDegree_rad;
constexpr double kNotableSkew_rad = 0.1 * kDegree_rad;
constexpr double kNotableDistortion_mm = 0.1;
/// Limits for the relative change in dot diameter due to printing. A change outside these limits is
/// reported as a fault. Most printers stay within the limits.
constexpr double kSwollenGain = 0.5;
constexpr double kThinGain = -0.3;
constexpr double kNotableFraction = 0.01;
constexpr double kMinContrast = 0.2;
/// If the spacing in the scan is less than kCoarse_px, faults of individual dots may be due to the
/// scan. These faults are attributed to the scan if the scatter of the dots is more than
/// kCoarseScatter spacings, if more than kCoarseWrongShare of the bits are wrong, or if dots are
/// blurred together.
constexpr double kCoarse_px = 10;
constexpr double kCoarseScatter = 0.05;
constexpr double kCoarseWrongShare = 0.001;
constexpr double kMinSpacing_px = 5;
/// Maximum fraction of bad cells in a good patch of a test page.
constexpr double kGoodPatch = 0.005;

std::string percent(double fraction, int decimals = 1) {
    return fmt::format("{:.{}f} %", 100 * fraction, decimals);
}

bool is_fault(const Finding& finding) {
    return finding.is_fault;
}

/// Derives the findings from the measurements of a print.
class Findings {
  public:
    Findings(const CheckPrintOptions& options, const PrintCheck& check,
             std::vector<Finding>& findings)
        : options_(options), check_(check), findings_(findings) {}

    void fault(FindingKind kind, std::string text) {
        findings_.push_back({kind, true, field_, std::move(text)});
    }
    void remark(FindingKind kind, std::string text) {
        findings_.push_back({kind, false, field_, std::move(text)});
    }

    void judge_sheets() {
        for (std::size_t i = 0; i < check_.fields.size(); ++i) {
            const std::size_t before = findings_.size();
            field_ = i;
            judge_place(check_.fields[i]);
            judge_scale(check_.fields[i]);
            judge_dots(check_.fields[i]);
            judge_as_a_whole(before);
        }
    }

    void judge_as_a_whole(std::size_t first_finding) {
        const bool has_fault =
            std::any_of(findings_.begin() + static_cast<std::ptrdiff_t>(first_finding),
                        findings_.end(), is_fault);
        if (has_fault) return;
        const bool is_complete =
            check_.is_test_page || !field_ ||
            (check_.fields[*field_].are_sizes_measured && check_.fields[*field_].are_dots_checked);
        remark(FindingKind::good,
               is_complete ? "the print can be used as it is"
                           : "as far as this photo shows, the print can be used as it is");
    }

    void judge_nothing_found() {
        if (options_.resolution) {
            const double dpi = std::min(options_.resolution->x_dpi, options_.resolution->y_dpi);
            const double spacing_px = options_.pattern.spacing_mm * dpi / 25.4;
            if (spacing_px < kMinSpacing_px) {
                fault(FindingKind::too_coarse,
                      fmt::format("at {:.0f} dpi the dots are only {:.1f} pixels apart, too close "
                                  "to be resolved: scan at 600 dpi",
                                  dpi, spacing_px));
            }
        }
    }

    /// Reports cells that occur more than once on the page, and fields that are not part of any
    /// given sheet.
    void judge_place(const PrintField& field) {
        const auto is_part = [this](const RepeatedCells& cells) {
            return cells.first == *field_ || cells.second == *field_;
        };
        const auto most = std::ranges::max_element(
            check_.repeated, {},
            [&](const RepeatedCells& cells) { return is_part(cells) ? cells.cells : 0; });
        if (most != check_.repeated.end() && is_part(*most)) {
            fault(
                FindingKind::repeated,
                fmt::format(
                    "{} of its cells are on this scan more than once, so a place read there is not "
                    "unique: print each copy with cells of its own (--sheets, or another --origin)",
                    most->cells));
        }
        if (!options_.sheets.empty() && !field.sheet) {
            fault(FindingKind::unknown_sheet,
                  fmt::format("this page is not in the sheet file, and was checked for a spacing "
                              "of {:g} mm: give the sheet file that it was printed with",
                              field.pattern.spacing_mm));
        }
    }

    void judge_scale(const PrintField& field) {
        if (!field.scale) {
            if (options_.resolution && !check_.camera) return contradict_resolution(field);
            remark(FindingKind::no_resolution, why_no_scale());
            judge_scale_ratio(field);
            return;
        }
        const PrintScale& s = *field.scale;
        const double mean = std::sqrt(s.scale_x * s.scale_y);
        if (std::abs(mean - 1) > kImplausibleScale) {
            fault(FindingKind::scaled,
                  fmt::format("the spacing is {} of what it should be: check --spacing and --dpi",
                              percent(mean)));
        } else if (std::abs(mean - 1) > kDriverScale) {
            fault(FindingKind::scaled,
                  fmt::format("the driver scaled the page to {}: print at 100 %, without \"fit to "
                              "page\"",
                              percent(mean)));
        } else if (std::abs(mean - 1) > kNotableScale) {
            remark(FindingKind::scaled,
                   fmt::format("the page is {} too {}, which is common with paper and printers: "
                               "use a spacing of {:.5f} mm",
                               percent(std::abs(mean - 1), 2), mean > 1 ? "large" : "small",
                               field.pattern.spacing_mm * mean));
        }
        const double ratio = s.scale_x / s.scale_y - 1;
        if (std::abs(ratio) > kUnevenScale) {
            fault(FindingKind::uneven_scale,
                  fmt::format("horizontal and vertical scale differ by {} ({} and {}): the feed of "
                              "the printer or of the scanner is wrong; scan again, turned by 90 "
                              "degrees, to find out which",
                              percent(std::abs(ratio), 2), percent(s.scale_x, 2),
                              percent(s.scale_y, 2)));
        }
        judge_angles(s);
    }

    void judge_dots(const PrintField& field) {
        const bool is_photo = !field.scale;
        const bool is_coarse = is_too_coarse(field);
        if (is_coarse && !is_photo) {
            fault(FindingKind::too_coarse,
                  fmt::format(
                      "the image is too coarse to judge single dots: they are {:.1f} pixels apart, "
                      "and their places scatter by {:.3f} mm; scan at 600 dpi, as PNG or TIFF",
                      field.spacing_px, field.scatter_mm));
        } else {
            const bool are_dots_checked = field.are_dots_checked && !is_coarse;
            if (field.are_sizes_measured && !is_coarse) judge_size(field);
            if (are_dots_checked) judge_faulty_dots(field);
            remark_unresolved(field, are_dots_checked);
        }
        if (field.covered_fraction() > kNotableFraction) {
            remark(FindingKind::covered,
                   fmt::format(
                       "{} of the dots are covered or touched by other print, and cannot be used",
                       percent(field.covered_fraction())));
        }
        if (field.largest_distortion_mm > kNotableDistortion_mm) {
            remark(FindingKind::distorted,
                   fmt::format("parts of the page are off by up to {:.2f} mm: {}",
                               field.largest_distortion_mm,
                               is_photo ? "the sheet did not lie flat, or the lens bends lines"
                                        : "the paper or the scanner's carriage moved unevenly, or "
                                          "the sheet did not lie flat"));
        }
    }

    void judge_test_page() {
        if (check_.best_per_spacing.empty()) {
            fault(FindingKind::best_settings,
                  "no patch of the test page can be read without errors: scan at 600 dpi or "
                  "more, print at the printer's own resolution");
            return;
        }
        const PrintField& best = check_.fields[check_.best];
        remark(FindingKind::best_settings,
               fmt::format("best for this printer: --spacing {:.4f} --dot {:.4f}{}",
                           best.pattern.spacing_mm, best.pattern.dot_mm, others(check_.best)));
    }

  private:
    static bool is_too_coarse(const PrintField& field) {
        const bool is_blurred_together =
            field.merged_fraction() > kNotableFraction && field.gain() < kSwollenGain;
        return field.spacing_px < kCoarse_px &&
               (field.scatter_mm > kCoarseScatter * field.pattern.spacing_mm ||
                field.wrong_fraction() > kCoarseWrongShare || is_blurred_together);
    }

    void contradict_resolution(const PrintField& field) {
        const double dpi = std::sqrt(options_.resolution->x_dpi * options_.resolution->y_dpi);
        fault(FindingKind::contradiction,
              fmt::format("at {:.0f} dpi the dots are {:.3f} mm apart instead of {:g} mm: the "
                          "resolution or the spacing is wrong; correct it with --dpi or --spacing",
                          dpi, field.spacing_px * 25.4 / dpi, field.pattern.spacing_mm));
    }

    std::string why_no_scale() const {
        if (const auto& camera = check_.camera) {
            return fmt::format(
                "scale was not checked, because this is a photo, which has no scale of its own: "
                "lengths change by {} across the page, and the lens displaces its corners by {}; "
                "scan it on a flatbed",
                percent(camera->perspective), percent(std::abs(camera->lens)));
        }
        if (check_.is_photo) {
            return "scale was not checked, because this is a photo, which has no scale of its own: "
                   "its EXIF data have a camera's exposure; scan it on a flatbed, or give --dpi if "
                   "the page lies in the image as in a scan";
        }
        return "scale was not checked, because the image does not state the resolution of a scan: "
               "scan on a flatbed, or give --dpi if the page lies in the image as in a scan";
    }

    void judge_scale_ratio(const PrintField& field) {
        if (!field.scale_ratio) return;
        const double ratio = field.scale_ratio->x_over_y - 1;
        if (std::abs(ratio) < kUnevenScale + field.scale_ratio->uncertainty) return;
        fault(FindingKind::uneven_scale,
              fmt::format("horizontal and vertical scale differ by {}, give or take {}: the feed "
                          "of the printer is wrong; a scan is more accurate",
                          percent(std::abs(ratio), 2), percent(field.scale_ratio->uncertainty, 2)));
    }

    /// Adds a remark if the resolution of the photo is too low to show the sizes or the faults of
    /// dots.
    void remark_unresolved(const PrintField& field, bool are_dots_checked) {
        if (field.are_sizes_measured && are_dots_checked) return;
        const double dot_px = field.dot_mm * field.spacing_px / field.pattern.spacing_mm;
        remark(FindingKind::unresolved,
               fmt::format("the dots are {:.1f} pixels across in this photo: it does not show {}; "
                           "scan at 600 dpi, or come closer",
                           dot_px,
                           are_dots_checked ? "their size and how black they are"
                                            : "how large and black they are, and which of them are "
                                              "missing or misplaced"));
    }

    void judge_size(const PrintField& field) {
        const double gain = field.gain();
        if (gain > kSwollenGain || field.merged_fraction() > kNotableFraction) {
            fault(FindingKind::swollen,
                  fmt::format("dots are swollen: {:.3f} mm instead of {:.3f} mm{}; choose a "
                              "smaller --dot, better paper, or less ink",
                              field.dot_mm, field.pattern.dot_mm,
                              field.merged_fraction() > kNotableFraction
                                  ? fmt::format(", and {} of them run together",
                                                percent(field.merged_fraction()))
                                  : ""));
        } else if (gain < kThinGain) {
            fault(FindingKind::thin,
                  fmt::format("dots are thin or pale: as dark as solid dots of {:.3f} mm instead "
                              "of {:.3f} mm; choose a larger --dot, and switch off toner saving",
                              field.dot_mm, field.pattern.dot_mm));
        }
        // Contrast is checked only at sufficient resolution. If pixels are as large as dots, all
        // dots have low contrast, and pale dots are detected from `dot_mm` instead.
        if (field.spacing_px >= kCoarse_px && field.contrast < kMinContrast) {
            fault(FindingKind::pale,
                  fmt::format("the dots are only {} darker than the paper: print in black, "
                              "without toner saving",
                              percent(field.contrast, 0)));
        }
    }

    void judge_faulty_dots(const PrintField& field) {
        if (field.missing_fraction() > kNotableFraction) {
            fault(FindingKind::missing,
                  fmt::format("{} of the dots are missing: clean the printer's nozzles or drum, "
                              "choose a larger --dot, and keep other print off the dots",
                              percent(field.missing_fraction())));
        }
        if (field.wrong_fraction() > kNotableFraction) {
            fault(FindingKind::bits_wrong,
                  fmt::format("{} of the bits are wrong, because dots are in the wrong place: "
                              "print at the printer's own resolution, with a larger spacing",
                              percent(field.wrong_fraction())));
        }
    }

    void judge_angles(const PrintScale& s) {
        const double upright_rad = std::remainder(s.rotation_rad, std::numbers::pi / 2);
        if (std::abs(upright_rad) > kNotableRotation_rad) {
            remark(FindingKind::rotated,
                   fmt::format("the page is {:.2f} degrees askew, which is harmless",
                               std::abs(upright_rad) / kDegree_rad));
        }
        if (std::abs(s.skew_rad) > kNotableSkew_rad) {
            fault(FindingKind::skewed, fmt::format("the angle between the axes is {:.2f} degrees "
                                                   "instead of 90: the paper was fed askew",
                                                   90 + s.skew_rad / kDegree_rad));
        }
    }

    std::string others(std::size_t best) const {
        std::string text;
        for (const std::size_t index : check_.best_per_spacing) {
            if (index == best) continue;
            const Pattern& pattern = check_.fields[index].pattern;
            text += fmt::format("{} --spacing {:.4f} --dot {:.4f}", text.empty() ? "; also" : ",",
                                pattern.spacing_mm, pattern.dot_mm);
        }
        return text;
    }

    const CheckPrintOptions& options_;
    const PrintCheck& check_;
    std::vector<Finding>& findings_;
    std::optional<std::size_t> field_;  ///< index of the field being judged
};

/// Returns |log(printed dot diameter / optimum)|. The optimum is a sixth of the spacing.
double dot_error(const PrintField& field) {
    const double wanted_mm = field.pattern.spacing_mm / 6;
    return std::abs(std::log(std::max(field.dot_mm, 1e-6) / wanted_mm));
}

/// For each spacing, chooses the readable patch whose printed dot diameter is closest to a sixth of
/// the spacing. The best patch overall is the chosen patch with the finest spacing, because it has
/// the most dots in view.
void choose_best(PrintCheck& check) {
    std::map<double, std::size_t> best;
    for (std::size_t i = 0; i < check.fields.size(); ++i) {
        const PrintField& field = check.fields[i];
        if (!field.is_patch || field.bad_fraction() > kGoodPatch) continue;
        const auto [place, is_new] = best.try_emplace(field.pattern.spacing_mm, i);
        if (!is_new && dot_error(field) < dot_error(check.fields[place->second])) place->second = i;
    }
    for (const auto& [spacing_mm, index] : best)
        check.best_per_spacing.push_back(index);
    if (!check.best_per_spacing.empty()) check.best = check.best_per_spacing.front();
}

}  // namespace

void rank_patches(CodeVariant code, PrintCheck& check) {
    choose_best(check);
    TestPageOptions usual;
    usual.code = code;
    for (const Sheet& sheet : make_test_page(usual).sheets) {
        const bool was_read = std::ranges::any_of(check.fields, [&](const PrintField& field) {
            return field.pattern.spacing_mm == sheet.pattern.spacing_mm &&
                   field.pattern.dot_mm == sheet.pattern.dot_mm;
        });
        if (!was_read) check.unread_patches.push_back(sheet.pattern);
    }
}

void add_findings(const CheckPrintOptions& options, PrintCheck& check) {
    std::vector<Finding> list;
    Findings findings(options, check, list);
    if (check.fields.empty()) {
        findings.judge_nothing_found();
    } else if (check.is_test_page) {
        findings.judge_scale(check.fields.front());
        findings.judge_test_page();
        findings.judge_as_a_whole(0);
    } else {
        findings.judge_sheets();
    }
    std::stable_partition(list.begin(), list.end(), is_fault);
    check.findings = std::move(list);
}

}  // namespace dotpose::calibrate
