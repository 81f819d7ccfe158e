// Computes grey levels from ink. A pixel has `kernel.per_pixel` sub-pixels per axis, and ink is
// drawn as the covered fraction of each sub-pixel. A weighted sum over sub-pixels, first along rows
// and then along columns, models lens blur, motion and the area of a pixel. Sub-rows are drawn in
// bands and added to the pixel rows to which they contribute, so no image larger than the frame is
// stored.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "simulate/ink.hpp"
#include "simulate/kernel.hpp"
#include "simulate/paper.hpp"
#include "simulate/raster.hpp"

namespace dotpose::simulate {
namespace {

// Number of pixels that are processed together with vector instructions.
constexpr std::size_t kLanes = 4;

// Computes the light in each pixel: the light of bare paper minus the light that ink absorbs. To
// save time, only the sub-pixels that contain ink, a few percent of all sub-pixels, are convolved
// with the kernel.
class Sensor {
  public:
    Sensor(const CameraModel& camera, const Kernel& kernel, const std::vector<float>& paper)
        : width_(static_cast<std::size_t>(camera.width_px)),
          height_(camera.height_px),
          border_(static_cast<std::size_t>(kernel.border_px)),
          kernel_(kernel),
          paper_(paper),
          // The length of a range is rounded up to a multiple of kLanes, and a range may begin at
          // any pixel. A range may therefore extend beyond the last pixel, so the row has kLanes
          // additional elements.
          row_(whole_lanes(width_ + 2 * border_ + kernel.taps) + kLanes),
          levels_(row_.size() * static_cast<std::size_t>(camera.height_px)) {
        collect_paper();
    }

    // Subtracts the light that the ink of a sub-row absorbs. Sub-row 0 is the top of the border.
    void absorb(int sub_row, std::span<const Raster::Spot> spots) {
        if (spots.empty()) return;
        const int row = sub_row / kernel_.per_pixel;
        gather(spots, paper_row(row));
        const auto phase = static_cast<std::size_t>(sub_row % kernel_.per_pixel);
        for (const Kernel::Moment& moment : kernel_.moments) {
            for (const Reach reach : reaches_)
                std::fill(row_.data() + reach.from, row_.data() + reach.to, 0.0F);
            spread(moment.x);
            for (const Reach reach : reaches_)
                add_row(row, moment.y[phase], reach);
        }
    }

    std::vector<float> levels() const {
        std::vector<float> inside(width_ * static_cast<std::size_t>(height_));
        const float* in = levels_.data() + (2 * border_);
        for (auto out = inside.begin(); out != inside.end(); in += row_.size())
            out = std::copy_n(in, width_, out);
        return inside;
    }

  private:
    // A range of elements of row_. Its length is a multiple of kLanes.
    struct Reach {
        std::size_t from, to;
    };

    static std::size_t whole_lanes(std::size_t count) {
        return (count + kLanes - 1) / kLanes * kLanes;
    }

    const float* paper_row(int row) const {
        return paper_.data() + (static_cast<std::size_t>(row) * (width_ + 2 * border_));
    }

