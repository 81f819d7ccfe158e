#include "calibrate/print_anchors.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace dotpose::calibrate {
namespace {

constexpr double kTileCells = 24;
constexpr int kLargestTile_px = 2048;
/// Spacing below which crops are magnified.
constexpr double kSmallSpacing_px = 9;
/// Number of crops from which the spacing is known well enough.
constexpr std::size_t kEnoughProbes = 40;
/// Number of pixels in the first crops of one kind, spread over the page.
constexpr int kFirstLook_px = 8'000'000;

/// Side of a crop that is tried, and its magnification; at least 8 cells must fit.
struct Probe {
    int side_px = 0;
    int zoom = 1;
};
constexpr std::array kProbes = {Probe{256, 1}, Probe{160, 2}, Probe{768, 1},
                                Probe{kLargestTile_px, 1}};

}  // namespace

CropLocator::CropLocator(const ImageView& scan, std::optional<Profile> profile)
    : scan_(scan), reader_(profile) {}

void CropLocator::use_effort(Effort effort) {
    Options options = locator_.options();
    options.effort = effort;
    locator_.set_options(options);
}

std::optional<Tiling> CropLocator::choose_tiling(const CropDone& done) {
    for (const bool thorough : {true, false}) {
        // First some crops are located with full effort; if they show nothing, all crops with less.
        use_effort(thorough ? Effort::twice : Effort::once);
        for (const Probe& probe : kProbes) {
            zoom_ = probe.zoom;
            const Tiling tiling(scan_.width_px, scan_.height_px, probe.side_px);
            const int first_look =
                kFirstLook_px / (probe.side_px * probe.side_px * probe.zoom * probe.zoom);
            const int step = thorough ? std::max(tiling.count() / first_look, 1) : 1;
            const double spacing_px = probe_spacing_px(tiling, step, done);
            if (spacing_px == 0) continue;
            use_effort(Effort::twice);
            zoom_ = spacing_px < kSmallSpacing_px ? 2 : 1;
            const int side_px = static_cast<int>(std::lround(kTileCells * spacing_px));
            return Tiling(scan_.width_px, scan_.height_px, std::min(side_px, kLargestTile_px));
        }
    }
    return std::nullopt;
}

/// Returns the median spacing in every `step`-th tile that shows a pattern; 0 if none does.
double CropLocator::probe_spacing_px(const Tiling& tiling, int step, const CropDone& done) {
    std::vector<double> spacings_px;
    for (int tile = 0; tile < tiling.count() && spacings_px.size() < kEnoughProbes; tile += step) {
        const auto anchor = locate_in(tiling.rect(tile));
        if (anchor) spacings_px.push_back(anchor->map.spacing_px());
        done();
    }
    if (spacings_px.empty()) return 0;
    const auto middle = spacings_px.begin() + static_cast<long>(spacings_px.size() / 2);
    std::ranges::nth_element(spacings_px, middle);
    return *middle;
}

std::vector<Anchor> CropLocator::find_anchors(const Tiling& tiling, const CropDone& done) {
    std::vector<Anchor> anchors;
    const int around_px = tiling.side_px / 8;
    for (int tile = 0; tile < tiling.count(); ++tile) {
        if ((tile % tiling.columns + tile / tiling.columns) % 2 != 0) continue;
        const PixelRect rect = tiling.rect(tile);
        auto anchor =
            locate_in({std::max(rect.u_begin - around_px, 0), std::max(rect.v_begin - around_px, 0),
                       std::min(rect.u_end + around_px, scan_.width_px),
                       std::min(rect.v_end + around_px, scan_.height_px)});
        if (anchor) {
            anchor->tile = tile;
            anchors.push_back(*anchor);
        }
        done();
    }
    return anchors;
}

std::optional<Anchor> CropLocator::locate_in(const PixelRect& rect) {
    const Fix fix = reader_.locate(magnified(rect), locator_);
    if (fix.status != Status::ok) return std::nullopt;
    constexpr double kQ24 = 1 << 24;
    const PlaneFromImage plane = locator_.trace().pattern_from_image;
    Eigen::Matrix2d cells_per_px;
    cells_per_px << plane.du_q24.x, plane.dv_q24.x, plane.du_q24.y, plane.dv_q24.y;
    cells_per_px *= zoom_ / kQ24;
    Anchor anchor;
    anchor.map.centre_px = rect.centre_px();
    anchor.map.centre_cell = {fix.x_grid(), fix.y_grid()};
    anchor.map.px_per_cell = cells_per_px.inverse();
    anchor.section = fix.section;
    return anchor;
}

/// Returns the crop magnified by `zoom_`, with interpolated pixels.
ImageView CropLocator::magnified(const PixelRect& rect) {
    const int width = rect.u_end - rect.u_begin;
    const int height = rect.v_end - rect.v_begin;
    if (zoom_ == 1) {
        return {scan_.row(rect.v_begin) + rect.u_begin, width, height, scan_.stride_bytes};
    }
    magnified_.resize(static_cast<std::size_t>(width * height * zoom_ * zoom_));
    auto out = magnified_.begin();
    const auto split = [this](int k, int count, int& first, double& share) {
        const double place = std::clamp((k + 0.5) / zoom_ - 0.5, 0.0, count - 1.0);
        first = std::min(static_cast<int>(place), std::max(count - 2, 0));
        share = place - first;
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
