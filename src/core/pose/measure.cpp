#include "core/pose/measure.hpp"

#include <array>
#include <optional>

#include "core/detect/surroundings.hpp"
#include "core/detect/undistort.hpp"
#include "core/lattice/regularity.hpp"
#include "core/math/exponential.hpp"
#include "core/math/plane.hpp"
#include "core/math/vectors.hpp"
#include "core/pose/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::measure;

constexpr int kMaxHalf_px = 24;

FixedVec rounded_px(FixedVec point_q8) {
    return {(point_q8.x + 128) >> 8, (point_q8.y + 128) >> 8};
}

/// A box of pixels. All bounds are inclusive.
struct Box {
    int left;
    int right;
    int top;
    int bottom;

    bool operator==(const Box&) const = default;
};

/// Half-width of the measurement window, and standard deviation of the fitted dot.
struct Window {
    int half_px = 0;
    std::int32_t sigma_q8 = 0;

    /// Computes both members from the spacing. `sigma_q8` is the standard deviation of a blurred
    /// dot, about a tenth of the spacing.
    explicit Window(std::int32_t spacing_q8)
        : half_px(std::min<std::int32_t>(
              std::max<std::int32_t>(spacing_q8 * tuned::kHalf_32nds / 32 + 255,
                                     tuned::kMinHalf_q8) /
                  256,
              kMaxHalf_px)),
          sigma_q8(std::max<std::int32_t>(spacing_q8 * tuned::kSigma_128ths / 128,
                                          tuned::kMinSigma_q8)) {}

    /// Crops a window to the pixels whose neighbours are all in the image. Returns nullopt if a
    /// neighbour of the central pixel is outside the image. Windows at the border are cropped
    /// instead of rejected, because the dots near the border determine angle and tilt most
    /// precisely.
    std::optional<Box> box_around(const ImageView& image, int u, int v) const {
        const int last_u = image.width_px - 2;
        const int last_v = image.height_px - 2;
        if (u < 1 || v < 1 || u > last_u || v > last_v) return {};
        return Box{std::max(u - half_px, 1), std::min(u + half_px, last_u),
                   std::max(v - half_px, 1), std::min(v + half_px, last_v)};
    }
};

constexpr int kMaxSide_px = 2 * kMaxHalf_px + 1;
/// Maximum number of columns, with padding for vectors of four.
constexpr std::size_t kMaxInFours = kMaxSide_px + 3;

/// Grey levels of a box, with defective pixels replaced.
class Patch {
  public:
    /// Loads the grey levels of a box, unless this box is already loaded.
    void load(const ImageView& image, const Box& box) {
        if (box == box_) return;
        box_ = box;
        for (int v = box.top; v <= box.bottom; ++v) {
            float* row = levels_[static_cast<std::size_t>(v - box.top)].data();
            for (int u = box.left; u <= box.right; ++u)
                *row++ = static_cast<float>(without_defect(image, u, v));
            std::fill_n(row, 3, 0.0F);
        }
    }
    const Box& box() const { return box_; }
    /// Returns a row, starting at the left side of the box. At least three zeros follow its last
    /// pixel.
    const float* row(int v) const { return levels_[static_cast<std::size_t>(v - box_.top)].data(); }
    float at(int u, int v) const { return row(v)[u - box_.left]; }

  private:
    Box box_{0, -1, 0, -1};
    std::array<std::array<float, kMaxInFours>, kMaxSide_px> levels_;
};

/// Linear model of the paper level around a dot, in grey levels, fitted to the window border.
struct BorderBackground {
    float middle = 0;
    float slope_u = 0;  ///< grey levels per px
    float slope_v = 0;
};

/// Computes the paper level from the window sides that are in the image. At least two sides are in
/// the image, because an image that shows a grid is larger than a window. If only one of two
/// opposite sides is in the image, the slope in this direction is set to 0.
BorderBackground border_background(const Patch& patch, FixedVec pixel, int half) {
    const auto side = [](bool is_inside, int first, int last, auto level) -> std::optional<float> {
        if (!is_inside) return {};
        float sum = 0;
        for (int i = first; i <= last; ++i)
            sum += level(i);
        return sum / static_cast<float>(last - first + 1);
    };
    const Box& box = patch.box();
    const auto column = [&](int at) {
        return side(at == pixel.x - half || at == pixel.x + half, box.top, box.bottom,
                    [&](int i) { return patch.at(at, i); });
    };
    const auto row = [&](int at) {
        return side(at == pixel.y - half || at == pixel.y + half, box.left, box.right,
                    [&](int i) { return patch.at(i, at); });
    };
    const std::array sides{column(box.left), column(box.right), row(box.top), row(box.bottom)};
    float sum = 0;
    float count = 0;
    for (const auto& level : sides) {
        sum += level.value_or(0);
        count += level ? 1.0F : 0.0F;
    }
    const auto slope = [half](const auto& from, const auto& to) {
        return from && to ? (*to - *from) / static_cast<float>(2 * half) : 0.0F;
    };
    return {sum / count, slope(sides[0], sides[1]), slope(sides[2], sides[3])};
}

