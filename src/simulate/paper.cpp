#include "simulate/paper.hpp"

#include <algorithm>
#include <cmath>

namespace dotpose {

double PageArea::distance(double x, double y) const {
    const double dx = x - x_grid;
    const double dy = y - y_grid;
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    return std::max(std::abs(c * dx + s * dy) - half_width,
                    std::abs(c * dy - s * dx) - half_height);
}

namespace simulate {
namespace {

// Rounds down. This is faster than std::floor, which compiles to a function call for the baseline
// processor. Returns 0 for values outside the range of a 64-bit integer.
std::int64_t floor_of(double x) {
    // Near the horizon of an extreme tilt, coordinates exceed the range of a 64-bit integer.
    if (!(std::abs(x) < 4e18)) return 0;
    const auto towards_zero = static_cast<std::int64_t>(x);
    return towards_zero - (x < static_cast<double>(towards_zero) ? 1 : 0);
}

// Reflectance of bare paper. It is interpolated linearly between random values at the nodes of a
// lattice on the page.
class Texture {
  public:
    Texture(const Page& page, const View& view, double deviation)
        : seed_(scramble(page.seed + 1)),
          nodes_per_mm_(1 / (Imperfections::kGrain_px * view.camera.mm_per_px)),
          origin_{x_grid(view.pose) * page.pattern.spacing_mm * nodes_per_mm_,
                  y_grid(view.pose) * page.pattern.spacing_mm * nodes_per_mm_},
          // The standard deviation of a uniform value in [-1, 1) is 1/sqrt(3). Interpolation
          // multiplies it by 2/3.
          amplitude_(deviation * std::sqrt(3.0) * 1.5) {
        if (deviation > 0) tabulate(view);
    }

    double at(Vec2 offset_mm) const {
        const double x = origin_.x + offset_mm.x * nodes_per_mm_;
        const double y = origin_.y + offset_mm.y * nodes_per_mm_;
        const std::int64_t i = floor_of(x);
        const std::int64_t j = floor_of(y);
        const double fx = x - static_cast<double>(i);
        const double fy = y - static_cast<double>(j);
        const double top = node(i, j) * (1 - fx) + node(i + 1, j) * fx;
        const double bottom = node(i, j + 1) * (1 - fx) + node(i + 1, j + 1) * fx;
        return 1 + amplitude_ * (top * (1 - fy) + bottom * fy);
    }

  private:
    double drawn(std::int64_t i, std::int64_t j) const {
        const std::uint64_t place =
            (static_cast<std::uint64_t>(i) << 32) ^ static_cast<std::uint64_t>(j);
        return static_cast<double>(scramble(seed_ ^ place) >> 11) * 0x1p-52 - 1;
    }
    double node(std::int64_t i, std::int64_t j) const {
        const auto column = static_cast<std::uint64_t>(i - first_i_);
        const auto row = static_cast<std::uint64_t>(j - first_j_);
        if (column >= columns_ || row >= rows_) return drawn(i, j);
        return nodes_[static_cast<std::size_t>(row * columns_ + column)];
    }

    // Precomputes the values of the nodes in view, because each node is used by about 36 pixels.
    // Does nothing if the view contains more nodes than pixels, as it does at an extreme tilt.
    void tabulate(const View& view) {
        const OffsetBox box = visible_offsets(view);
        const double width = (box.high_mm.x - box.low_mm.x) * nodes_per_mm_ + 3;
        const double height = (box.high_mm.y - box.low_mm.y) * nodes_per_mm_ + 3;
        if (width * height > 1.0 * view.camera.width_px * view.camera.height_px) return;
        first_i_ = floor_of(origin_.x + box.low_mm.x * nodes_per_mm_);
        first_j_ = floor_of(origin_.y + box.low_mm.y * nodes_per_mm_);
        columns_ = static_cast<std::uint64_t>(width);
        rows_ = static_cast<std::uint64_t>(height);
        nodes_.reserve(static_cast<std::size_t>(columns_ * rows_));
        for (std::uint64_t row = 0; row < rows_; ++row) {
            for (std::uint64_t column = 0; column < columns_; ++column)
                nodes_.push_back(drawn(first_i_ + static_cast<std::int64_t>(column),
                                       first_j_ + static_cast<std::int64_t>(row)));
        }
    }

    std::uint64_t seed_;
    double nodes_per_mm_;
    Vec2 origin_;
    double amplitude_;
    std::int64_t first_i_ = 0, first_j_ = 0;
    std::uint64_t columns_ = 0, rows_ = 0;
    std::vector<double> nodes_;
};

/// The table under the paper. It is visible beyond the edge of the paper. Pixels on the edge show a
/// mix of paper and table.
class Table {
  public:
    Table(const Page& page, const View& view)
        : page_(page),
          origin_{x_grid(view.pose), y_grid(view.pose)},
          grid_per_mm_{1 / (page.print_scale.x * page.pattern.spacing_mm),
                       1 / (page.print_scale.y * page.pattern.spacing_mm)},
          px_per_grid_(page.pattern.spacing_mm / view.camera.mm_per_px) {}

    double light_at(Vec2 offset_mm) const {
        const double beyond_px =
            px_per_grid_ * page_.paper->distance(origin_.x + offset_mm.x * grid_per_mm_.x,
                                                 origin_.y + offset_mm.y * grid_per_mm_.y);
        return 1 - (1 - page_.table_reflectance) * std::clamp(0.5 + beyond_px, 0.0, 1.0);
    }

  private:
    const Page& page_;
    Vec2 origin_;
    Vec2 grid_per_mm_;
    double px_per_grid_;
};

}  // namespace

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
    const Table table(page, view);

    const auto width = static_cast<std::size_t>(camera.width_px + 2 * border_px);
    std::vector<double> levels(width);
    std::vector<Vec2> offsets_mm(width);
    std::vector<float> paper;
    paper.reserve(width * static_cast<std::size_t>(camera.height_px + 2 * border_px));
    for (int v = -border_px; v < camera.height_px + border_px; ++v) {
        const double dy = v - centre.y;
        for (std::size_t i = 0; i < width; ++i) {
            const double dx = static_cast<int>(i) - border_px - centre.x;
            const double shade = imperfections.vignetting * (dx * dx + dy * dy) / corner_square;
            const double slope = imperfections.fall * (dx * towards.x + dy * towards.y) / across_px;
            levels[i] =
                imperfections.paper_level * std::max(0.0, 1 - shade) * std::max(0.0, 1 - slope);
        }
        if (imperfections.texture > 0 || page.paper)
            view.projection.offsets_from_row({-1.0 * border_px, 1.0 * v}, offsets_mm);
        for (std::size_t i = 0; i < width; ++i) {
            if (imperfections.texture > 0) levels[i] *= texture.at(offsets_mm[i]);
            if (page.paper) levels[i] *= table.light_at(offsets_mm[i]);
        }
        paper.insert(paper.end(), levels.begin(), levels.end());
    }
    return paper;
}

}  // namespace simulate
}  // namespace dotpose
