// From ink to grey levels. Ink is drawn on sub-pixels, `kernel.per_pixel` per pixel and axis: it
// covers each by its exact area, and lens, motion and the pixel's own area are one weighted sum
// over sub-pixels, taken along rows first and columns second. Sub-rows are drawn in bands and added
// to the pixel rows they reach, so that no image larger than the frame is kept.
#include <algorithm>
#include <cmath>
#include <utility>

#include "simulate/ink.hpp"
#include "simulate/kernel.hpp"
#include "simulate/raster.hpp"

namespace dotpose::simulate {
namespace {

// Reflectance of bare paper: noise at the nodes of a lattice on the page, linear in between.
class Texture {
  public:
    Texture(const Page& page, const View& view, double deviation)
        : seed_(page.seed),
          nodes_per_mm_(1 / (Imperfections::kGrain_px * view.camera.mm_per_px)),
          origin_{x_grid(view.pose) * page.pattern.spacing_mm * nodes_per_mm_,
                  y_grid(view.pose) * page.pattern.spacing_mm * nodes_per_mm_},
          // Uniform in [-1, 1) has deviation 1/sqrt(3), and interpolation leaves 2/3 of it.
          amplitude_(deviation * std::sqrt(3.0) * 1.5) {}

    double at(Vec2 offset_mm) const {
        const double x = origin_.x + offset_mm.x * nodes_per_mm_;
        const double y = origin_.y + offset_mm.y * nodes_per_mm_;
        const double column = std::floor(x);
        const double row = std::floor(y);
        const double fx = x - column;
        const double fy = y - row;
        const auto i = static_cast<std::int64_t>(column);
        const auto j = static_cast<std::int64_t>(row);
        const double top = node(i, j) * (1 - fx) + node(i + 1, j) * fx;
        const double bottom = node(i, j + 1) * (1 - fx) + node(i + 1, j + 1) * fx;
        return 1 + amplitude_ * (top * (1 - fy) + bottom * fy);
    }

  private:
    double node(std::int64_t i, std::int64_t j) const {
        const std::uint64_t place =
            (static_cast<std::uint64_t>(i) << 32) ^ static_cast<std::uint64_t>(j);
        return static_cast<double>(scramble(scramble(seed_ + 1) ^ place) >> 11) * 0x1p-52 - 1;
    }

    std::uint64_t seed_;
    double nodes_per_mm_;
    Vec2 origin_;
    double amplitude_;
};

// Grey level of bare paper in each pixel of the frame and of `border_px` pixels around it. Constant
// over a pixel: light and texture change by less than 1 % from one to the next.
std::vector<float> bare_paper(const View& view, const Page& page,
                              const Imperfections& imperfections, int border_px) {
    const CameraModel& camera = view.camera;
    const Vec2 centre{(camera.width_px - 1) / 2.0, (camera.height_px - 1) / 2.0};
    const double corner_square = std::max(centre.x * centre.x + centre.y * centre.y, 1.0);
    const Vec2 towards{std::cos(imperfections.fall_direction_rad),
                       std::sin(imperfections.fall_direction_rad)};
    const double across_px =
        std::abs(towards.x) * camera.width_px + std::abs(towards.y) * camera.height_px;
    const Texture texture(page, view, imperfections.texture);

    std::vector<float> paper;
    paper.reserve(static_cast<std::size_t>(camera.width_px + 2 * border_px) *
                  static_cast<std::size_t>(camera.height_px + 2 * border_px));
    for (int v = -border_px; v < camera.height_px + border_px; ++v) {
        for (int u = -border_px; u < camera.width_px + border_px; ++u) {
            const double dx = u - centre.x;
            const double dy = v - centre.y;
            const double shade = imperfections.vignetting * (dx * dx + dy * dy) / corner_square;
            const double slope = imperfections.fall * (dx * towards.x + dy * towards.y) / across_px;
            double level =
                imperfections.paper_level * std::max(0.0, 1 - shade) * std::max(0.0, 1 - slope);
            if (imperfections.texture > 0) {
                level *= texture.at(view.projection.offset_from_pixel({1.0 * u, 1.0 * v}));
            }
            paper.push_back(static_cast<float>(level));
        }
    }
    return paper;
}

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
          row_(width_ + 4 * border_) {
        collect_paper();
    }

    // Takes away the light that ink absorbs in a sub-row, counted from the top of the border.
    void absorb(int sub_row, const std::vector<Raster::Spot>& spots) {
        if (spots.empty()) return;
        const int row = sub_row / kernel_.per_pixel;
        const float* paper = paper_row(row);
        const auto phase = static_cast<std::size_t>(sub_row % kernel_.per_pixel);
        for (const Kernel::Moment& moment : kernel_.moments) {
            std::fill(row_.begin(), row_.end(), 0.0F);
            for (const Raster::Spot spot : spots) {
                const auto column = static_cast<std::size_t>(spot.x / kernel_.per_pixel);
                const std::vector<float>& weights =
                    moment.x[static_cast<std::size_t>(spot.x % kernel_.per_pixel)];
                const float light = spot.darkness * paper[column];
                float* out = &row_[column];
                for (std::size_t j = 0; j < weights.size(); ++j)
                    out[j] -= light * weights[j];
            }
            add_row(row, moment.y[phase]);
        }
    }

    std::vector<float> take_levels() { return std::move(levels_); }

  private:
    const float* paper_row(int row) const {
        return &paper_[static_cast<std::size_t>(row) * (width_ + 2 * border_)];
    }

    // Adds row_ to the pixel rows that row `row`, counted from the edge of the border, reaches.
    void add_row(int row, const std::vector<float>& weights) {
        const float* in = &row_[2 * border_];
        int v = row - 2 * kernel_.border_px;
        for (const float weight : weights) {
            if (v >= 0 && v < height_) {
                float* out = &levels_[static_cast<std::size_t>(v) * width_];
                for (std::size_t u = 0; u < width_; ++u)
                    out[u] += weight * in[u];
            }
            ++v;
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
                for (std::size_t j = 0; j < along.size(); ++j) {
                    float* out = &row_[j];
                    for (std::size_t u = 0; u < width_ + 2 * border_; ++u)
                        out[u] += along[j] * in[u];
                }
                add_row(row, across);
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
    std::vector<float> row_;  // one sub-row spread over pixels, with two borders on each side
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
        image.pixels.push_back(
            static_cast<std::uint8_t>(std::lround(std::clamp(level, 0.0, 255.0))));
    }
    return image;
}

}  // namespace dotpose::simulate