/// Fits a Gaussian dot to a window with one Gauss-Newton step. The Gaussian has the sigma of the
/// window profile, and a small `offset` from the window centre. The vector d points from the window
/// centre to a pixel. With d and `offset` in units of sigma, the model of the darkness is
///
///     darkness(d) = height exp(-d^2 / 2) (1 + offset . d).
///
/// In a complete window, the result is the windowed centroid. In a window cropped by the image
/// border, the result is still unbiased.
class DotFit {
  public:
    /// Adds four pixels from a row. `profile` is exp(-d^2 / 2) at each pixel.
    void add(Four profile, Four darkness, Four x, float y) {
        const Four square = profile * profile;
        const Four dark = profile * darkness;
        add_each(one_x_y_xx_, square, square * x, square * y, square * x * x);
        add_each(xy_yy_dark_, square * x * y, square * y * y, dark, dark * x);
        add_each(dark_y_, dark * y, Four{}, Four{}, Four{});
    }

    struct Result {
        float height;
        float offset_x;
        float offset_y;
    };
    /// Returns the fitted height and offset. Returns nullopt if the height is not positive, because
    /// the window then contains no dark spot.
    std::optional<Result> solve() const {
        const float one = one_x_y_xx_[0];
        const float sum_x = one_x_y_xx_[1];
        const float sum_y = one_x_y_xx_[2];
        const float dark = xy_yy_dark_[2];
        const float x = sum_x / one;
        const float y = sum_y / one;
        const float xx = one_x_y_xx_[3] - x * sum_x;
        const float xy = xy_yy_dark_[0] - x * sum_y;
        const float yy = xy_yy_dark_[1] - y * sum_y;
        const float dark_x = xy_yy_dark_[3] - x * dark;
        const float dark_y = dark_y_[0] - y * dark;
        const float determinant = xx * yy - xy * xy;
        const float slope_x = (dark_x * yy - dark_y * xy) / determinant;
        const float slope_y = (dark_y * xx - dark_x * xy) / determinant;
        const float height = (dark - slope_x * sum_x - slope_y * sum_y) / one;
        if (!(height > 0)) return {};
        return Result{height, slope_x / height, slope_y / height};
    }

  private:
    // Sums of 1, x, y, x^2, xy and y^2, weighted by the squared profile, followed by sums of the
    // darkness, the darkness times x and the darkness times y, weighted by the profile.
    Four one_x_y_xx_{};
    Four xy_yy_dark_{};
    Four dark_y_{};
};

/// Window profile along one axis. `distance` is the distance d from the window centre, in units of
/// sigma. `profile` is exp(-d^2 / 2). Three zeros follow the last element of each array, because
/// the values are loaded as vectors of four.
struct AxisProfile {
    using Values = std::array<float, kMaxInFours>;
    Values distance;
    Values profile;
    Values from_pixel;  ///< distance from the central pixel, in px

    AxisProfile(int first, int last, int pixel, std::int32_t middle_q8, std::int32_t sigma_q8) {
        std::size_t count = 0;
        for (int i = first; i <= last; ++i, ++count) {
            const float d = static_cast<float>(i * 256 - middle_q8) / static_cast<float>(sigma_q8);
            distance[count] = d;
            profile[count] = natural_exp(-d * d / 2);
            from_pixel[count] = static_cast<float>(i - pixel);
        }
        for (Values* values : {&distance, &profile, &from_pixel})
            std::fill_n(values->begin() + static_cast<std::ptrdiff_t>(count), 3, 0.0F);
    }
};

DotFit fit_dot(const Patch& patch, const BorderBackground& light, std::int32_t sigma_q8,
               FixedVec middle_q8) {
    const Box& box = patch.box();
    const FixedVec pixel = rounded_px(middle_q8);
    const AxisProfile along_u(box.left, box.right, pixel.x, middle_q8.x, sigma_q8);
    const AxisProfile along_v(box.top, box.bottom, pixel.y, middle_q8.y, sigma_q8);
    const auto columns = static_cast<std::size_t>(box.right - box.left + 1);
    DotFit fit;
    for (int v = box.top; v <= box.bottom; ++v) {
        const auto j = static_cast<std::size_t>(v - box.top);
        const float* levels = patch.row(v);
        const float slope_v = light.slope_v * along_v.from_pixel[j];
        for (std::size_t i = 0; i < columns; i += 4) {
            const Four paper =
                light.middle + light.slope_u * four_at(&along_u.from_pixel[i]) + slope_v;
            fit.add(four_at(&along_u.profile[i]) * along_v.profile[j], paper - four_at(levels + i),
                    four_at(&along_u.distance[i]), along_v.distance[j]);
        }
    }
    return fit;
}

