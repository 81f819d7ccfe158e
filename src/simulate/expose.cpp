// From ink to grey levels. Ink is drawn on sub-pixels, `kernel.per_pixel` per pixel and axis: it
// covers each by its exact area, and lens, motion and the pixel's own area are one weighted sum
// over sub-pixels, taken along rows first and columns second. Sub-rows are drawn in bands and added
// to the pixel rows they reach, so that no image larger than the frame is kept.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "simulate/ink.hpp"
#include "simulate/kernel.hpp"
#include "simulate/paper.hpp"
#include "simulate/raster.hpp"

namespace dotpose::simulate {
namespace {

// Collects light in pixels: that of bare paper, less what ink takes away. Ink covers a few percent
// of the sub-pixels, so only those are spread over the pixels they reach.
class Sensor {
  public:
    Sensor(const CameraModel& camera, const Kernel& kernel, const std::vector<float>& paper)
        : width_(static_cast<std::size_t>(camera.width_px)),
          height_(camera.height_px),
          border_(static_cast<std::size_t>(kernel.border_px)),
          kernel_(kernel),
          paper_(paper),
          levels_(width_ * static_cast<std::size_t>(camera.height_px)),
          row_(width_ + 2 * border_ + kernel.taps) {
        collect_paper();
    }

    // Takes away the light that ink absorbs in a sub-row, counted from the top of the border.
    void absorb(int sub_row, const std::vector<Raster::Spot>& spots) {
        if (spots.empty()) return;
        const int row = sub_row / kernel_.per_pixel;
        gather(spots, paper_row(row));
        const auto phase = static_cast<std::size_t>(sub_row % kernel_.per_pixel);
        for (const Kernel::Moment& moment : kernel_.moments) {
            for (const Reach reach : reaches_)
                std::fill(&row_[reach.from], &row_[reach.to], 0.0F);
            spread(moment.x);
            for (const Reach reach : reaches_)
                add_row(row, moment.y[phase], reach);
        }
    }

    std::vector<float> take_levels() { return std::move(levels_); }

  private:
    const float* paper_row(int row) const {
        return &paper_[static_cast<std::size_t>(row) * (width_ + 2 * border_)];
    }

    // Light lost in the sub-pixels of one pixel; 0 where there is no ink.
    struct Loss {
        std::size_t column;
        std::array<float, Kernel::kMaxPerPixel> light;
    };
    // Elements of row_.
    struct Reach {
        std::size_t from, to;
    };

    // Sorts spots into pixels, and finds the parts of row_ that these reach.
    void gather(const std::vector<Raster::Spot>& spots, const float* paper) {
        losses_.clear();
        reaches_.clear();
        for (const Raster::Spot spot : spots) {
            const auto column = static_cast<std::size_t>(spot.x / kernel_.per_pixel);
            if (losses_.empty() || losses_.back().column != column) {
                losses_.push_back({column, {}});
                reaches_.push_back({column, column + kernel_.taps});
            }
            losses_.back().light[static_cast<std::size_t>(spot.x % kernel_.per_pixel)] =
                spot.darkness * paper[column];
        }
        std::sort(reaches_.begin(), reaches_.end(),
                  [](Reach a, Reach b) { return a.from < b.from; });
        std::size_t last = 0;
        for (const Reach reach : reaches_) {
            if (reach.from > reaches_[last].to) reaches_[++last] = reach;
            reaches_[last].to = reach.to;
        }
        reaches_.resize(last + 1);
    }

    void spread(const Kernel::Weights& weights) {
        switch (kernel_.per_pixel) {
            case 2:
                return spread_phases<2>(weights);
            case 4:
                return spread_phases<4>(weights);
            default:
                return spread_phases<8>(weights);
        }
    }

    // The number of phases is known to the compiler, so that a pixel is loaded and stored once.
    template <std::size_t kPhases>
    void spread_phases(const Kernel::Weights& weights) {
        std::array<const float*, kPhases> of_phase;
        for (std::size_t phase = 0; phase < kPhases; ++phase)
            of_phase[phase] = weights[phase].data();
        for (const Loss& loss : losses_) {
            float* out = &row_[loss.column];
            for (std::size_t j = 0; j < kernel_.taps; ++j) {
                float light = out[j];
                for (std::size_t phase = 0; phase < kPhases; ++phase)
                    light -= loss.light[phase] * of_phase[phase][j];
                out[j] = light;
            }
        }
    }

