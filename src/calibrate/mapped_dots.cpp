#include "calibrate/mapped_dots.hpp"

#include <cstddef>

namespace dotpose::calibrate {

MappedDots mapped_dots(const Fix& fix, const PrintMap& map, const Trace& trace) {
    const CodeVariant code = trace.options.code;
    MappedDots result;
    if (fix.status != Status::ok) return result;
    const MapPage* page = find_page(map, code, {fix.cell, fix.section});
    if (page == nullptr) return result;
    constexpr std::size_t kMinDots = 20;
    // Minimum fraction of the dots in view that have an offset in the map.
    constexpr double kMinCovered = 0.75;
    result.page = page;
    result.noise = page->noise;
    const std::vector<LocatedDot> all = dots_read(trace);
    for (const LocatedDot& dot : all) {
        const auto index =
            page->index_of(moved(code, trace.decoding.place, dot.step.x, dot.step.y));
        if (!index || page->views[*index] == 0) continue;
        const DotOffset& offset = page->offsets[*index];
        result.dots.push_back({dot, {offset.x(), offset.y()}});
    }
    const auto covered = static_cast<double>(result.dots.size());
    result.use = result.dots.size() >= kMinDots && covered >= kMinCovered * double(all.size())
                     ? MapUse::used
                     : MapUse::not_covered;
    return result;
}

void add_map_error(const MapPage& page, Fix& fix) {
    const auto error = page.error_covariance({fix.cell, fix.section});
    for (std::size_t i = 0; i < error.size(); ++i) {
        for (std::size_t j = 0; j < error.size(); ++j)
            fix.covariance[i][j] += static_cast<float>(error[i][j]);
    }
}

bool is_same_print(double variance_with_map, double variance_without, double noise) {
    // Maximum ratio of the residual variance with the map to the residual variance without it. With
    // the map of a different print, the ratio is about 2.
    constexpr double kMaxRatio = 0.8;
    // Maximum ratio of the residual variance with the map to the noise variance. This limit is for
    // prints without jitter: their residuals contain only noise, so even the correct map hardly
    // reduces the variance.
    constexpr double kMaxNoise_2 = 2;
    return variance_with_map <= kMaxRatio * variance_without ||
           variance_with_map <= kMaxNoise_2 * noise * noise;
}

}  // namespace dotpose::calibrate