    // Computes the light that the ink of a sub-row absorbs, and the ranges of row_ that this light
    // affects.
    void gather(std::span<const Raster::Spot> spots, const float* paper) {
        losses_.assign(spots.begin(), spots.end());
        reaches_.clear();
        for (Raster::Spot& loss : losses_) {
            for (float& light : loss.darkness)
                light *= paper[loss.pixel];
            // If the ranges of several pixels overlap or touch, they are merged into one range.
            if (reaches_.empty() || loss.pixel < reaches_.back().from ||
                loss.pixel > reaches_.back().to) {
                reaches_.push_back({loss.pixel, loss.pixel});
            }
            reaches_.back().to = std::max(reaches_.back().to, loss.pixel + kernel_.taps);
        }
        std::sort(reaches_.begin(), reaches_.end(),
                  [](Reach a, Reach b) { return a.from < b.from; });
        std::size_t last = 0;
        for (const Reach reach : reaches_) {
            Reach& before = reaches_[last];
            if (reach.from > before.from + whole_lanes(before.to - before.from)) {
                reaches_[++last] = reach;
            } else {
                before.to = std::max(before.to, reach.to);
            }
        }
        reaches_.resize(last + 1);
        for (Reach& reach : reaches_)
            reach.to = reach.from + whole_lanes(reach.to - reach.from);
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

    // The number of phases is a template parameter, so the compiler can unroll the loop over
    // phases, and each pixel is loaded and stored only once.
    template <std::size_t kPhases>
    void spread_phases(const Kernel::Weights& weights) {
        std::array<const float*, kPhases> of_phase;
        for (std::size_t phase = 0; phase < kPhases; ++phase)
            of_phase[phase] = weights[phase].data();
        for (const Raster::Spot& loss : losses_) {
            for (std::size_t j = 0; j < kernel_.taps; j += kLanes) {
                float* out = row_.data() + (loss.pixel + j);
                std::array<float, kLanes> light;
                std::copy_n(out, kLanes, light.begin());
                for (std::size_t phase = 0; phase < kPhases; ++phase) {
                    for (std::size_t lane = 0; lane < kLanes; ++lane)
                        light[lane] -= loss.darkness[phase] * of_phase[phase][j + lane];
                }
                std::copy_n(light.begin(), kLanes, out);
            }
        }
    }

    // Adds a range of row_ to all pixel rows that the kernel reaches from pixel row `row`, with one
    // weight for each of these rows. Row 0 is the top of the border.
    void add_row(int row, const std::vector<float>& weights, Reach reach) {
        const int top = row - 2 * kernel_.border_px;
        const int first = std::max(0, -top);
        const int end = std::min(2 * kernel_.border_px + 1, height_ - top);
        for (int j = first; j < end; ++j) {
            const float weight = weights[static_cast<std::size_t>(j)];
            float* level = levels_.data() + (static_cast<std::size_t>(top + j) * row_.size());
            for (std::size_t u = reach.from; u < reach.to; u += kLanes) {
                std::array<float, kLanes> sum;
                for (std::size_t lane = 0; lane < kLanes; ++lane)
                    sum[lane] = level[u + lane] + weight * row_[u + lane];
                std::copy_n(sum.begin(), kLanes, &level[u]);
            }
        }
    }

    // Convolves the light of bare paper with the kernel, first along rows and then along columns.
    // The light is constant over a pixel, so the weights of its sub-pixels can be summed first.
    void collect_paper() {
        const auto height = static_cast<std::size_t>(height_);
        const std::size_t reach = 2 * border_ + 1;
        const std::size_t stride = row_.size();
        // The light is preceded by zeros, because the taps of the first pixels read elements to the
        // left of the first pixel.
        std::vector<float> light(2 * border_ + stride);
        std::vector<float> along_rows(stride * (height + 2 * border_));
        for (const Kernel::Moment& moment : kernel_.moments) {
            const std::vector<float> along = whole_pixels(moment.x);
            std::vector<float> across = whole_pixels(moment.y);
            across.resize(reach);
            std::reverse(across.begin(), across.end());
            for (std::size_t row = 0; row < height + 2 * border_; ++row) {
                std::copy_n(paper_row(static_cast<int>(row)), width_ + 2 * border_,
                            light.data() + (2 * border_));
                // Tap j reads the pixel that is j pixels to the left.
                add_weighted(along_rows.data() + (row * stride), light.data() + (2 * border_), -1,
                             along, reach, stride);
            }
            for (std::size_t v = 0; v < height; ++v) {
                add_weighted(levels_.data() + (v * stride), along_rows.data() + (v * stride),
                             static_cast<std::ptrdiff_t>(stride), across, reach, stride);
            }
            std::fill(along_rows.begin(), along_rows.end(), 0.0F);
        }
    }

    // Adds to each out[u] the sum of weights[j] * in[u + j * step] over all j < count.
    static void add_weighted(float* out, const float* in, std::ptrdiff_t step,
                             const std::vector<float>& weights, std::size_t count,
                             std::size_t width) {
        constexpr std::size_t kChunk = 4 * kLanes;
        std::size_t u = 0;
        const auto add = [&]<std::size_t kWide>() {
            for (; u + kWide <= width; u += kWide) {
                std::array<float, kWide> sum;
                std::copy_n(out + u, kWide, sum.begin());
                const float* from = in + u;
                for (std::size_t j = 0; j < count; ++j, from += step) {
                    for (std::size_t i = 0; i < kWide; ++i)
                        sum[i] += weights[j] * from[i];
                }
                std::copy_n(sum.begin(), kWide, out + u);
            }
        };
        add.template operator()<kChunk>();
        add.template operator()<kLanes>();
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
    std::vector<Raster::Spot> losses_;  // absorbed light: darkness times the light of bare paper
    std::vector<Reach> reaches_;        // disjoint ranges, from left to right
    // One sub-row after the horizontal convolution. It has at least 2 * border_ elements on each
    // side of the image.
    std::vector<float> row_;
    // Light in each pixel, in rows with the same length as row_.
    std::vector<float> levels_;
};

// Samples the ink of a page image along the sub-rows of a frame.
class ImageRows {
  public:
    ImageRows(const PageImage& page, const View& view, const Imperfections& imperfections,
              const Kernel& kernel)
        : page_(page),
          view_(view),
          kernel_(kernel),
          darkest_(1 - imperfections.ink_reflectance),
          offsets_mm_(static_cast<std::size_t>(view.camera.width_px + 2 * kernel.border_px)) {}

    std::span<const Raster::Spot> row(int sub_row) {
        spots_.assign(offsets_mm_.size(), {});
        for (std::size_t i = 0; i < spots_.size(); ++i)
            spots_[i].pixel = i;
        const double v = pixel_of(sub_row);
        for (int phase = 0; phase < kernel_.per_pixel; ++phase) {
            view_.projection.offsets_from_row({pixel_of(phase), v}, offsets_mm_);
            for (std::size_t i = 0; i < spots_.size(); ++i)
                spots_[i].darkness[static_cast<std::size_t>(phase)] = darkness_at(offsets_mm_[i]);
        }
        std::erase_if(spots_, [](const Raster::Spot& spot) {
            return std::all_of(spot.darkness.begin(), spot.darkness.end(),
                               [](float dark) { return dark <= 0; });
        });
        return spots_;
    }

  private:
    // Returns the image coordinate of the centre of a sub-pixel, in px. Sub-pixel 0 is the first
    // sub-pixel of the left or top border.
    double pixel_of(int sub_pixel) const {
        return (sub_pixel + 0.5) / kernel_.per_pixel - 0.5 - kernel_.border_px;
    }

    float darkness_at(Vec2 offset_mm) const {
        // The centre of the first pixel is at coordinate 0, so half a pixel is subtracted.
        const double u = (page_.centre_mm.x + offset_mm.x) / page_.mm_per_px - 0.5;
        const double v = (page_.centre_mm.y + offset_mm.y) / page_.mm_per_px - 0.5;
        if (!(u > -1 && v > -1 && u < page_.image.width_px && v < page_.image.height_px)) return 0;
        const int left = static_cast<int>(std::floor(u));
        const int top = static_cast<int>(std::floor(v));
        const double right_fraction = u - left;
        const double lower_fraction = v - top;
        const double ink = (1 - lower_fraction) * ((1 - right_fraction) * ink_at(left, top) +
                                                   right_fraction * ink_at(left + 1, top)) +
                           lower_fraction * ((1 - right_fraction) * ink_at(left, top + 1) +
                                             right_fraction * ink_at(left + 1, top + 1));
        return static_cast<float>(darkest_ * ink);
    }

    double ink_at(int u, int v) const {
        const ImageView& image = page_.image;
        if (u < 0 || v < 0 || u >= image.width_px || v >= image.height_px) return 0;
        return (255 - image.row(v)[u]) / 255.0;
    }

    const PageImage& page_;
    const View& view_;
    const Kernel& kernel_;
    double darkest_;
    std::vector<Vec2> offsets_mm_;
    std::vector<Raster::Spot> spots_;
};

int sub_rows(const CameraModel& camera, const Kernel& kernel) {
    return (camera.height_px + 2 * kernel.border_px) * kernel.per_pixel;
}

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
    const int rows = sub_rows(camera, kernel);
    for (int top = 0; top < rows; top += kBandRows) {
        raster.draw_band(top);
        for (int row = top; row < std::min(top + kBandRows, rows); ++row) {
            sensor.absorb(row, raster.take_row(row - top));
        }
    }
    return sensor.levels();
}

std::vector<float> expose(const PageImage& page, const View& view,
                          const Imperfections& imperfections) {
    // The number of sub-pixels is chosen as for dots of the default pattern.
    const Kernel kernel = make_kernel(imperfections, Pattern{}.dot_mm / view.camera.mm_per_px);
    const std::vector<float> paper = bare_paper(view, Page{}, imperfections, kernel.border_px);
    ImageRows rows(page, view, imperfections, kernel);
    Sensor sensor(view.camera, kernel, paper);
    for (int row = 0; row < sub_rows(view.camera, kernel); ++row)
        sensor.absorb(row, rows.row(row));
    return sensor.levels();
}

namespace {

/// Returns the fixed-pattern offset of a pixel of the simulated sensor, in units of the standard
/// deviation over all pixels.
double offset_of_pixel(std::size_t index) {
    constexpr std::uint64_t kSensor = 0x5e4503;
    return Rng(kSensor, index).normal();
}

}  // namespace

GreyImage read_out(const std::vector<float>& levels, const CameraModel& camera,
                   const Imperfections& imperfections, Rng& rng) {
    GreyImage image;
    image.width_px = camera.width_px;
    image.height_px = camera.height_px;
    image.pixels.resize(levels.size());
    for (std::size_t i = 0; i < levels.size(); ++i) {
        double level = levels[i];
        if (imperfections.fixed_pattern > 0)
            level += imperfections.fixed_pattern * offset_of_pixel(i);
        if (imperfections.noise_sigma > 0) level += imperfections.noise_sigma * rng.normal();
        if (imperfections.salt_and_pepper > 0 && rng.uniform() < imperfections.salt_and_pepper) {
            level = rng.uniform() < 0.5 ? 0 : 255;
        }
        image.pixels[i] = static_cast<std::uint8_t>(std::clamp(level, 0.0, 255.0) + 0.5);
    }
    return image;
}

}  // namespace dotpose::simulate
