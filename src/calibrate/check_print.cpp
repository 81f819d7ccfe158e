// Checks a print: locates tiles, joins them into fields, measures the cells of each field, and
// reports scale, sizes and faults.
#include "dotpose/tools/check_print.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "calibrate/print_cells.hpp"
#include "calibrate/print_field.hpp"
#include "calibrate/print_findings.hpp"
#include "calibrate/print_measures.hpp"
#include "calibrate/print_tiles.hpp"
#include "calibrate/print_view.hpp"
#include "dotpose/files/code_names.hpp"
#include "dotpose/files/sheet_file.hpp"
#include "dotpose/tools/test_page.hpp"

namespace dotpose {
namespace {

using namespace dotpose::calibrate;

/// Maximum ratio of the measured spacing to the spacing expected at the given resolution. The
/// resolution is ignored if the ratio is greater than this value or less than its reciprocal.
constexpr double kMaxSpacingRatio = 2;
constexpr std::size_t kMinFieldDots = 30;

/// Reports progress. The amount of work is not known in advance, so the reported total is always
/// kHalf steps more than the number of completed steps.
class Work {
  public:
    explicit Work(const CheckPrintOptions& options) : options_(options) {}
    void step() {
        ++done_;
        constexpr int kHalf = 300;
        if (options_.progress && !options_.progress(done_, done_ + kHalf)) {
            throw Error("stopped; nothing was written");
        }
    }

