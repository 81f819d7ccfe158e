#include "calibrate/print_tiles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "calibrate/median.hpp"

namespace dotpose::calibrate {
namespace {

constexpr double kTileCells = 24;
constexpr int kMaxTile_px = 2048;
/// Spacing in the scan below which tiles are magnified before they are located. Includes a safety
/// margin above 6 px, the minimum spacing for `locate`.
constexpr double kSmallSpacing_px = 9;
/// Number of crops that suffice to determine the spacing or the code.
constexpr std::size_t kEnoughProbes = 40;
/// Approximate maximum of the total number of pixels in a sample of crops, after magnification. The
/// crops in a sample have the same size and are spread over the page.
constexpr int kSample_px = 8'000'000;

/// Side and magnification of a crop. A crop must contain at least 8 x 8 cells.
struct Probe {
    int side_px = 0;
    int zoom = 1;
};
constexpr std::array kProbes = {Probe{256, 1}, Probe{160, 2}, Probe{768, 1}, Probe{kMaxTile_px, 1}};

}  // namespace

TileLocator::TileLocator(const ImageView& scan, std::optional<CodeVariant> code, TileDone done)
    : scan_(scan), reader_(code), done_(std::move(done)) {
    DeviceOptions options;
    options.show_stages = true;
    locator_.set_options(options);
}

void TileLocator::use_effort(Effort effort) {
    DeviceOptions options = locator_.options();
    options.effort = effort;
    locator_.set_options(options);
}

std::optional<LocatedTiles> TileLocator::locate() {
    const std::optional<LocatedTile> whole = locate_whole();
    const double spacing_px = whole ? whole->map.spacing_px() : find_spacing_px();
    if (spacing_px == 0) return std::nullopt;
    use_effort(Effort::twice);
    zoom_ = spacing_px < kSmallSpacing_px ? 2 : 1;
    const int side_px = static_cast<int>(std::lround(kTileCells * spacing_px));
    const auto tiles_of = [this](int side) {
        return LocatedTiles{Tiling(scan_.width_px, scan_.height_px, side), {}};
    };
    LocatedTiles result = tiles_of(std::min(side_px, kMaxTile_px));
    for (int tile = 0; tile < result.tiling.count(); ++tile) {
        auto located = locate_in(result.tiling.overlapping_rect(tile));
        if (!located) continue;
        located->tile = tile;
        result.located.push_back(*located);
    }
    if (!whole || !result.located.empty()) return result;
    result = tiles_of(std::max(scan_.width_px, scan_.height_px));
    result.located.push_back(*whole);
    return result;
}

/// Locates the whole scan in one call, unless it is too large for `locate`.
std::optional<LocatedTile> TileLocator::locate_whole() {
    if (std::max(scan_.width_px, scan_.height_px) > kMaxFrameSide_px) return std::nullopt;
    return locate_in({0, 0, scan_.width_px, scan_.height_px});
}

/// Measures the spacing of the pattern by locating crops of the scan. Returns 0 if no crop shows
/// the pattern.
double TileLocator::find_spacing_px() {
    for (const bool thorough : {true, false}) {
        // The first pass locates some crops with `Effort::twice`. If none of these crops has a fix,
        // the second pass locates all crops with `Effort::once`.
        use_effort(thorough ? Effort::twice : Effort::once);
        for (const Probe& probe : kProbes) {
            zoom_ = probe.zoom;
            const Tiling tiling(scan_.width_px, scan_.height_px, probe.side_px);
            const int sample_count =
                kSample_px / (probe.side_px * probe.side_px * probe.zoom * probe.zoom);
            const int step = thorough ? std::max(tiling.count() / sample_count, 1) : 1;
            const double spacing_px = probe_spacing_px(tiling, step);
            if (spacing_px > 0 || is_mirrored_) return spacing_px;
        }
    }
    return 0;
}

/// Locates every `step`-th tile, until kEnoughProbes tiles show the pattern. Returns the median
/// spacing of these tiles, or 0 if no tile shows the pattern.
double TileLocator::probe_spacing_px(const Tiling& tiling, int step) {
    std::vector<double> spacings_px;
    for (int tile = 0; tile < tiling.count() && spacings_px.size() < kEnoughProbes; tile += step) {
        const auto located = locate_in(tiling.rect(tile));
        if (located) spacings_px.push_back(located->map.spacing_px());
    }
    if (spacings_px.empty()) return 0;
    return upper_median(std::move(spacings_px));
}

CodeReader TileLocator::read_without_code(const LocatedTiles& tiles) {
    CodeReader reader;
    const std::size_t step = std::max<std::size_t>(tiles.located.size() / kEnoughProbes, 1);
    for (std::size_t i = 0; i < tiles.located.size(); i += step) {
        const PixelRect rect = tiles.tiling.overlapping_rect(tiles.located[i].tile);
        (void)reader.locate(magnified(rect), locator_);
        done_();
    }
    return reader;
}

std::optional<LocatedTile> TileLocator::locate_in(const PixelRect& rect) {
    const Fix fix = reader_.locate(magnified(rect), locator_);
    done_();
    is_mirrored_ = is_mirrored_ || fix.status == Status::mirrored;
    if (!fix) return std::nullopt;
    const Eigen::Vector2d first_px(rect.u_begin, rect.v_begin);
    LocatedTile located;
    located.map = TileMap::of(fix, first_px, zoom_);
    located.section = fix.section;
    const Trace trace = locator_.trace();
    std::vector<Eigen::Vector2d> dots_px;
    for (const GridCell& cell : trace.grid.cells) {
        if (!cell.has_dot()) continue;
        dots_px.push_back(in_scan(trace.dots[cell.dot].centre_q8, first_px, zoom_));
    }
    located.levels = measure_levels(scan_, located.map, dots_px);
    return located;
}

/// Returns a crop magnified by `zoom_`, with bilinear interpolation.
ImageView TileLocator::magnified(const PixelRect& rect) {
    const int width = rect.u_end - rect.u_begin;
    const int height = rect.v_end - rect.v_begin;
    if (zoom_ == 1) {
        return {scan_.row(rect.v_begin) + rect.u_begin, width, height, scan_.stride_bytes};
    }
    magnified_.resize(static_cast<std::size_t>(width * height * zoom_ * zoom_));
    auto out = magnified_.begin();
    const auto split = [this](int k, int count, int& first, double& fraction) {
        const double place = std::clamp((k + 0.5) / zoom_ - 0.5, 0.0, count - 1.0);
        first = std::min(static_cast<int>(place), std::max(count - 2, 0));
        fraction = place - first;
    };
    for (int y = 0; y < height * zoom_; ++y) {
        int v = 0;
        double dv = 0;
        split(y, height, v, dv);
        const std::uint8_t* upper = scan_.row(rect.v_begin + v) + rect.u_begin;
        const std::uint8_t* lower = height > 1 ? upper + scan_.stride_bytes : upper;
        for (int x = 0; x < width * zoom_; ++x) {
            int u = 0;
            double du = 0;
            split(x, width, u, du);
            const int next = width > 1 ? u + 1 : u;
            const double top = upper[u] + du * (upper[next] - upper[u]);
            const double bottom = lower[u] + du * (lower[next] - lower[u]);
            *out++ = static_cast<std::uint8_t>(top + dv * (bottom - top) + 0.5);
        }
    }
    return {magnified_.data(), width * zoom_, height * zoom_, width * zoom_};
}

}  // namespace dotpose::calibrate