/// Measures the dot near a point. Returns nullopt if the point is outside the image or on its
/// border, if there is no dark spot, or if the dot is too far from the point.
std::optional<DetectedDot> measure(const ImageView& image, const Window& window,
                                   FixedVec start_q8) {
    const std::int64_t farthest =
        tuned::kFarthest_2 * std::int64_t{window.sigma_q8} * window.sigma_q8;
    const auto sigma_q8 = static_cast<float>(window.sigma_q8);
    DetectedDot dot{start_q8, 0, 0};
    Patch patch;
    for (int iteration = 0; iteration < tuned::kMaxIterations; ++iteration) {
        const FixedVec pixel = rounded_px(dot.centre_q8);
        const auto box = window.box_around(image, pixel.x, pixel.y);
        if (!box) return {};
        patch.load(image, *box);
        const BorderBackground light = border_background(patch, pixel, window.half_px);
        const auto fit = fit_dot(patch, light, window.sigma_q8, dot.centre_q8).solve();
        if (!fit) return {};
        constexpr float kFarthestStep = 4;
        const auto step_q8 = [=](float offset) {
            return static_cast<std::int32_t>(std::clamp(offset, -kFarthestStep, kFarthestStep) *
                                             sigma_q8);
        };
        const FixedVec step{step_q8(fit->offset_x), step_q8(fit->offset_y)};
        dot.centre_q8 = dot.centre_q8 + step;
        // Dividing by the paper level makes the mass independent of the illumination.
        const float mass = 16384 * fit->height / std::max(light.middle, 1.0F);
        dot.mass = static_cast<std::uint16_t>(std::min(mass, 65535.0F));
        if (squared(dot.centre_q8 - start_q8) > farthest) return {};
        if (squared(step) < tuned::kSettled_q8 * tuned::kSettled_q8) break;
    }
    return dot;
}

/// Unlinks dots from their cells if their mass is below half the typical mass, or above
/// kTooDark_halves / 2 times the typical mass. Such detections are dirt, graphics, or bare paper
/// where a dot is missing.
void reject_mass_outliers(Grid& grid, std::span<DetectedDot> dots) {
    constexpr std::size_t kSample = tuned::kMedianSample;
    std::array<std::int32_t, kSample> masses;
    std::size_t n = 0;
    const std::size_t step = dots.size() / kSample + 1;
    for (std::size_t i = 0; i < dots.size(); i += step)
        masses[n++] = dots[i].mass;
    const int typical = median(std::span(masses).first(n));
    for (GridCell& cell : grid.storage.first(static_cast<std::size_t>(grid.columns * grid.rows))) {
        if (!cell.has_dot()) continue;
        const int mass = dots[cell.dot].mass;
        if (2 * mass < typical || 2 * mass > tuned::kTooDark_halves * typical)
            cell.dot = GridCell::kNoDot;
    }
}

}  // namespace

int measure_dots(const ImageView& image, const FixedLens& lens,
                 const PlaneFromImage& pattern_from_image, const Nominal& nominal, Grid& grid,
                 std::span<DetectedDot> dots) {
    const auto length_q24 =
        square_root(static_cast<std::uint64_t>(squared(pattern_from_image.du_q24)));
    const Window window(static_cast<std::int32_t>((std::int64_t{1} << 32) /
                                                  std::max<std::uint32_t>(length_q24, 1U)));
    std::size_t count = 0;
    for (int j = grid.j0; j < grid.j0 + grid.rows; ++j) {
        for (int i = grid.i0; i < grid.i0 + grid.columns; ++i) {
            GridCell& cell = grid.at(i, j);
            const FixedVec step = nominal.pattern_step({i, j});
            const Symbol symbol = nominal.symbol(step);
            const bool is_hidden = cell.is_hidden(static_cast<int>(symbol));
            cell.dot = GridCell::kNoDot;
            if (is_hidden || count == dots.size()) continue;
            const FixedVec place{step.x * 65536 + dx(symbol) * kDisplacement_q16,
                                 step.y * 65536 + dy(symbol) * kDisplacement_q16};
            const auto dot =
                measure(image, window, distorted_point_q8(lens, pattern_from_image, place));
            if (!dot) continue;
            cell.dot = static_cast<std::uint16_t>(count);
            dots[count++] = *dot;
        }
    }
    reject_mass_outliers(grid, dots.first(count));
    return static_cast<int>(count);
}

}  // namespace dotpose::core