  private:
    const CheckPrintOptions& options_;
    int done_ = 0;
};

void validate(const CheckPrintOptions& options) {
    const Pattern& pattern = options.pattern;
    for (const double mm : {pattern.spacing_mm, pattern.displacement_mm, pattern.dot_mm}) {
        if (mm > 0 && std::isfinite(mm)) continue;
        throw BadArgument(fmt::format("a length of {:g} mm: it must be over 0", mm));
    }
    if (2 * pattern.displacement_mm >= pattern.spacing_mm) {
        throw BadArgument(
            fmt::format("a displacement of {:g} mm is too large for a spacing of "
                        "{:g} mm",
                        pattern.displacement_mm, pattern.spacing_mm));
    }
    if (!(options.ink_reflectance >= 0 && options.ink_reflectance <= 0.9)) {
        throw BadArgument(fmt::format("an ink reflectance of {:g}: it must be 0 to 0.9",
                                      options.ink_reflectance));
    }
    if (const auto& resolution = options.resolution) {
        for (const double dpi : {resolution->x_dpi, resolution->y_dpi}) {
            if (dpi > 0 && std::isfinite(dpi)) continue;
            throw BadArgument(fmt::format("a resolution of {:g} dpi: it must be over 0", dpi));
        }
    }
}

/// Returns the index of the sheet whose region contains the cell, or nullopt if there is no such
/// sheet.
std::optional<std::size_t> sheet_at(const CheckPrintOptions& options, Section section, Cell cell) {
    Sheet place;
    place.pattern.code = options.pattern.code;
    place.pattern.section = section;
    place.origin = cell;
    place.columns = place.rows = 1;
    const auto found = std::ranges::find_if(
        options.sheets, [&](const Sheet& sheet) { return overlap(sheet, place); });
    if (found == options.sheets.end()) return std::nullopt;
    return static_cast<std::size_t>(found - options.sheets.begin());
}

/// Sets the nominal pattern of a field. On test pages and known sheets, the cells identify the
/// pattern.
void identify(const Field& field, const CheckPrintOptions& options, PrintField& result) {
    result.pattern = options.pattern;
    for (const auto& tile : field.tiles) {
        if (!tile) continue;
        const Eigen::Vector2d& centre = tile->map.centre_cell;
        const Cell cell{static_cast<std::uint32_t>(std::max(centre.x(), 0.0)),
                        static_cast<std::uint32_t>(std::max(centre.y(), 0.0))};
        const auto patch = test_patch_at(options.pattern.code, cell);
        result.is_patch = patch.has_value();
        result.sheet = sheet_at(options, field.code.section, cell);
        if (patch) result.pattern = *patch;
        if (result.sheet) result.pattern = options.sheets[*result.sheet].pattern;
        // The centre of a tile may be in the page margin. The loop therefore continues until a tile
        // identifies the pattern.
        if (patch || result.sheet) break;
    }
    result.pattern.code = options.pattern.code;
    result.pattern.section = field.code.section;
}

/// Returns the mean spacing of the dots in a field, in px.
double spacing_px(const Field& field) {
    double sum = 0;
    int count = 0;
    for (const auto& tile : field.tiles) {
        if (!tile) continue;
        sum += tile->map.spacing_px();
        ++count;
    }
    return count > 0 ? sum / count : 0;
}

/// Returns the resolution, or nullopt if the spacing of the dots contradicts it.
std::optional<Resolution> plausible_resolution(const std::optional<Resolution>& resolution,
                                               const Pattern& pattern, const Field& field) {
    if (!resolution) return std::nullopt;
    const double px_per_mm = std::sqrt(resolution->x_dpi * resolution->y_dpi) / 25.4;
    const double scale = spacing_px(field) / (pattern.spacing_mm * px_per_mm);
    const bool is_plausible = scale < kMaxSpacingRatio && scale > 1 / kMaxSpacingRatio;
    return is_plausible ? resolution : std::nullopt;
}

}  // namespace

const char* name(FindingKind kind) {
    switch (kind) {
        case FindingKind::good:
            return "good";
        case FindingKind::scaled:
            return "scaled";
        case FindingKind::uneven_scale:
            return "uneven_scale";
        case FindingKind::rotated:
            return "rotated";
        case FindingKind::skewed:
            return "skewed";
        case FindingKind::distorted:
            return "distorted";
        case FindingKind::swollen:
            return "swollen";
        case FindingKind::thin:
            return "thin";
        case FindingKind::missing:
            return "missing";
        case FindingKind::covered:
            return "covered";
        case FindingKind::bits_wrong:
            return "bits_wrong";
        case FindingKind::too_coarse:
            return "too_coarse";
        case FindingKind::pale:
            return "pale";
        case FindingKind::no_resolution:
            return "no_resolution";
        case FindingKind::contradiction:
            return "contradiction";
        case FindingKind::repeated:
            return "repeated";
        case FindingKind::unknown_sheet:
            return "unknown_sheet";
        case FindingKind::unresolved:
            return "unresolved";
        case FindingKind::best_settings:
            return "best_settings";
    }
    return "";
}

double PrintField::bad_fraction() const {
    return std::min(covered_fraction() + missing_fraction() + merged_fraction() + wrong_fraction(),
                    1.0);
}

namespace {

/// If the fraction of wrong bits exceeds kSuspicious in any field, checks whether the page uses a
/// different code variant. In this case, the finding about the code variant replaces all other
/// findings, because the wrong code variant causes them.
void check_other_codes(const LocatedTiles& tiles, TileLocator& locator, PrintCheck& check) {
    constexpr double kSuspicious = 0.002;
    constexpr float kSure = 1e-3F;
    const bool is_suspicious = std::ranges::any_of(
        check.fields, [](const PrintField& field) { return field.wrong_fraction() > kSuspicious; });
    if (!is_suspicious) return;
    const CodeReader reader = locator.read_without_code(tiles);
    const CodeVariant code = reader.code();
    if (code == check.code || reader.evidence().p_wrong(code) > kSure) return;
    check.findings = {{FindingKind::bits_wrong, true, std::nullopt,
                       fmt::format("the page is of code {}, not {}: check it with --code {}",
                                   name(code), name(check.code), name(code))}};
}

/// A field, its cells and its measurements.
struct CollectedField {
    Field field;
    CellGrid grid;
    PrintField result;
};

/// Measures the cells of all fields.
std::vector<CollectedField> collect_fields(const ImageView& scan, const LocatedTiles& tiles,
                                           const CheckPrintOptions& options, const TileDone& done) {
    std::vector<CollectedField> collected;
    for (Field& field : join_tiles(tiles)) {
        PrintField result;
        identify(field, options, result);
        field.code.code = result.pattern.code;
        field.code.displacement = result.pattern.displacement_mm / result.pattern.spacing_mm;
        CellGrid grid = collect_cells(scan, tiles.tiling, field);
        collected.push_back({std::move(field), std::move(grid), std::move(result)});
        done();
    }
    return collected;
}

/// Returns the number of cells whose dot is correct in both fields.
int common_cells(const CellGrid& a, const CellGrid& b) {
    int count = 0;
    for (const SeenCell& cell : a.cells) {
        const std::int64_t i = std::int64_t{cell.x} - b.origin.x;
        const std::int64_t j = std::int64_t{cell.y} - b.origin.y;
        if (i < 0 || j < 0 || i >= b.columns || j >= b.rows) continue;
        count += cell.is_right() && b.at(static_cast<int>(i), static_cast<int>(j)).is_right();
    }
    return count;
}

/// Finds pairs of fields that show the same cells. `parts` and `check.fields` are in the same
/// order.
void find_repetitions(const std::vector<const CollectedField*>& parts, PrintCheck& check) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
        for (std::size_t j = i + 1; j < parts.size(); ++j) {
            if (parts[i]->field.code.section != parts[j]->field.code.section) continue;
            const int cells = common_cells(parts[i]->grid, parts[j]->grid);
            if (cells >= static_cast<int>(kMinFieldDots)) check.repeated.push_back({i, j, cells});
        }
    }
}

