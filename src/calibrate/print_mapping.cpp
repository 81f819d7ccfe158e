// Collects the observations of each page from its frames, and converts the solution to a print map.
#include "dotpose/tools/print_mapping.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "calibrate/located_frame.hpp"
#include "calibrate/map_solver.hpp"
#include "calibrate/map_start.hpp"
#include "dotpose/files/sheet_place.hpp"
#include "dotpose/locate.hpp"

namespace dotpose {
namespace {

using namespace dotpose::calibrate;

constexpr std::size_t kMinDots = 20;
/// Maximum ratio of the squared residuals with an earlier map to the squared residuals without it.
/// If the ratio is greater, the map belongs to a different print.
constexpr double kSamePrint = 0.8;

MapPage empty_page(const SheetEntry& entry) {
    const Sheet& sheet = entry.sheet;
    MapPage page;
    page.name = entry.name;
    page.code = sheet.pattern.code;
    page.section = sheet.pattern.section;
    page.origin = sheet.origin;
    page.columns = sheet.columns;
    page.rows = sheet.rows;
    page.spacing_mm = sheet.pattern.spacing_mm;
    return page;
}

EarlierOffsets earlier_of(const MapPage* page, const MapGrid& grid) {
    EarlierOffsets earlier;
    if (page == nullptr) return earlier;
    for (std::size_t i = 0; i < grid.dots(); ++i) {
        const DotOffset& offset = page->offsets[i];
        earlier.offset_mm.emplace_back(
            Eigen::Vector2d(offset.x() * grid.pitch_mm.x(), offset.y() * grid.pitch_mm.y())
                .cast<float>());
        earlier.views.push_back(page->views[i]);
    }
    return earlier;
}

std::int16_t to_q14(double spacings) {
    return static_cast<std::int16_t>(std::clamp(std::lround(spacings * 16384), -32767L, 32767L));
}

/// Converts the covariances from mm to spacings. If an earlier map is updated, adds the covariances
/// of its errors. The slowly varying errors of the earlier map remain in the result, but `found`
/// does not include them, because the equations assume that the errors of the earlier offsets are
/// independent.
MapErrors errors_of(const MapGrid& grid, const MapErrorGrid& found, const EarlierOffsets& earlier,
                    const MapPage& page) {
    if (!earlier.views.empty() && page.errors.nodes.empty()) return {};
    MapErrors errors{found.columns, found.rows, {}};
    for (std::size_t k = 0; k < found.covariances.size(); ++k) {
        const auto node = static_cast<int>(k);
        const auto cell = [&](int at, int nodes, int dots) {
            return static_cast<std::uint32_t>((2 * at * (dots - 1) + nodes - 1) /
                                              (2 * (nodes - 1)));
        };
        const Place place{{page.origin.x + cell(node % found.columns, found.columns, grid.columns),
                           page.origin.y + cell(node / found.columns, found.rows, grid.rows)},
                          page.section};
        const auto before = page.error_covariance(place);
        const Eigen::Vector3d unit(1 / grid.pitch_mm.x(), 1 / grid.pitch_mm.y(), 1);
        const Eigen::Matrix3d own = unit.asDiagonal() * found.covariances[k] * unit.asDiagonal();
        const auto at = [&](int i, int j) {
            return static_cast<float>(own(i, j) + before[std::size_t(i)][std::size_t(j)]);
        };
        errors.nodes.push_back({at(0, 0), at(0, 1), at(1, 1), at(0, 2), at(1, 2), at(2, 2)});
    }
    return errors;
}

void write_page(const MapGrid& grid, const EarlierOffsets& earlier, const MapSolution& solution,
                MapPage& page) {
    page.noise = solution.noise_mm / grid.pitch_mm.mean();
    page.jitter = solution.jitter_mm / grid.pitch_mm.mean();
    page.frames += static_cast<std::uint32_t>(solution.frames.size());
    page.errors = errors_of(grid, solution.errors, earlier, page);
    page.offsets.resize(grid.dots());
    page.views.resize(grid.dots());
    for (std::size_t i = 0; i < grid.dots(); ++i) {
        const Eigen::Vector2d offset = solution.offset_mm[i].cast<double>();
        page.offsets[i] = {to_q14(offset.x() / grid.pitch_mm.x()),
                           to_q14(offset.y() / grid.pitch_mm.y())};
        const auto before = earlier.views.empty() ? 0U : static_cast<unsigned>(earlier.views[i]);
        page.views[i] = static_cast<std::uint8_t>(std::min(before + solution.views[i], 255U));
    }
}

/// Returns the expected rms error of the map per axis, in spacings, over all dots that were seen.
double typical_error(const MapPage& map) {
    double sum = 0;
    double seen = 0;
    for (std::size_t i = 0; i < map.views.size(); ++i) {
        if (map.views[i] == 0) continue;
        const auto wide = static_cast<std::size_t>(map.columns);
        const Cell cell{map.origin.x + static_cast<std::uint32_t>(i % wide),
                        map.origin.y + static_cast<std::uint32_t>(i / wide)};
        const auto error = map.error_covariance({cell, map.section});
        sum += (error[0][0] + error[1][1]) / 2;
        ++seen;
    }
    return std::sqrt(sum / std::max(seen, 1.0));
}

MappedPage statistics_of(const MapPage& map, const MapGrid& grid, const MapSolution& solution,
                         std::size_t observations) {
    MappedPage page;
    page.name = map.name;
    page.error_mm = typical_error(map) * grid.pitch_mm.mean();
    page.frames = solution.frames.size();
    page.dots = grid.dots();
    page.observations = observations;
    page.outliers = solution.outliers;
    page.noise_mm = solution.noise_mm;
    page.jitter_mm = solution.jitter_mm;
    page.iterations = solution.iterations;
    double squares = 0;
    for (std::size_t i = 0; i < grid.dots(); ++i) {
        if (solution.views[i] == 0) continue;
        ++page.seen;
        squares += solution.offset_mm[i].cast<double>().squaredNorm() / 2;
    }
    const double all = squares / static_cast<double>(std::max<std::size_t>(page.seen, 1));
    page.slow_mm = std::sqrt(std::max(all - solution.jitter_mm * solution.jitter_mm, 0.0));
    // The mount is considered rigid if the relative frame-to-frame standard deviation of the scale
    // is less than this value.
    constexpr double kRigid = 2e-4;
    page.is_rigid = solution.view_sigma[0] < kRigid * solution.reach_mm;
    return page;
}

}  // namespace

struct PrintMapping::State {
    struct PageFrames {
        std::vector<MapSighting> frames;
        std::vector<MapObservation> observations;  ///< in px until `start_map` converts them to mm
    };