    // Adds a part of row_ to the pixel rows that row `row`, counted from the edge of the border,
    // reaches.
    void add_row(int row, const std::vector<float>& weights, Reach reach) {
        const std::size_t from = std::max(reach.from, 2 * border_);
        const std::size_t to = std::min(reach.to, 2 * border_ + width_);
        if (from >= to) return;
        const float* in = &row_[from];
        int v = row - 2 * kernel_.border_px;
        for (std::size_t j = 0; j <= 2 * border_; ++j, ++v) {
            if (v < 0 || v >= height_) continue;
            float* out = &levels_[static_cast<std::size_t>(v) * width_ + from - 2 * border_];
            for (std::size_t u = 0; u < to - from; ++u)
                out[u] += weights[j] * in[u];
        }
    }

    // The paper is constant over each pixel, so the sub-pixels' weights are summed.
    void collect_paper() {
        for (const Kernel::Moment& moment : kernel_.moments) {
            const std::vector<float> along = whole_pixels(moment.x);
            const std::vector<float> across = whole_pixels(moment.y);
            for (int row = 0; row < height_ + 2 * kernel_.border_px; ++row) {
                const float* in = paper_row(row);
                std::fill(row_.begin(), row_.end(), 0.0F);
                for (std::size_t j = 0; j <= 2 * border_; ++j) {
                    float* out = &row_[j];
                    for (std::size_t u = 0; u < width_ + 2 * border_; ++u)
                        out[u] += along[j] * in[u];
                }
                add_row(row, across, {0, row_.size()});
            }
        }
    }

    static std::vector<float> whole_pixels(const Kernel::Weights& weights) {
        std::vector<float> sum(weights.front().size());
        for (const std::vector<float>& phase : weights) {
            for (std::size_t j = 0; j < sum.size(); ++j)
                sum[j] += phase[j];
        }
        return sum;
    }

    std::size_t width_;
    int height_;
    std::size_t border_;
    const Kernel& kernel_;
    const std::vector<float>& paper_;
    std::vector<float> levels_;
    std::vector<Loss> losses_;
    std::vector<Reach> reaches_;  // apart from each other, from left to right
    std::vector<float> row_;      // one sub-row spread over pixels, with two borders on each side
};

}  // namespace

std::vector<float> expose(const Ink& ink, const View& view, const Page& page,
                          const Imperfections& imperfections) {
    const CameraModel& camera = view.camera;
    const Kernel kernel = make_kernel(imperfections, page.pattern.dot_mm / camera.mm_per_px);
    const std::vector<float> paper = bare_paper(view, page, imperfections, kernel.border_px);

    constexpr int kBandRows = 64;
    Raster raster(ink, {.per_pixel = kernel.per_pixel,
                        .border_px = kernel.border_px,
                        .width = (camera.width_px + 2 * kernel.border_px) * kernel.per_pixel,
                        .band_rows = kBandRows});
    Sensor sensor(camera, kernel, paper);
    const int sub_rows = (camera.height_px + 2 * kernel.border_px) * kernel.per_pixel;
    for (int top = 0; top < sub_rows; top += kBandRows) {
        raster.draw_band(top);
        for (int row = top; row < std::min(top + kBandRows, sub_rows); ++row) {
            sensor.absorb(row, raster.take_row(row - top));
        }
    }
    return sensor.take_levels();
}

GreyImage read_out(const std::vector<float>& levels, const CameraModel& camera,
                   const Imperfections& imperfections, Rng& rng) {
    GreyImage image;
    image.width_px = camera.width_px;
    image.height_px = camera.height_px;
    image.pixels.reserve(levels.size());
    for (const float exact : levels) {
        double level = exact;
        if (imperfections.noise_sigma > 0) level += imperfections.noise_sigma * rng.normal();
        if (imperfections.salt_and_pepper > 0 && rng.uniform() < imperfections.salt_and_pepper) {
            level = rng.uniform() < 0.5 ? 0 : 255;
        }
        image.pixels.push_back(static_cast<std::uint8_t>(std::clamp(level, 0.0, 255.0) + 0.5));
    }
    return image;
}

}  // namespace dotpose::simulate