/// Measures all fields. The largest field determines whether the image is treated as a scan or as a
/// photo.
void measure_fields(const ImageView& scan, std::vector<CollectedField> collected,
                    const CheckPrintOptions& options, PrintCheck& check) {
    std::vector<Match> matches;
    for (const CollectedField& part : collected) {
        auto its = matches_of(part.grid, part.field, part.result.pattern);
        if (its.size() > matches.size()) matches = std::move(its);
    }
    check.resolution = options.resolution;
    if (options.resolution && matches.size() >= kMinFieldDots) {
        const Eigen::Vector2d middle_px(0.5 * (scan.width_px - 1), 0.5 * (scan.height_px - 1));
        check.camera = signs_of_camera(matches, middle_px);
    }
    std::vector<const CollectedField*> measured;
    for (CollectedField& part : collected) {
        auto resolution = plausible_resolution(options.resolution, part.result.pattern, part.field);
        if (!resolution || check.camera) check.resolution.reset();
        if (check.camera) resolution.reset();
        const Measuring measuring{scan, part.field, part.grid, resolution, options.ink_reflectance};
        if (measure_field(measuring, kMinFieldDots, part.result)) measured.push_back(&part);
    }
    std::ranges::stable_sort(measured, std::ranges::greater{},
                             [](const CollectedField* part) { return part->result.dots; });
    for (const CollectedField* part : measured)
        check.fields.push_back(part->result);
    find_repetitions(measured, check);
}

}  // namespace

PrintCheck check_print(const ImageView& scan, const CheckPrintOptions& asked) {
    validate(asked);
    PrintCheck check;
    CheckPrintOptions options = asked;
    check.is_photo = asked.is_photo;
    if (asked.is_photo) options.resolution.reset();
    Work work(asked);
    const TileDone done = [&work] { work.step(); };
    TileLocator locator(scan, asked.any_code ? std::nullopt : std::optional(asked.pattern.code),
                        done);
    const auto tiles = locator.locate();
    if (tiles) {
        check.code = options.pattern.code = locator.code().code();
        if (asked.any_code)
            check.code_p_wrong = double(locator.code().evidence().p_wrong(check.code));
        measure_fields(scan, collect_fields(scan, *tiles, options, done), options, check);
    }
    if (check.fields.empty()) {
        check.resolution.reset();
        check.is_mirrored = locator.is_mirrored();
    }
    check.is_test_page = std::ranges::any_of(check.fields, &PrintField::is_patch);
    if (check.is_test_page) rank_patches(options.pattern.code, check);
    add_findings(options, check);
    if (tiles && !asked.any_code) check_other_codes(*tiles, locator, check);
    return check;
}

}  // namespace dotpose