    explicit State(PrintMappingOptions given)
        : options(std::move(given)), pages(options.sheets.size()) {
        for (const SheetEntry& entry : options.sheets) {
            validate(entry);
            const Sheet& sheet = entry.sheet;
            known.push_back({sheet.pattern.code, sheet.pattern.section, sheet.origin,
                             static_cast<std::uint32_t>(sheet.columns),
                             static_cast<std::uint32_t>(sheet.rows)});
        }
        if (known.empty()) throw BadArgument("a print map needs a sheet file with sheets");
        require_pages(options.earlier, options.sheets);
        if (options.camera) validate(*options.camera);
        (void)locator.set_known(known, OtherSheets::possible);
    }

    PrintMappingOptions options;
    std::vector<PageFrames> pages;   ///< one element for each sheet, in the same order
    std::vector<KnownRegion> known;  ///< regions of the sheets, referenced by `locator`
    std::size_t frames = 0;
    Locator locator{DeviceOptions{}};
};

PrintMapping::PrintMapping(PrintMappingOptions options)
    : state_(std::make_unique<State>(std::move(options))) {}
PrintMapping::~PrintMapping() = default;
PrintMapping::PrintMapping(PrintMapping&&) noexcept = default;
PrintMapping& PrintMapping::operator=(PrintMapping&&) noexcept = default;

bool PrintMapping::add(const ImageView& image) {
    State& state = *state_;
    ++state.frames;
    DeviceOptions options;
    if (state.options.camera)
        use_camera(*state.options.camera, image.width_px, image.height_px, options);
    options.show_stages = true;
    const auto& sheets = state.options.sheets;
    for (std::size_t i = 0; i < sheets.size(); ++i) {
        const CodeVariant code = sheets[i].sheet.pattern.code;
        const bool was_tried = std::ranges::any_of(
            sheets.begin(), sheets.begin() + static_cast<std::ptrdiff_t>(i),
            [&](const SheetEntry& entry) { return entry.sheet.pattern.code == code; });
        if (was_tried) continue;
        options.code = code;
        state.locator.set_options(options);
        const Fix fix = state.locator.locate(image);
        const auto place = find_sheet(sheets, code, fix);
        if (!place) continue;
        State::PageFrames& page =
            state.pages[static_cast<std::size_t>(place->entry - sheets.data())];
        return add_sighting(fix, state.locator.trace(), empty_page(*place->entry), kMinDots,
                            page.frames, page.observations);
    }
    return false;
}

PrintMapResult PrintMapping::solve(const std::function<bool(double fraction)>& progress) {
    State& state = *state_;
    PrintMapResult result{state.options.earlier, {}, state.frames};
    const auto go_on = [&](double fraction) {
        if (progress && !progress(fraction)) throw Error("interrupted");
    };
    for (std::size_t i = 0; i < state.pages.size(); ++i) {
        State::PageFrames& seen = state.pages[i];
        if (seen.frames.size() < kMinFrames) continue;
        const SheetEntry& entry = state.options.sheets[i];
        const MapGrid grid = grid_of(entry);
        const auto known = std::ranges::find(result.map.pages, entry.name, &MapPage::name);
        const bool is_update = known != result.map.pages.end();
        const EarlierOffsets earlier = earlier_of(is_update ? &*known : nullptr, grid);
        MapSolution solution;
        const double reach_mm = start_map(grid, earlier, state.options.camera, seen.frames,
                                          seen.observations, solution);
        if (is_update && misfit(grid, earlier, reach_mm, seen.observations, solution) > kSamePrint)
            throw Error(fmt::format(
                "the frames contradict the earlier map of '{}': the print was moved or bent, or is "
                "another print; make a new map in another file",
                entry.name));
        solve_map(grid, earlier, reach_mm, seen.observations, solution, go_on);
        MapPage page = is_update ? *known : empty_page(entry);
        write_page(grid, earlier, solution, page);
        result.pages.push_back(statistics_of(page, grid, solution, seen.observations.size()));
        if (is_update) {
            *known = std::move(page);
        } else {
            result.map.pages.push_back(std::move(page));
        }
    }
    if (result.pages.empty())
        throw Error(fmt::format(
            "no page was seen in {} frames, of {} frames given: take frames all over a page of the "
            "sheet file, at different angles",
            kMinFrames, state.frames));
    return result;
}

}  // namespace dotpose
